"""Text for TeX."""

from typing import Final

COMMANDS: Final = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{letter: f"\\{letter}" for letter in "&%$#_{}"},
}
"""Characters that TeX would take for a command, escaped."""


def tex(text: str) -> str:
    """Return a text escaped for TeX."""
    return "".join(COMMANDS.get(letter, letter) for letter in text)
