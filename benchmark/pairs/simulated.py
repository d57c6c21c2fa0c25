"""The simulated two people on the movements of recorded pairs."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
from colift.agents.agent import FRAME
from colift.agents.humans import AsRecorded, Trial
from colift.agents.humans.as_recorded import recorded_times
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import REFERENCE_RANGE
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.pairs.coordination import Coordination, Ends, coordination
from colift.benchmark.pairs.recorded import PairLift
from colift.benchmark.real_lifts.suites import RealLifts, beyond, lifts_as_recorded
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.statistics import FloatArray
from colift.benchmark.world.table import TABLE_LENGTH


@dataclass(frozen=True, kw_only=True)
class SimulatedPairs:
    """The measures of the simulated two people, by trial."""

    digest: str
    """Digest of the lifts; empty if there are none."""
    lifts: Mapping[str, Coordination]
    left_out: Mapping[str, str]
    """The reason why each other trial has none."""


def movements(lifts: Sequence[PairLift], source: str) -> RealLifts | None:
    """Return the movements of the near ends, at their own height and pace.

    It is None if none of them is within the heights that a simulated hand can have.
    """
    recordings = [each.trial.recording for each in lifts]
    if len(beyond(recordings, REFERENCE_RANGE)) == len(recordings):
        return None
    return lifts_as_recorded(recordings, source, REFERENCE_RANGE)


def simulated_pairs(
    lifts: Sequence[PairLift],
    real: RealLifts | None,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda lifts: None,
) -> SimulatedPairs:
    """Return the measures of the simulated two people on the movements of some lifts.

    The near hand moves as recorded, and the second person follows. The measures are of the frames
    in which the recording is played, without rests and return.

    Parameters
    ----------
    lifts
        The recorded lifts.
    real
        Their :func:`movements`; None if there are none.
    executor, progress
        As for :func:`.run_suite`.
    """
    trials = {each.name: each.trial for each in lifts}
    if real is None:
        reasons = beyond([each.recording for each in trials.values()], REFERENCE_RANGE)
        return SimulatedPairs(digest="", lifts={}, left_out=reasons)
    run = human_human_run(real.suite, executor=executor, progress=progress)
    found, left_out = {}, dict(real.left_out)
    for scenario, episode in zip(run.suite.scenarios, run.episodes, strict=True):
        if episode.failure is None:
            found[episode.trial] = coordination(_ends(trials[episode.trial], scenario, episode))
        else:
            left_out[episode.trial] = f"the simulated two people failed: {episode.failure}"
    return SimulatedPairs(digest=real.suite.digest, lifts=found, left_out=left_out)


def played_frames(scenario: Scenario, seed: int) -> slice:
    """Return the frames of a lift in which a recording is played as recorded."""
    first, times = _played(scenario, seed)
    return slice(first, first + len(times))


def _played(scenario: Scenario, seed: int) -> tuple[int, FloatArray]:
    """Return the first such frame, and the recorded time in each of them [s]."""
    human = scenario.human
    assert isinstance(human, AsRecorded)
    plan = human.plan(scenario.subject, derive_seed(seed, f"plan/{scenario.name}"))
    return recorded_times(human.recording, plan)


def _ends(trial: Trial, scenario: Scenario, episode: Episode) -> Ends:
    first, times = _played(scenario, episode.seed)
    frames, trace = slice(first, first + len(times)), episode.trace
    samples = np.searchsorted(trial.times - trial.times[0], times, side="right") - 1
    return Ends(
        times=FRAME * np.arange(len(times), dtype=np.float64),
        near=trace.human_end[frames],
        far=trace.robot_end[frames],
        length=TABLE_LENGTH,
        force=trace.human_force[frames],
        phases=tuple(np.array(trial.phases)[samples].tolist()) if trial.phases else (),
    )
