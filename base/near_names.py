"""Suggestions for misspelt names."""

import difflib
from collections.abc import Iterable


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return ``did you mean NAME? `` with the nearest known name; empty if none is near.

    It ends with a blank: a list of all known names should follow.
    """
    lower = {each.lower(): each for each in known}
    near = difflib.get_close_matches(name.lower(), lower, n=1)
    return f"did you mean {lower[near[0]]}? " if near else ""


def near_names(name: str, known: Iterable[str], most: int = 3) -> list[str]:
    """Return up to ``most`` known names that a misspelt one may stand for, the nearest first.

    They are similar, or begin with it, whatever the case of the letters.
    """
    lower = {each.lower(): each for each in known}
    similar = difflib.get_close_matches(name.lower(), lower, n=most)
    begun = [each for each in lower if name and each.startswith(name.lower())]
    return [lower[each] for each in dict.fromkeys([*similar, *begun])][:most]
