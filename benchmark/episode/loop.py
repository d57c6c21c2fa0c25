"""One episode: an agent at the robot's end, a human at the other, and the outcome."""

from dataclasses import dataclass

from colift.agents.agent import Agent
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.metric import Scores
from colift.benchmark.episode.recorder import Recorder
from colift.benchmark.episode.trace import Trace
from colift.benchmark.episode.turns import Turns


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
    """Reason why the episode ended early; None if it did not."""
    trace: Trace
    step_times: tuple[float, ...]
    """Duration of each call of the policy [s]; only this and the next field differ between two
    runs."""
    policy_time: float = 0.0
    """Total duration of the policy [s]: construction, reset and all steps, a failed last one
    included. Not kept in files."""
    log: str = ""
    """The end of the policy's printed output, if it ran in a process of its own."""


def run_episode(lift: Lift, partner: Agent, seed: int) -> Episode:
    """Play one episode and score it.

    It always returns: an exception or an unusable action of the partner ends the episode with the
    reason, and each remaining frame counts with the worst error.

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
        If the machine failed, and not the partner.
    """
    lift.reset(seed)
    human = lift.human()
    recorder, turns = Recorder(lift), Turns(partner, lift.partner_size)
    turns.start()
    while turns.failure is None and not lift.done:
        turn = turns.ask(lift.partner_observation())
        if turn is None:
            break
        action, internals = turn
        reference = human.references()
        lift.carry_out(reference, action)
        recorder.step(reference, action, internals)
    return outcome(lift, recorder, turns)


def outcome(lift: Lift, recorder: Recorder, turns: Turns) -> Episode:
    """Return the outcome of a lift that has ended, by its horizon, a drop or the partner."""
    failure = turns.failure or lift.dropped
    trace, scenario = recorder.trace(), lift.scenario
    return Episode(
        behaviour=scenario.behaviour,
        subject=scenario.subject.name,
        trial=scenario.trial,
        seed=lift.seed,
        scores=lift.task.score(lift, trace, failed=failure is not None),
        failure=failure,
        trace=trace,
        step_times=tuple(turns.times),
        policy_time=turns.total,
        log=turns.log(),
    )
