"""The feed of a season, the badge of a row, and the template to download."""

import dataclasses
import io
import xml.etree.ElementTree as ET
import zipfile
from pathlib import Path
from urllib.parse import urljoin, urlsplit

from colift.agents.submissions.submission import read_submission
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.formats import badge_text

from ... import web
from .boards import digest

ATOM = "{http://www.w3.org/2005/Atom}"


def test_the_feed_has_the_rows_newest_first_and_leads_to_their_pages(url, folder):
    answer = web.get(f"{url}/seasons/2026/feed.atom")
    assert answer.headers["content-type"].startswith("application/atom+xml")
    feed = ET.fromstring(answer.content)
    board = Board.open(folder)
    newest = sorted(board.standings("2026"), key=lambda each: each.at, reverse=True)
    board.close()
    entries = feed.findall(f"{ATOM}entry")
    links = [urljoin(url, entry.find(f"{ATOM}link").get("href")) for entry in entries]
    assert links == [f"{url}/seasons/2026/policies/{each.row.submission}" for each in newest]
    assert web.get(links[0]).status_code == 200
    assert urljoin(url, feed.find(f"{ATOM}link[@rel='self']").get("href")) == str(answer.url)
    titles = [entry.find(f"{ATOM}title").text for entry in entries]
    assert titles[0].startswith("<b>sly</b>: ")
    assert "trained on: <i>recorded</i> lifts." in entries[0].find(f"{ATOM}summary").text
    assert len({entry.find(f"{ATOM}id").text for entry in entries}) == len(entries)


def test_the_feed_on_the_disk_names_the_same_rows(url, site):
    place = Path(urlsplit(site).path) / "data"
    ids = []
    for text in (
        web.get(f"{url}/seasons/2026/feed.atom").text,
        (place / "2026.atom").read_text(),
    ):
        ids.append([each.text for each in ET.fromstring(text).iter(f"{ATOM}id")])
    assert ids[0] == ids[1]
    entry = ET.parse(place / "2026.atom").find(f"{ATOM}entry")
    assert (place / entry.find(f"{ATOM}link").get("href")).is_file()


def test_what_was_done_to_a_row_moves_the_feed_s_date(url):
    feed = ET.fromstring(web.get(f"{url}/seasons/2025/feed.atom").content)
    hold = next(
        e for e in feed.findall(f"{ATOM}entry") if e.find(f"{ATOM}title").text[:4] == "hold"
    )
    assert hold.find(f"{ATOM}updated").text > hold.find(f"{ATOM}published").text
    assert "out of the ranking" in hold.find(f"{ATOM}title").text


def test_a_badge_tells_error_and_rank_and_may_stand_on_pages_elsewhere(url, folder):
    board = Board.open(folder)
    best = board.standings("2026")[0]
    board.close()
    answer = web.get(f"{url}/seasons/2026/policies/{best.row.submission}/badge.svg")
    assert answer.headers["content-type"] == "image/svg+xml"
    assert answer.headers["cross-origin-resource-policy"] == "cross-origin"
    told = ET.fromstring(answer.content).get("aria-label")
    assert told == f"colift: {best.row.hidden.rmse_mm.mean:.1f} mm · not ranked"
    assert badge_text(dataclasses.replace(best, rank=3)).endswith(" mm · rank 3")
    gone = web.get(f"{url}/seasons/2025/policies/{digest('hold')}/badge.svg")
    assert "not ranked" in gone.text
    assert web.get(f"{url}/seasons/2026/policies/{'f' * 64}/badge.svg").status_code == 404


def test_the_template_can_be_downloaded_and_is_a_submission(url, tmp_path):
    answer = web.get(f"{url}/template.zip")
    zipfile.ZipFile(io.BytesIO(answer.content)).extractall(tmp_path)
    assert read_submission(tmp_path).manifest.name == "my-policy"
