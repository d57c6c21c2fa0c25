"""From a view to a page."""

import functools
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from ...agents.errors import InputError
from ..replays.html import script_json
from .formats import FILTERS
from .links import Links

if TYPE_CHECKING:
    from jinja2 import Environment


def render(template: str, links: Links, **content: Any) -> str:
    """Return a page.

    Parameters
    ----------
    template
        Name of a file in ``templates``.
    links
        Where the other pages are.
    content
        What the template shows, by name.

    Raises
    ------
    InputError
        If Jinja is not installed.
    """
    return _environment().get_template(template).render(links=links, **content)


@functools.cache
def _environment() -> "Environment":
    try:
        from jinja2 import Environment, PackageLoader, StrictUndefined
        from markupsafe import Markup, escape
    except ModuleNotFoundError:
        raise InputError("pages need Jinja: pip install 'colift[board]'") from None
    environment = Environment(
        loader=PackageLoader(__package__, "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(FILTERS)
    environment.filters["breakable"] = lambda name: escape(name).replace("_", Markup("_<wbr>"))
    environment.filters["data"] = lambda content: Markup(script_json(content))
    environment.globals["version"] = version("colift")
    return environment
