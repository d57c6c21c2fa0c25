"""Which lifts of a run are shown: of each behaviour the best, the median and the worst."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Literal

from ...benchmark.episode import Episode

Which = Literal["best", "median", "worst"]

WHICH: Final[tuple[Which, ...]] = ("best", "median", "worst")


@dataclass(frozen=True, kw_only=True)
class Choice:
    """A lift that is shown, and what it stands for."""

    behaviour: str
    which: Which
    row: int
    """Where the episode is in the run, counted from 0."""


def choose(episodes: Sequence[Episode]) -> tuple[Choice, ...]:
    """Return the lifts that are shown, behaviour by behaviour in order of appearance.

    They are told apart by RMSE, equal ones by their place in the run; the median of an even number
    is the better of the middle two. Of a behaviour with two lifts there is no median, of one with
    one lift there is only that.
    """
    by_behaviour: dict[str, list[int]] = {}
    for row, episode in enumerate(episodes):
        by_behaviour.setdefault(episode.behaviour, []).append(row)
    found = []
    for behaviour, rows in by_behaviour.items():
        ordered = sorted(rows, key=lambda row: (episodes[row].scores.rmse_mm, row))
        last = len(ordered) - 1
        places: dict[Which, int] = {"best": 0, "median": last // 2, "worst": last}
        if last == 1:
            del places["median"]
        if last == 0:
            places = {"median": 0}
        found += [
            Choice(behaviour=behaviour, which=which, row=ordered[place])
            for which, place in places.items()
        ]
    return tuple(found)
