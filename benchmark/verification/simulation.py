"""Has the episodes of a bundle simulated again, here or on any executor."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, as_completed

from ...agents.errors import EvaluatorFault, told
from ..bundle import Bundle
from ..suite import Suite
from ..tasks import SEEDS_PER_TASK
from .episode_check import Checked, EpisodeCheck


def simulate(
    bundle: Bundle,
    suite: Suite,
    *,
    same_platform: bool,
    executor: Executor | None,
    progress: Callable[[int], None],
) -> list[Checked]:
    """Return what the replay of each episode shows, in the order of the bundle.

    Raises
    ------
    EvaluatorFault
        If a worker died.
    """
    found: list[Checked] = []
    for part in _parts(episode_checks(bundle, suite, same_platform), executor):
        found += part
        progress(len(part))
    return sorted(found, key=lambda checked: checked.place)


def episode_checks(bundle: Bundle, suite: Suite, same_platform: bool) -> list[EpisodeCheck]:
    """Return the work, cut as :func:`.tasks.tasks` cuts that of a run."""
    seeds = len(suite.seeds)
    members: dict[tuple[int, int], list[int]] = {}
    for i, place in enumerate(bundle.places):
        row, column = divmod(place, seeds)
        members.setdefault((row, column // SEEDS_PER_TASK), []).append(i)
    return [
        EpisodeCheck(
            scenario=suite.scenarios[row],
            seeds=tuple(suite.seeds[bundle.places[i] % seeds] for i in some),
            places=tuple(bundle.places[i] for i in some),
            episodes=tuple(bundle.episodes[i] for i in some),
            same_platform=same_platform,
        )
        for (row, _), some in members.items()
    ]


def _parts(
    checks: Sequence[EpisodeCheck], executor: Executor | None
) -> Iterator[Sequence[Checked]]:
    if executor is None:
        for check in checks:
            for checked in check.results():
                yield [checked]
        return
    futures = [executor.submit(check) for check in checks]
    try:
        for future in as_completed(futures):
            yield future.result()
    except Exception as error:
        raise EvaluatorFault(f"a worker of the verification failed: {told(error)}") from error
    finally:
        for future in futures:
            future.cancel()
