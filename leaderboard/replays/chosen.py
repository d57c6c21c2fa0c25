"""Replays of a run: the best, median and worst lift of each behaviour."""

import contextlib
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from colift.benchmark.bundle import FILES, Bundle, read_bundle
from colift.benchmark.episode.loop import Episode
from colift.leaderboard.replays.replay import Which, play_ghosts, replay_content
from colift.leaderboard.storage.files import read_json, write_json


@dataclass(frozen=True, kw_only=True)
class ReplayChoice:
    """A lift that is shown, and the reason for its choice."""

    behaviour: str
    which: Which | None
    """None of a lift that is shown for its session."""
    row: int
    """Index of the episode in the run."""


def choose_replays(episodes: Sequence[Episode], session: int = 0) -> tuple[ReplayChoice, ...]:
    """Return the lifts that are shown, behaviour by behaviour in order of appearance.

    They are ordered by RMSE, equal ones by their place in the run; the median of an even number
    is the better of the middle two. A behaviour with two lifts has no median, one with a single
    lift has only that.

    Of sessions of some lifts, all lifts of the session with the median RMSE are shown, and the
    worst lift.
    """
    by_behaviour: dict[str, list[int]] = {}
    for row, episode in enumerate(episodes):
        by_behaviour.setdefault(episode.behaviour, []).append(row)
    found: list[ReplayChoice] = []
    for behaviour, rows in by_behaviour.items():
        if session and len(rows) % session == 0:
            found += _of_sessions(episodes, behaviour, rows, session)
            continue
        ordered = sorted(rows, key=lambda row: (episodes[row].scores["rmse_mm"], row))
        last = len(ordered) - 1
        indices: dict[Which, int] = {"best": 0, "median": last // 2, "worst": last}
        if last == 1:
            del indices["median"]
        if last == 0:
            indices = {"median": 0}
        found += [
            ReplayChoice(behaviour=behaviour, which=which, row=ordered[index])
            for which, index in indices.items()
        ]
    return tuple(found)


def _of_sessions(
    episodes: Sequence[Episode], behaviour: str, rows: Sequence[int], session: int
) -> Iterator[ReplayChoice]:
    def error(some: Sequence[int]) -> float:
        return math.fsum(episodes[row].scores["rmse_mm"] for row in some)

    sessions = sorted((rows[i : i + session] for i in range(0, len(rows), session)), key=error)
    for row in sessions[(len(sessions) - 1) // 2]:
        yield ReplayChoice(behaviour=behaviour, which=None, row=row)
    worst = max(rows, key=lambda row: episodes[row].scores["rmse_mm"])
    yield ReplayChoice(behaviour=behaviour, which="worst", row=worst)


FILE: Final = "replays.json"
"""Name of the file beside a bundle; or in its folder, if the bundle itself is not there."""


def chosen_replays(bundle: Bundle, policy: str) -> list[dict[str, Any]]:
    """Return :func:`.replay_content` of the best, median and worst lift of each behaviour.

    Parameters
    ----------
    bundle
        Of a public run: a replay reveals its episode.
    policy
        Name of the policy.

    Raises
    ------
    InputError
        If the suite of the bundle cannot be made.
    """
    suite = bundle.recipe.suite()
    choices = choose_replays(bundle.episodes, suite.session)
    places = [bundle.indices[choice.row] for choice in choices]
    ghosts = play_ghosts(suite, places)
    return [
        replay_content(
            bundle.episodes[choice.row],
            suite.at(place).scenario,
            ghosts[place],
            policy=policy,
            suite=suite.name,
            suite_digest=suite.digest,
            which=choice.which,
        )
        for choice, place in zip(choices, places, strict=True)
    ]


def has_replays(bundle: Path) -> bool:
    """Return whether :func:`replays_of` returns any."""
    made = any((folder / FILE).is_file() for folder in (bundle.parent, bundle))
    return made or all((bundle / name).is_file() for name in FILES)


def made_replays(bundle: Path) -> list[dict[str, Any]]:
    """Return those replays of a bundle that have been made already; make none."""
    for path in (bundle.parent / FILE, bundle / FILE):
        if path.is_file():
            replays: list[dict[str, Any]] = read_json(path)["replays"]
            return replays
    return []


def replays_of(bundle: Path, policy: str) -> list[dict[str, Any]]:
    """Return the replays of the bundle in a folder; making them takes seconds, and is done once.

    None if the bundle is incomplete, as that of an imported row without replays.

    Raises
    ------
    InputError
        If it is not a bundle.
    """
    made = made_replays(bundle)
    if made or not all((bundle / name).is_file() for name in FILES):
        return made
    made = chosen_replays(read_bundle(bundle), policy)
    with contextlib.suppress(OSError):  # Where nothing can be written, they are made again.
        write_json(bundle.parent / FILE, {"replays": made}, indent=None)
    return made
