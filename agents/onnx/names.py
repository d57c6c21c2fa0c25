"""The words in the names of inputs and outputs, as exporters and authors write them."""

import re
from collections.abc import Callable, Sequence
from typing import Final

OBSERVATION: Final = frozenset({"observation", "observations", "obs"})
ACTION: Final = frozenset({"action", "actions", "act"})
STATE: Final = frozenset(
    {"state", "states", "hidden", "cell", "carry", "memory", "h", "c", "hx", "cx", "hn", "cn", "hc"}
)
"""Words that tell what an input or output is."""

_MEANS: Final = {"hidden": "h", "hx": "h", "hn": "h", "cell": "c", "cx": "c", "cn": "c"}
"""The usual names of the two states of an LSTM."""

_BEFORE: Final = ("in", "input", "prev", "previous", "old", "last", "init", "initial", "before")
_AFTER: Final = ("out", "output", "next", "new", "updated", "final", "after")
_SIDE: Final = frozenset({*_BEFORE, *_AFTER, "n", "t"})
"""Words that tell only whether a state is that before a step or after it."""

_WORD: Final = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|[0-9]+")


def words(name: str) -> tuple[str, ...]:
    """Return the words and numbers in a name: ``newState_0`` has ``new``, ``state`` and ``0``."""
    return tuple(word.lower() for word in _WORD.findall(name))


def candidates(names: Sequence[str], role: frozenset[str]) -> tuple[Sequence[str], Sequence[str]]:
    """Return the names that may have a role, as far as names tell, and as far as they do not deny.

    Both are the names that tell it, if there are any. Otherwise the first are those that tell no
    state, and the second are all.
    """
    telling = [name for name in names if role & set(words(name))]
    others = [name for name in names if not STATE & set(words(name))]
    if telling:
        only = [name for name in telling if name in others] or telling
        return only, only
    return others, names


def paired(before: Sequence[str], after: Sequence[str]) -> dict[str, str] | None:
    """Return the name after a step of each state before it; None if the names do not tell.

    ``h0`` and ``hn`` are a pair, as ``state_1`` and ``new_state_1`` are.
    """
    keys: tuple[Callable[[str], object], ...] = (_numbered, _plain)
    for key in keys:
        first, second = {key(each): each for each in before}, {key(each): each for each in after}
        if first.keys() == second.keys() and len(first) == len(before) == len(after):
            return {first[each]: second[each] for each in first}
    return None


def _numbered(name: str) -> tuple[str, ...]:
    """Return a state's own words and numbers."""
    found = [_MEANS.get(word, word) for word in words(name) if word not in _SIDE]
    return tuple(word for word in found if word not in ("state", "states")) or tuple(found)


def _plain(name: str) -> tuple[str, ...]:
    """Return a state's own words."""
    return tuple(word for word in _numbered(name) if not word.isdigit())
