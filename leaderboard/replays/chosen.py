"""The replays of a run: chosen from its bundle, each with its ghost."""

import contextlib
from pathlib import Path
from typing import Any, Final

from ...benchmark.bundle import FILES, Bundle, read_bundle
from ..files import read_json, write_json
from .choice import choose
from .ghost import Ghost, play_ghost
from .replay import replay

FILE: Final = "replays.json"
"""Name of the file beside a bundle; or in its folder, if the bundle itself is not there."""


def chosen_replays(bundle: Bundle, policy: str) -> list[dict[str, Any]]:
    """Return the best, median and worst lift of each behaviour as :func:`.replay` has them.

    Parameters
    ----------
    bundle
        Of a public run: whoever sees a replay knows its episode.
    policy
        What the policy is called.

    Raises
    ------
    InputError
        If the suite of the bundle cannot be made.
    """
    suite = bundle.recipe.suite()
    ghosts: dict[int, Ghost] = {}
    found = []
    for choice in choose(bundle.episodes):
        place, episode = bundle.places[choice.row], bundle.episodes[choice.row]
        scenario = suite.scenarios[place // len(suite.seeds)]
        if place not in ghosts:
            ghosts[place] = play_ghost(scenario, episode.seed)
        found.append(
            replay(
                episode,
                scenario,
                ghosts[place],
                policy=policy,
                suite=suite.name,
                suite_digest=suite.digest,
                which=choice.which,
            )
        )
    return found


def has_replays(bundle: Path) -> bool:
    """Return whether :func:`replays_of` returns any."""
    made = any((folder / FILE).is_file() for folder in (bundle.parent, bundle))
    return made or all((bundle / name).is_file() for name in FILES)


def replays_of(bundle: Path, policy: str) -> list[dict[str, Any]]:
    """Return the replays of the bundle in a folder; they are made only once, in some seconds.

    None are there if only a part of the bundle is, as of a shipped row without its replays.

    Raises
    ------
    InputError
        If it is no bundle.
    """
    for path in (bundle.parent / FILE, bundle / FILE):
        if path.is_file():
            replays: list[dict[str, Any]] = read_json(path)["replays"]
            return replays
    if not all((bundle / name).is_file() for name in FILES):
        return []
    made = chosen_replays(read_bundle(bundle), policy)
    with contextlib.suppress(OSError):  # Where nothing can be written, they are made again.
        write_json(bundle.parent / FILE, {"replays": made}, indent=None)
    return made
