"""The page of an inspection: one file that needs nothing else."""

import base64
import re

import pytest
from colift.benchmark.inspection.page import inspection_page

from ...browser import browser, violations


@pytest.fixture(scope="module")
def html(found):
    return inspection_page(found)


def test_it_has_a_picture_of_each_worst_lift_and_its_moment(found, html):
    pictures = re.findall(r'src="data:image/png;base64,([^"]+)"', html)
    assert len(pictures) == len(found.worst)
    for each, picture in zip(found.worst, pictures, strict=True):
        assert base64.b64decode(picture).startswith(b"\x89PNG")
        lift = each.lift
        name = f"{lift.behaviour.replace('_', ' ')}, {lift.subject}, seed {lift.seed}"
        assert f"{name}: <b>{lift.rmse_mm:.1f} mm</b>" in html
        assert f"two people {lift.human_human_mm:.1f} mm" in html
        assert f"Largest error at {each.moment.time_s:.2f} s" in html


@pytest.mark.slow
def test_equal_inspections_give_equal_pages(found, html):
    drawn = []
    assert inspection_page(found, drawn.append) == html
    assert drawn == [1, 1, 1]


@pytest.mark.slow
def test_a_browser_shows_it_and_asks_for_nothing(html, tmp_path):
    path = tmp_path / "why.html"
    path.write_text(html, encoding="utf-8")
    with browser() as chromium:
        for width in (1440, 390):
            page = chromium.new_page(viewport={"width": width, "height": 900})
            asked, said = [], []
            page.on("request", lambda request, asked=asked: asked.append(request.url))
            page.on("console", lambda message, said=said: said.append(message.text))
            page.goto(path.as_uri())
            assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
            assert said == []
            widths = "[document.documentElement.scrollWidth, innerWidth]"
            wide, window = page.evaluate(widths)
            assert wide <= window
            drawn = "[...document.images].every((image) => image.naturalWidth > 1000)"
            assert page.evaluate(drawn)
            assert page.locator("table.parts circle.dot").count() == 5
            assert violations(page) == []
            page.close()
