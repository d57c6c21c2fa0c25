"""The pages as files."""

import re
import zipfile
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from colift.base.errors import InputError
from colift.benchmark.bundle.reading import read_bundle
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site
from playwright.sync_api import expect


@pytest.fixture(scope="module")
def place(site: str) -> Path:
    return Path(urlsplit(site).path)


def test_every_link_leads_to_a_file_of_the_site(place):
    for page in place.glob("*.html"):
        if page.name.startswith("replays-"):
            continue
        for address in re.findall(r'(?:href|src|action)="([^"#]+)', page.read_text()):
            if not address.startswith("https://example.org/"):
                assert (place / unquote(address.partition("?")[0])).is_file(), (page.name, address)


def test_a_downloaded_public_run_is_a_bundle(place, tmp_path):
    archive = next((place / "data").glob("2026-*.zip"))
    zipfile.ZipFile(archive).extractall(tmp_path)
    assert len(read_bundle(tmp_path).episodes) == 12


def test_a_replay_opens_from_the_disk(page, site):
    page.goto(f"{site}/index.html")
    page.get_by_role("link", name="copy").first.click()
    page.get_by_role("link", name="Watch it lift").click()
    expect(page.get_by_role("heading", level=1)).to_contain_text("copy lifts a table")


def test_behaviours_open_from_the_disk(page, site):
    page.goto(f"{site}/index.html")
    page.get_by_role("link", name="Behaviours").click()
    page.get_by_role("link", name="pause").first.click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Pause")
    expect(page.locator("svg.wide .curve")).to_have_count(3)


def test_files_take_no_submissions(page, site):
    page.goto(f"{site}/submit.html")
    expect(page.get_by_text("These pages are files")).to_be_visible()
    assert page.locator("form").count() == 0


@pytest.mark.slow
def test_an_older_site_is_replaced_and_nothing_else(folder, tmp_path):
    board = Board.open(folder)
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis/thesis.tex").touch()
    with pytest.raises(InputError, match="has other content"):
        write_site(board, tmp_path / "thesis")
    write_site(board, tmp_path / "site")
    (tmp_path / "site/old.html").touch()
    write_site(board, tmp_path / "site")
    board.close()
    assert not (tmp_path / "site/old.html").exists()
    assert (tmp_path / "site/index.html").is_file()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["site", "thesis"]
