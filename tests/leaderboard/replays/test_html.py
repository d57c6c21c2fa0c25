import base64
import hashlib
import json
import re

import pytest
from colift.leaderboard.replays.chosen import chosen_replays
from colift.leaderboard.replays.html import SCRIPTS, replay_page, script_json

EVIL = "</script><script>alert(1)</script><!--&\u2028"


@pytest.fixture(scope="module")
def replays(bundle):
    return chosen_replays(bundle, "blend")


@pytest.fixture(scope="module")
def page(replays):
    return replay_page(replays[:1])


def test_data_in_a_page_cannot_end_its_element(replays):
    text = script_json({"policy": EVIL})
    assert not set("<>&\u2028") & set(text)
    assert json.loads(text) == {"policy": EVIL}
    page = replay_page([{**replays[0], "policy": EVIL, "failure": EVIL}])
    assert "alert(1)</script>" not in page
    data = re.search('id="replay-data">(.*?)</script>', page, re.DOTALL)
    assert json.loads(data[1])["replays"][0]["policy"] == EVIL


def test_a_page_asks_for_nothing(page):
    assert not re.search(r"""(src|href)\s*=|@import|url\((?!#)|https?://(?!www\.w3\.org/)""", page)
    assert "eval(" not in page
    assert ' style="' not in page


def test_a_page_allows_its_own_scripts_and_nothing_else(page):
    rules = re.search('Content-Security-Policy" content="([^"]*)"', page)[1]
    assert rules.startswith("default-src 'none'; script-src 'sha256-")
    texts = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    texts += re.findall(r"<style>(.*?)</style>", page, re.DOTALL)
    assert len(texts) == len(SCRIPTS) + 1
    for text in texts:
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in rules


def test_a_page_of_one_lift_can_be_mailed(page):
    assert len(page) < 110_000


def test_there_must_be_a_lift():
    with pytest.raises(ValueError, match="a replay"):
        replay_page([])
