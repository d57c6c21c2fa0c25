"""One episode: an agent at the robot's end, a scripted human at the other, and the outcome."""

import time
from dataclasses import dataclass
from typing import Final

from ...agents.actions import ActionError, checked_action
from ...agents.agent import Agent, Explaining, Printing
from ...agents.errors import EvaluatorFault, error_text
from .lift import Lift
from .metric import Scores
from .recorder import Recorder
from .seeding import derive_seed
from .trace import Trace

START: Final = "start: "
"""Prefix of a failure's reason if the policy could not be made or reset."""

STEP: Final = "step "
"""Prefix if the policy failed in a step; the reason of a dropped table has neither prefix."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Episode:
    """The outcome of one episode."""

    behaviour: str
    subject: str
    trial: str
    """Name of the recording, empty for a drawn plan."""
    seed: int
    scores: Scores
    failure: str | None
    """Why the episode ended early, or nothing if it did not."""
    trace: Trace
    step_times: tuple[float, ...]
    """Duration of each call of the policy [s]; with the next, all that differs between two runs."""
    policy_time: float = 0.0
    """Total duration of the policy [s]: construction, reset and all steps, a failed last one
    included. Not kept in files."""
    log: str = ""
    """The end of the policy's printed output, if it ran in a process of its own."""


def policy_seed() -> int:
    """Return the seed that a policy is reset with: the same in every episode, public or hidden.

    A policy's seed must reveal nothing about the episode. One derived from the episode's seed
    would: the public seeds are few enough to try them all. A policy that wants to vary between
    episodes can use its first observation, which carries the sensors' noise.
    """
    return derive_seed(0, "policy")


def run_episode(lift: Lift, partner: Agent, seed: int) -> Episode:
    """Play one episode and score it.

    It returns in every case: an exception or an unusable action of the partner ends the episode
    with the reason, and each remaining frame counts as the worst.

    Parameters
    ----------
    lift
        The lift; it is reset here and may be used for any number of episodes.
    partner
        The agent at the robot's end.
    seed
        The episode's seed: plan, noise and human follow from it, with any partner.

    Raises
    ------
    EvaluatorFault
        If the partner's machine failed, and not the partner.
    """
    lift.reset(seed)
    human, frames = lift.scripted_human(), lift.frames_per_step
    recorder = Recorder(lift)
    times: list[float] = []
    begin = time.perf_counter()
    failure = _start(partner)
    taken = time.perf_counter() - begin
    explaining = partner if isinstance(partner, Explaining) else None
    while failure is None and not lift.done:
        observation = lift.partner_observation()
        begin = time.perf_counter()
        try:
            try:
                chosen = partner.act(observation)
            finally:
                taken += (last := time.perf_counter() - begin)
            times.append(last)
            action = checked_action("robot", chosen, lift.partner_size)
            said = {} if explaining is None else _internals(explaining)
        except EvaluatorFault:
            raise
        except (Exception, SystemExit) as error:
            reason = error if isinstance(error, ActionError) else error_text(error)
            failure = f"{STEP}{recorder.steps}: {reason}"
            break
        reference = checked_action("human", human.act(lift.human_observation()), frames)
        lift.carry_out(reference, action)
        recorder.step(reference, action, said)
    failure = failure or lift.dropped
    trace, scenario = recorder.trace(), lift.scenario
    return Episode(
        behaviour=scenario.behaviour,
        subject=scenario.subject.name,
        trial=scenario.trial,
        seed=seed,
        scores=lift.task.score(lift, trace, failed=failure is not None),
        failure=failure,
        trace=trace,
        step_times=tuple(times),
        policy_time=taken,
        log=_log(partner),
    )


def _start(partner: Agent) -> str | None:
    """Reset the partner; return why that failed, or None."""
    try:
        partner.reset(policy_seed())
    except EvaluatorFault:
        raise
    except (Exception, SystemExit) as error:
        return f"{START}{error_text(error)}"
    return None


def _internals(partner: Explaining) -> dict[str, float]:
    """Return the partner's explanation of its last action; raise if it is not named numbers."""
    return {str(name): float(value) for name, value in partner.internals().items()}


def _log(partner: Agent) -> str:
    """Return the partner's printed output, if it is captured."""
    return partner.printed if isinstance(partner, Printing) else ""
