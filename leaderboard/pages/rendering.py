"""Pages from views, by Jinja templates."""

import functools
import io
import tempfile
from importlib.resources import files
from pathlib import Path
from typing import Any

from colift.agents.errors import InputError
from colift.agents.extras import how_to_install
from colift.agents.submissions.new import PLACEHOLDER, write_template
from colift.benchmark.comparison.scatter.svg import svg
from colift.benchmark.episode.drawn import error_words
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.rendering.page import templates
from colift.leaderboard.pages.formats import FILTERS
from colift.leaderboard.pages.links import Links
from colift.leaderboard.records.metrics import board_metrics, picture_axes, suite_metrics
from colift.leaderboard.replays.html import script_json
from colift.leaderboard.storage.archive import pack_archive
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
        The values for the template, by name. It also gets the metrics of the season's suite:
        ``metrics`` have columns beside the ``leading`` one, ``second`` is the first of them;
        ``error_words``, a description of the drawn error; and ``task``, the :class:`.TaskView`.
    """
    season = content.get("season") or getattr(content.get("view"), "season", None)
    if season is not None:
        leading, second = picture_axes(season.suite)
        metrics = suite_metrics(season.suite)
        content |= {
            "metrics": board_metrics(season.suite),
            "leading": leading,
            "second": second,
            "error_words": error_words(drawn_series(metrics)),
            "task": task_view(season.suite),
        }
    return _environment().get_template(template).render(links=links, **content)


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
    made.filters.update(FILTERS, svg=svg, data=lambda content: Markup(script_json(content)))
    return made


@functools.cache
def template_archive() -> bytes:
    """Return the files that ``colift new`` writes, as a zip archive."""
    buffer = io.BytesIO()
    with tempfile.TemporaryDirectory(prefix="colift-") as temporary:
        folder = Path(temporary, PLACEHOLDER)
        write_template(folder)
        pack_archive(folder, buffer)
    return buffer.getvalue()
