"""Docstrings as plain text, for readers who do not see them on a page of the documentation."""

import re
from typing import Final

ROLE: Final = re.compile(r":[\w:+-]+:`(?:[^`<]*<)?[.~!]*([^`>]+)>?`")
"""A reference or another role of reStructuredText, with its target."""

LITERAL: Final = re.compile(r"``([^`]+)``")
"""Code in reStructuredText."""


def plain_text(docstring: str) -> str:
    """Return a text without the markup of reStructuredText: names as such, code in quotes."""
    return LITERAL.sub(r"'\1'", ROLE.sub(r"\1", docstring))
