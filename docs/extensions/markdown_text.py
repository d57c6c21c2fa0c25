"""Markdown that the directives of the reference write: tables, and docstrings in their cells."""

import re
from collections.abc import Iterable, Sequence
from typing import Final

from sphinx.pycode import ModuleAnalyzer

ROLE: Final = re.compile(r":[a-z]+:`[~.]*([^`]*)`")
"""A cross-reference of a docstring."""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; a cell is Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(_cell(each) for each in line)} |" for line in lines)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", r"\|")


def from_docstring(text: str) -> str:
    """Return the text of a docstring with its references and literals as code."""
    return ROLE.sub(r"`\1`", text).replace("``", "`")


def attribute_types(owner: type) -> dict[str, str]:
    """Return the annotations of a class's attributes by name, as the source has them."""
    analyzer = ModuleAnalyzer.for_module(owner.__module__)
    analyzer.analyze()
    return {
        name: text
        for (place, name), text in analyzer.annotations.items()
        if place == owner.__qualname__
    }


def attribute_docs(owner: type) -> dict[str, str]:
    """Return the docstrings of a class's attributes by name, in their order."""
    docs = ModuleAnalyzer.for_module(owner.__module__).find_attr_docs()
    return {
        name: from_docstring(" ".join(lines).strip())
        for (place, name), lines in docs.items()
        if place == owner.__qualname__
    }
