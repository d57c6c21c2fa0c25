"""A lift that keeps the observations and rewards of both agents while it is played or replayed."""

from contextlib import closing

import numpy as np
from colift.agents.actions import action_limit
from colift.agents.agent import Observation
from colift.benchmark.environment.settings import HUMAN, ROBOT, action_space, observation_space
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.export.lifts import AgentView, ExportedLift, Spaces
from gymnasium.spaces import Box


class ObservedLift(Lift):
    """A lift that records both agents' observations before each step, and after the last.

    Parameters
    ----------
    scenario
        As for :class:`.Lift`.
    both
        Whether the human's part is also kept.
    converted
        Whether the holder of the robot's end is shown as a robot: with the robot's senses, and with
        the change of its reference over a step as its action. This is for a second human, who has
        ten references per step.
    """

    def __init__(self, scenario: Scenario, *, both: bool = False, converted: bool = False) -> None:
        super().__init__(scenario)
        self._both, self._converted = both, converted

    def reset(self, seed: int) -> None:
        """Begin an episode; see :meth:`.Lift.reset`."""
        super().reset(seed)
        self._seen: dict[str, list[Observation]] = {HUMAN: [], ROBOT: []}
        self._done: dict[str, list[list[float]]] = {HUMAN: [], ROBOT: []}
        self._rewards: list[tuple[float, float]] = []

    def carry_out(self, human: list[float], partner: list[float]) -> None:
        """Advance by one control period, and keep the observations, actions and rewards."""
        self._look()
        before = self.command
        super().carry_out(human, partner)
        action = partner
        if self._converted:
            limit = self.step_limit
            action = [min(max(self.command - before, -limit), limit)]
        self._done[ROBOT].append(action)
        if self._both:
            self._done[HUMAN].append(human)
        self._rewards.append(self.task.rewards(self))

    def exported(self, policy: str, failure: str | None, state: bytes) -> ExportedLift:
        """Return the episode that has just ended.

        Parameters
        ----------
        policy
            Name of the agent at the robot's end.
        failure
            Reason why it ended early, or None.
        state
            The hash of its last step; empty if there is none.
        """
        self._look()
        scenario = self.scenario
        return ExportedLift(
            scenario=scenario.name,
            behaviour=scenario.behaviour,
            subject=scenario.subject.name,
            trial=scenario.trial,
            seed=self.seed,
            policy=policy,
            robot=self._part(ROBOT, 1),
            human=self._part(HUMAN, 0) if self._both else None,
            dropped=self.dropped,
            failure=failure,
            state=state.hex(),
        )

    def _look(self) -> None:
        seen = self.robot_view() if self._converted else self.partner_observation()
        self._seen[ROBOT].append(seen)
        if self._both:
            self._seen[HUMAN].append(self.human_observation())

    def _part(self, agent: str, reward: int) -> AgentView:
        steps = len(self._rewards)
        return AgentView(
            observations=np.array(self._seen[agent]),
            actions=np.array(self._done[agent], dtype=np.float64).reshape(
                steps, -1 if steps else 0
            ),
            rewards=np.array([pair[reward] for pair in self._rewards], dtype=np.float64),
        )


def spaces(scenario: Scenario, *, converted: bool = False) -> Spaces:
    """Return the spaces of the agents of a scenario, as the environment has them.

    Parameters
    ----------
    scenario
        The scenario.
    converted
        Whether the holder of the robot's end is shown as a robot; see :class:`ObservedLift`.
    """
    with closing(Lift(scenario)) as lift:
        observations = {agent: observation_space(lift, agent) for agent in (HUMAN, ROBOT)}
        actions = {agent: action_space(lift, agent) for agent in (HUMAN, ROBOT)}
        if converted:
            low, high = lift.task.robot_bounds()
            limit = action_limit(scenario.control_period)
            observations[ROBOT] = Box(low, high, dtype=np.float64)
            actions[ROBOT] = Box(-limit, limit, (1,), np.float64)
    return Spaces(observations=observations, actions=actions)
