"""The documentation that a board links to."""

import pytest
from colift.base.errors import InputError
from colift.leaderboard.pages.links import Links
from colift.leaderboard.service.documentation import Documentation
from playwright.sync_api import Page, expect

from ... import web
from .conftest import running

INDEX = """<!doctype html><title>The manual</title><style>h1 { color: rgb(1, 2, 3) }</style>
<h1>The manual</h1><script>document.body.dataset.theme = "dark"</script>
<a href="start.html">Start</a>"""


@pytest.fixture
def manual(tmp_path):
    place = tmp_path / "manual"
    place.mkdir()
    (place / "index.html").write_text(INDEX)
    (place / "start.html").write_text("<!doctype html><title>Start</title><h1>Start</h1>")
    return place


def test_a_folder_is_served_with_its_styles_and_scripts(folder, manual, page: Page):
    with running(folder, Documentation.at(str(manual))) as url:
        page.goto(f"{url}/method")
        page.get_by_role("link", name="Documentation").click()
        expect(page).to_have_url(f"{url}/docs/")
        heading = page.get_by_role("heading", name="The manual")
        expect(heading).to_have_css("color", "rgb(1, 2, 3)")
        assert page.evaluate("document.body.dataset.theme") == "dark"
        page.get_by_role("link", name="Start").click()
        expect(page).to_have_url(f"{url}/docs/start.html")


def test_the_board_keeps_its_own_content_security_policy(folder, manual):
    with running(folder, Documentation.at(str(manual))) as url:
        assert "unsafe-inline" in web.get(f"{url}/docs/").headers["Content-Security-Policy"]
        assert "unsafe-inline" not in web.get(f"{url}/").headers["Content-Security-Policy"]


def test_files_outside_the_folder_are_not_served(folder, manual):
    (manual.parent / "secret.html").write_text("the words inside")
    with running(folder, Documentation.at(str(manual))) as url:
        for path in ("../secret.html", "%2e%2e/secret.html", "..%2fsecret.html"):
            answer = web.get(f"{url}/docs/{path}")
            assert answer.status_code == 404
            assert "the words inside" not in answer.text


def test_without_documentation_there_is_no_link(url):
    assert "Documentation" not in web.get(f"{url}/").text
    assert web.get(f"{url}/docs/").status_code == 404


def test_the_table_links_to_the_page_on_real_people(folder, manual, page: Page):
    (manual / "background").mkdir()
    (manual / "background" / "validity.html").write_text("<!doctype html><h1>Real people</h1>")
    with running(folder, Documentation.at(str(manual))) as url:
        for path in ("/", "/method"):
            page.goto(f"{url}{path}")
            page.get_by_role("link", name="How far to believe this table").click()
            expect(page).to_have_url(f"{url}/docs/background/validity.html")
            expect(page.get_by_role("heading", name="Real people")).to_be_visible()


def test_without_documentation_the_table_names_the_command(url):
    text = web.get(f"{url}/").text
    assert "How far to believe this table" in text
    assert "<code>colift validity FILE.csv</code>" in text
    assert "validity.html" not in text


@pytest.mark.parametrize("place", ["https://host/docs", "https://host/docs/index.html"])
def test_a_page_of_the_documentation_has_an_address(place):
    links = Links("", Documentation.at(place).link(""))
    assert links.docs("background/validity") == "https://host/docs/background/validity.html"


@pytest.mark.parametrize("place", ["nowhere", "ftp://host/docs", "javascript:alert(1)"])
def test_anything_else_than_an_address_or_a_folder_of_pages_is_refused(place):
    with pytest.raises(InputError, match="must be an address"):
        Documentation.at(place)


def test_a_folder_without_a_first_page_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"index\.html"):
        Documentation.at(str(tmp_path))
