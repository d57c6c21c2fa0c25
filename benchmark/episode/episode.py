"""One episode: an agent at the robot's end, a scripted human at the other, and what came of it."""

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
"""How the reason of a failure begins if the policy could not be made or reset."""

STEP: Final = "step "
"""How it begins if the policy failed in a step; after a drop of the table it begins otherwise."""


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
    """What each call of the policy took [s]; with the next, all that differs between two runs."""
    policy_time: float = 0.0
    """What the policy took in all [s]: to be made and reset, and for its steps, with a last one
    that failed. Not kept in files."""
    log: str = ""
    """The end of what the policy printed, if it was kept apart."""


def policy_seed() -> int:
    """Return the seed that a policy is reset with: the same in every episode, public or hidden.

    A policy's seed must tell nothing of the episode. One derived from the episode's would not do:
    there are few enough public seeds to try them all. A policy that wants to vary from episode to
    episode can mix its first observation in, which carries the sensors' noise.
    """
    return derive_seed(0, "policy")


def run_episode(lift: Lift, partner: Agent, seed: int) -> Episode:
    """Play one episode and score it.

    Whatever the partner does, this returns: an exception or an unusable action of the partner
    ends the episode with the reason, and the remaining frames count as the worst.

    Parameters
    ----------
    lift
        The lift; it is reset here and may be used for any number of episodes.
    partner
        Who acts at the robot's end.
    seed
        The episode's seed: plan, noise and human follow from it, whoever the partner is.

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
    """Return what a partner says of its last action; raises if these are not named numbers."""
    return {str(name): float(value) for name, value in partner.internals().items()}


def _log(partner: Agent) -> str:
    """Return what a partner has printed, where that is kept."""
    return partner.printed if isinstance(partner, Printing) else ""
