"""Lifts with a policy: independent ones, or those of a session."""

import contextlib
import dataclasses
import time
from collections.abc import Iterator, Sequence

from colift.agents.agent import Action, Agent, Explaining, Observation, Printing, Resuming
from colift.agents.spec import AgentSpec, Paced
from colift.base.errors import EvaluatorFault
from colift.benchmark.channels import Channel
from colift.benchmark.channels.teleoperated import teleoperated
from colift.benchmark.episode.blame import blaming_plugins, check_episode, check_start
from colift.benchmark.episode.loop import Episode, run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.turns import is_policy_failure
from colift.benchmark.execution.sessions import after
from colift.benchmark.suites.suite import Due
from colift.benchmark.tasks.worlds import played_lift


def play(
    policy: AgentSpec,
    scenario: Scenario,
    seeds: tuple[int, ...],
    channel: Channel | None = None,
) -> Iterator[Episode]:
    """Play the scenario with each seed, with a new policy object for each episode.

    A channel is outside the policy's sandbox.

    Raises
    ------
    EvaluatorFault
        If the machine failed.
    InputError
        If the task or the behaviour of another package failed, or broke one of its rules.
    """
    policy = _paced(policy, scenario)
    with contextlib.ExitStack() as kept:
        with blaming_plugins(scenario, seeds[0]):
            lift = kept.enter_context(played_lift(scenario))
            check_start(lift, seeds[0])
        for seed in seeds:
            with contextlib.ExitStack() as stack:
                begin = time.perf_counter()
                agent = entered(stack, policy)
                made = time.perf_counter() - begin
                if channel is not None:
                    agent = teleoperated(agent, channel, scenario, seed)
                with blaming_plugins(scenario, seed):
                    episode = run_episode(lift, agent, seed)
                    check_episode(lift, episode)
                taken = made + episode.policy_time
                yield dataclasses.replace(episode, policy_time=taken)


def play_session(
    policy: AgentSpec, lifts: Sequence[Due], channel: Channel | None = None
) -> Iterator[Episode]:
    """Play the lifts of one session in order, with one policy object.

    A policy that fails in a lift is made anew for the next one, and then knows nothing.

    Raises
    ------
    EvaluatorFault, InputError
        As :func:`play`.
    """
    scenario = lifts[0].scenario
    policy = _paced(policy, scenario, len(lifts))
    with contextlib.ExitStack() as stack:
        session: Agent | None = None
        for due in lifts:
            begin = time.perf_counter()
            if session is None:
                stack.close()
                session = in_session(entered(stack, policy))
            made = time.perf_counter() - begin
            agent = session
            if channel is not None:
                agent = teleoperated(session, channel, scenario, due.seed)
            with blaming_plugins(scenario, due.seed), played_lift(scenario) as lift:
                episode = run_episode(lift, agent, due.seed)
                check_episode(lift, episode)
                scenario = after(scenario, episode.trace)
            if is_policy_failure(episode.failure):
                session = None
            yield dataclasses.replace(episode, policy_time=made + episode.policy_time)


def _paced(policy: AgentSpec, scenario: Scenario, lifts: int = 1) -> AgentSpec:
    """Return a policy with the time budgets of some lifts of a scenario."""
    return policy.paced(scenario.control_period, lifts) if isinstance(policy, Paced) else policy


class _Unmade:
    """Stands in for an agent whose constructor failed: fails in the same way at the reset."""

    def __init__(self, error: BaseException) -> None:
        self._error = error

    def reset(self, seed: int) -> None:
        raise self._error

    def act(self, observation: Observation) -> Action:
        raise self._error


def entered(stack: contextlib.ExitStack, policy: AgentSpec) -> Agent:
    """Return a new agent of a policy; leaving the stack closes it.

    The agent of a policy that cannot be made fails at its reset, with the same error.
    """
    try:
        return stack.enter_context(policy.agent())
    except EvaluatorFault:
        raise
    except (Exception, SystemExit) as error:
        return _Unmade(error)


class _Session:
    """An agent whose first ``reset`` begins a session, and whose others go on with it."""

    def __init__(self, agent: Agent) -> None:
        self._agent, self._begun = agent, False

    def reset(self, seed: int) -> None:
        if self._begun and isinstance(self._agent, Resuming):
            self._agent.resume(seed)
        else:
            self._agent.reset(seed)
        self._begun = True

    def act(self, observation: Observation) -> Action:
        return self._agent.act(observation)

    @property
    def printed(self) -> str:
        return self._agent.printed if isinstance(self._agent, Printing) else ""


class _ExplainingSession(_Session):
    """The same of an agent that explains its actions."""

    def __init__(self, agent: Agent, explaining: Explaining) -> None:
        super().__init__(agent)
        self._explaining = explaining

    def internals(self) -> dict[str, float]:
        return self._explaining.internals()


def in_session(agent: Agent) -> Agent:
    """Return an agent whose first ``reset`` begins a session, and whose others go on with it."""
    return _ExplainingSession(agent, agent) if isinstance(agent, Explaining) else _Session(agent)
