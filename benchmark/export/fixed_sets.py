"""The lifts of the fixed sets, made by rule: a smaller set is the beginning of a larger one."""

import hashlib
import json
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from colift.agents.humans import Recorded, Recording, load_recordings
from colift.base.errors import InputError
from colift.base.threads import one_thread
from colift.benchmark.episode.identity import plain, scores_hash
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.export.lifts import ExportedLift
from colift.benchmark.export.observing import ObservedLift
from colift.benchmark.export.rules import NAMES, agent, rule
from colift.benchmark.suites.catalogue import RECORDED, make_scenario, make_subject
from colift.benchmark.suites.ranges import TRAINING_PEOPLE
from colift.benchmark.tasks.level.task import BEHAVIOURS, LEVEL

FIRST_SEED: Final = TRAINING_PEOPLE[20_000]
"""Seed of the first lift and of its person: one of the training seeds, which no suite contains.
The training of ``learned`` used some of them, too."""

MOST_LIFTS: Final = 10_000
"""Number of lifts in the largest set."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SetLift:
    """One lift of a set, to be played."""

    scenario: Scenario
    seed: int
    kind: str
    """The agent at the robot's end; see :func:`.rules.agent`."""
    both: bool
    converted: bool

    def __call__(self) -> ExportedLift:
        """Return the lift; worker processes run this."""
        made = ObservedLift(self.scenario, both=self.both, converted=self.converted)
        with closing(made) as lift, one_thread():
            episode = run_episode(lift, agent(self.kind, self.seed), self.seed)
            return lift.exported(
                NAMES[self.kind], episode.failure, episode.trace.state[-1:].tobytes()
            )


def set_plan(
    name: str, lifts: int, *, both: bool = False, recordings: Path | None = None
) -> list[SetLift]:
    """Return the lifts of a set, to be played.

    Lift i has the seed ``FIRST_SEED + i``, the person of that seed and the behaviours of
    ``standard-v1`` in turn, or the recordings in turn.

    Parameters
    ----------
    name
        Name of the set.
    lifts
        Its size; results are compared on sets of 30, 300 and 3000 lifts.
    both
        Whether the human's part is kept. If so, people who hold the robot's end are not converted.
    recordings
        File of recordings, for the set that needs one.

    Raises
    ------
    InputError
        If there is no such set, the size is out of range, or the recordings are missing, not
        needed or cannot be used.
    """
    chosen = rule(name)
    if not 1 <= lifts <= MOST_LIFTS:
        raise InputError(f"--lifts must be from 1 to {MOST_LIFTS}, got {lifts}")
    if chosen.recorded and recordings is None:
        raise InputError(f"set {name!r} needs the motion of real people: --recordings FILE.csv")
    if not chosen.recorded and recordings is not None:
        raise InputError(f"set {name!r} has simulated people: it takes no --recordings")
    motions = () if recordings is None else load_recordings(recordings)
    return [
        SetLift(
            scenario=_scenario(FIRST_SEED + i, chosen.human, motions),
            seed=FIRST_SEED + i,
            kind=chosen.agents[_turn(i, motions) % len(chosen.agents)],
            both=both,
            converted=chosen.human and not both,
        )
        for i in range(lifts)
    ]


def play_set(
    plan: list[SetLift],
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> Iterator[ExportedLift]:
    """Yield the lifts of a plan, in order; with an executor, played there."""
    for lift in map(_called, plan) if executor is None else executor.map(_called, plan):
        progress(1)
        yield lift


def set_digest(plan: list[SetLift]) -> str:
    """Return a hash of all that determines the lifts, except the agents at the robot's end.

    It is made like that of a suite, from engine, people, plans and seeds.
    """
    sha = hashlib.sha256()
    heads = {"code": scores_hash()}
    lifts = ({"scenario": plain(lift.scenario), "seed": lift.seed} for lift in plan)
    for part in (heads, *lifts):
        sha.update(json.dumps(part, sort_keys=True, separators=(",", ":")).encode() + b"\n")
    return sha.hexdigest()[:16]


def _turn(index: int, motions: tuple[Recording, ...]) -> int:
    """Return the number by which agents take turns; each round begins with the next one.

    If they simply alternated, each behaviour or recording would always meet the same of two agents.
    """
    return sum(divmod(index, len(motions) or len(BEHAVIOURS)))


def _scenario(seed: int, human: bool, motions: tuple[Recording, ...]) -> Scenario:
    index, subject = seed - FIRST_SEED, f"draw-{seed}"
    if motions:
        motion = motions[index % len(motions)]
        return Scenario(
            behaviour=RECORDED,
            human=Recorded(recording=motion),
            trial=motion.name,
            subject=make_subject(subject),
            task=LEVEL,
        )
    behaviour = BEHAVIOURS[index % len(BEHAVIOURS)]
    return make_scenario(behaviour, subject, partner="human" if human else "nao")


def _called(lift: SetLift) -> ExportedLift:
    return lift()
