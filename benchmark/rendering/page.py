"""Pages from Jinja templates, and their tables.

A page that is one file requests nothing from elsewhere: its template extends ``page.html``, whose
content security policy allows only the style in it.
"""

import base64
import functools
import hashlib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from importlib.resources import files
from typing import Any

from colift.benchmark.rendering.formats import FORMATS
from jinja2 import (
    ChoiceLoader,
    Environment,
    PackageLoader,
    StrictUndefined,
    select_autoescape,
)
from markupsafe import Markup, escape


@dataclass(frozen=True)
class Cell:
    """A cell of a table: its value, and a line in small letters under it, as plain text."""

    value: str
    under: str = ""
    best: bool = False


@dataclass(frozen=True)
class Row:
    """A row of a table; ``kind`` is its class, such as ``baseline``."""

    name: str
    cells: Sequence[Cell]
    kind: str = ""


def render(package: str, template: str, **content: Any) -> str:
    """Return a page.

    Parameters
    ----------
    package
        The package whose folder ``templates`` has the template.
    template
        Its name; text is escaped if it ends in ``.html``, ``.svg`` or ``.xml``.
    content
        Content that the template shows, by name.
    """
    return templates(package).get_template(template).render(**content)


@functools.cache
def templates(package: str) -> Environment:
    """Return the templates of a package, which can extend and import those of this one."""
    made = Environment(
        loader=ChoiceLoader([PackageLoader(each, "templates") for each in (package, __package__)]),
        autoescape=select_autoescape(["html", "svg", "xml"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters.update(FORMATS, breakable=_breakable, hash=content_hash)
    made.globals.update(style=Markup(style()), version=version("colift"))
    return made


def style(*more: str) -> str:
    """Return the style sheet of pages that are one file, with others of the folder ``static``."""
    places = (("templates", "page.css"), *(("static", name) for name in more))
    here = files(__package__)
    return "".join(here.joinpath(*place).read_text(encoding="utf-8") for place in places)


def content_hash(text: str) -> Markup:
    """Return the hash by which a content security policy allows a style or a script."""
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return Markup(f"'sha256-{digest}'")


def _breakable(name: str) -> Markup:
    """Return a name that may be broken after a comma or an underscore."""
    return Markup(re.sub("([,_])", r"\1<wbr>", str(escape(name))))
