"""Pages from views, by Jinja templates."""

import functools
from collections.abc import Mapping
from importlib.resources import files
from typing import Any

from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.comparison.scatter.svg import svg
from colift.benchmark.episode.drawn import error_words
from colift.benchmark.episode.metric import drawn_series, gentle
from colift.benchmark.rendering.page import templates
from colift.benchmark.results.roughness import MEANING, ROUGHER, by_which
from colift.leaderboard.pages.formats import FILTERS
from colift.leaderboard.pages.links import Links
from colift.leaderboard.pages.table import NAVIGATION
from colift.leaderboard.records.metrics import board_metrics, picture_axes, suite_metrics
from colift.leaderboard.records.season import SeasonInfo
from colift.leaderboard.replays.html import script_json
from colift.leaderboard.views.page import NAME, Page, Visit, find_season
from colift.leaderboard.views.task import task_view
from jinja2 import Environment
from markupsafe import Markup


def render_page(template: str, links: Links, **content: Any) -> str:
    """Return a page.

    Parameters
    ----------
    template
        Name of a file in ``templates``.
    links
        Addresses of the other pages.
    content
        The values for the template, by name; with a ``season`` also what :func:`_of_season`
        returns.
    """
    season = content.get("season")
    if season is not None:
        content |= _of_season(season)
    return _environment().get_template(template).render(links=links, **content)


def show(page: Page, links: Links, visit: Visit, values: Mapping[str, str]) -> str | bytes:
    """Return a page of the table.

    Parameters
    ----------
    page, values
        The page, and the parts of its address by name.
    links
        Addresses of the other pages.
    visit
        What it is made for.

    Raises
    ------
    NoPageError
        If there is nothing at this address.
    """
    if page.view is None:
        raise ValueError(f"page {page.name!r} has no view")
    made = page.view(visit, **values)
    if isinstance(made, str | bytes):
        return made
    content = {
        "page": page.name,
        "season": find_season(visit.board),
        "board_name": visit.name,
        "origin": visit.origin,
        **made,
    }
    return render_page(content.pop("template", page.template), links, **content)


def _of_season(season: SeasonInfo) -> dict[str, Any]:
    """Return the ``season``, and what templates show of its suite.

    ``metrics`` have columns beside the ``leading`` one, ``second`` is the first of them;
    ``rough_by`` names the metrics by which a policy is rougher than two people, and
    ``gentle_words`` those that are compared;
    ``error_words`` describe the drawn error; ``task`` is the :class:`.TaskView`.
    """
    leading, second = picture_axes(season.suite)
    every = suite_metrics(season.suite)
    return {
        "season": season,
        "metrics": board_metrics(season.suite),
        "leading": leading,
        "second": second,
        "rough_by": functools.partial(by_which, metrics=every),
        "gentle_words": by_which([each.name for each in gentle(every)], every),
        "error_words": error_words(drawn_series(every)),
        "task": task_view(season.suite),
    }


@functools.cache
def prose(name: str) -> Markup:
    """Return a Markdown file of ``templates`` as HTML.

    Raises
    ------
    InputError
        If markdown-it is not installed.
    """
    try:
        from markdown_it import MarkdownIt
    except ModuleNotFoundError:
        raise InputError(f"pages need markdown-it: {how_to_install('board')}") from None
    text = files(__package__).joinpath("templates", name).read_text(encoding="utf-8")
    reader = MarkdownIt("commonmark", {"html": False}).enable("table")
    return Markup(reader.render(text))


@functools.cache
def _environment() -> Environment:
    made = templates(__package__)
    made.filters.update(FILTERS, svg=svg, prose=prose)
    made.filters["data"] = lambda content: Markup(script_json(content))
    made.globals.update(navigation=NAVIGATION, page="", board_name=NAME, origin="")
    made.globals.update(rougher_words=ROUGHER, rougher_meaning=MEANING)
    return made
