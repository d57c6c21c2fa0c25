"""A page of one's own: the two files of CONTRIBUTING.md, in a copy of the package."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from colift.leaderboard.pages.links import Links
from colift.leaderboard.pages.table import PAGES, by_name
from colift.leaderboard.views.page import Page

ROOT = Path(__file__).parents[3]

LOOK = """
import asyncio, json, sys
from pathlib import Path
import httpx
from colift.leaderboard.core.board import Board
from colift.leaderboard.pages.site import write_site
from colift.leaderboard.service.app import create_app

async def look(board, address):
    app = create_app(board)
    transport = httpx.ASGITransport(app=app)
    async with httpx.AsyncClient(transport=transport, base_url="http://board") as client:
        return (await client.get(address)).text

board, site = map(Path, sys.argv[1:])
opened = Board.open(board)
write_site(opened, site)
opened.close()
found = {address: asyncio.run(look(board, address)) for address in ("/", "/seasons/2025/speed")}
print(json.dumps(found))
"""


def example() -> dict[Path, str]:
    """Return the files of the page in CONTRIBUTING.md, by their paths."""
    text = (ROOT / "CONTRIBUTING.md").read_text()
    block = r"^`(\S+)` in `(leaderboard/\S+)`:\n\n```\w+\n(.*?)^```$"
    blocks = re.findall(block, text, re.DOTALL | re.MULTILINE)
    return {Path(folder, name): content for name, folder, content in blocks}


@pytest.fixture(scope="module")
def found(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, str], Path]:
    """The pages of a service with that page, by address, and its site."""
    place = tmp_path_factory.mktemp("stranger")
    package = place / "src/colift"
    package.mkdir(parents=True)
    for each in (ROOT / "src/colift").iterdir():
        if each.name != "leaderboard":
            (package / each.name).symlink_to(each.resolve())
    shutil.copytree(ROOT / "leaderboard", package / "leaderboard")
    for path, content in example().items():
        assert not (package / path).exists()
        (package / path).write_text(content)
    command = [sys.executable, "-c", LOOK, str(folder), str(place / "site")]
    environment = {**os.environ, "PYTHONPATH": str(place / "src")}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return json.loads(done.stdout), place / "site"


def test_a_page_takes_two_files():
    assert sorted(path.parent.name for path in example()) == ["templates", "views"]


def test_it_is_served_and_in_the_navigation(found):
    pages, _ = found
    assert re.search(r'<a href="/seasons/2026/speed">\s*Speed\s*</a>', pages["/"])
    shown = pages["/seasons/2025/speed"]
    assert '<a href="/seasons/2025/speed" aria-current="page">Speed</a>' in shown
    assert "<h1>Speed</h1>" in shown
    assert "blend</a>: " in shown


def test_it_is_in_a_site(found):
    _, site = found
    page = (site / "speed-2025.html").read_text()
    assert '<a href="speed-2025.html" aria-current="page">Speed</a>' in page
    [address] = re.findall(r'<a href="([^"]+)">blend</a>', page)
    assert (site / address).is_file()
    assert '<a href="speed-2026.html">Speed</a>' in (site / "index.html").read_text()


def test_a_page_of_an_unknown_part_is_refused():
    with pytest.raises(ValueError, match="'speed': 'robot' is none of season"):
        Page(name="speed", url="/speed/{robot}")


@pytest.mark.parametrize(
    ("url", "file", "told"),
    [
        ("/seasons/{season}/speed", "speed.html", "need the same parts"),
        ("/speed/{digest}", "speed-{digest}.html", "the first part of .* must be {season}"),
    ],
)
def test_a_file_that_a_site_cannot_name_is_refused(url, file, told):
    with pytest.raises(ValueError, match=f"'speed': .*{told}"):
        Page(name="speed", url=url, file=file)


def test_a_page_of_the_navigation_needs_no_more_than_a_season():
    with pytest.raises(ValueError, match="'speed' is in the navigation"):
        Page(name="speed", url="/seasons/{season}/{digest}/speed", menu="Speed")


def test_two_pages_of_one_name_are_refused():
    with pytest.raises(ValueError, match="two pages have the name 'board'"):
        by_name([Page(name="board", url="/a"), Page(name="board", url="/b")])


def test_an_address_of_no_page_names_the_pages():
    with pytest.raises(AttributeError, match=r"no page 'bord'; pages: .*compare"):
        Links().bord("2026")


def test_every_page_of_the_table_says_what_it_shows():
    assert [page.name for page in PAGES.values() if page.served and not page.meaning] == []
