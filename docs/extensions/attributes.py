"""Docstrings of attributes as they stand: Napoleon takes a text before a colon for their type."""

from typing import Any, Final

from sphinx.application import Sphinx

KINDS: Final = ("attribute", "data", "property")

KEY: Final = "colift_attribute"


def keep(app: Sphinx, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Keep the lines of an attribute's docstring before Napoleon changes them."""
    app.env.temp_data[KEY] = list(lines) if what in KINDS else None


def restore(app: Sphinx, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Restore the lines in which Napoleon has found a type."""
    kept = app.env.temp_data.pop(KEY, None)
    if kept and any(line.startswith(":type:") for line in lines):
        lines[:] = kept


def setup(app: Sphinx) -> dict[str, Any]:
    """Put the two around Napoleon, which has the priority 500."""
    app.connect("autodoc-process-docstring", keep, priority=400)
    app.connect("autodoc-process-docstring", restore, priority=600)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
