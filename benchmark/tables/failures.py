"""The report of a policy's failures, with the end of its output; the early end of a dead one."""

from collections.abc import Iterator
from typing import Final

from colift.benchmark.bundle import one_line
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.turns import START, STEP
from colift.benchmark.execution.runner import Run
from colift.benchmark.tables.printing import counted

LINES: Final = 20
"""Lines of the output that are shown."""

DEAD: Final = 10
"""Number of lifts that must all fail at once before a run ends early."""


class DeadPolicyError(Exception):
    """All of the first :data:`DEAD` lifts failed at once; they are in :attr:`episodes`."""

    def __init__(self, episodes: tuple[Episode, ...]) -> None:
        super().__init__(episodes[0].failure)
        self.episodes = episodes


class LifeWatch:
    """Watches the episodes of a run, and ends it if the policy is dead."""

    def __init__(self) -> None:
        self._alive = False
        self._dead: dict[int, Episode] = {}

    def __call__(self, place: int, episode: Episode) -> None:
        """Watch an episode; raise a DeadPolicyError if it is the last that had to be awaited."""
        failure = episode.failure or ""
        self._alive = self._alive or not failure.startswith((START, f"{STEP}0:"))
        if self._alive:
            return
        self._dead[place] = episode
        if len(self._dead) >= DEAD:
            raise DeadPolicyError(tuple(self._dead[each] for each in sorted(self._dead)))


def printed_lines(printed: str) -> list[str]:
    """Return the end of a policy's output as indented lines, without control sequences."""
    last = printed.strip().splitlines()[-LINES:]
    return ["it printed:", *(f"    {one_line(line)}" for line in last)] if last else []


def reported_failures(run: Run) -> Iterator[str]:
    """Yield the number of failed lifts of a run, the first with its reason, and its output."""
    failed = [episode for episode in run.episodes if episode.failure is not None]
    if failed:
        first = failed[0]
        count = "counts" if len(failed) == 1 else "count"
        yield (
            f"{len(failed)} of {counted(len(run.episodes), 'lift')} failed and {count} as worst; "
            f"the first, {first.behaviour}/{first.subject} seed {first.seed}: {first.failure}"
        )
        yield from printed_lines(first.log)
