"""The PettingZoo parallel environment ``colift_v0``."""

from copy import deepcopy
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from colift.agents.actions import checked_action
from colift.agents.agent import Action, Agent, Observation
from colift.base.engine import require_engine
from colift.benchmark.environment.drawing import Drawing, make_drawing
from colift.benchmark.environment.moment import Moment, bring_to, check_same_settings
from colift.benchmark.environment.rewards import SCORE, TASK_REWARD, check_reward, score_rewards
from colift.benchmark.environment.settings import (
    HUMAN,
    ROBOT,
    action_space,
    check_names,
    check_options,
    check_times,
    observation_space,
)
from colift.benchmark.environment.state import state_space, true_state
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.rendering.modes import check_render_mode
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.benchmark.suites.catalogue import TASK, make_scenario
from colift.benchmark.tasks.worlds import lift_after
from gymnasium.spaces import Box
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

if TYPE_CHECKING:
    from colift.benchmark.rendering.scene import Scene


# PettingZoo has no type information.
class ParallelLift(ParallelEnv[str, Observation, Action]):  # type: ignore[misc]
    r"""A human and a robot lift a table together; both are agents.

    Robot's observation, float64, indices of :class:`~colift.agents.agent.RobotObservation`:

    === ======================================================================
    0   height of the human's table end [m]: motion capture, ``latency`` old
    1   height of the robot's table end [m]: the same sample
    2   height of the robot's hand [m]: encoders, age 0
    3   command of the robot's hand [m], age 0
    4   time [s]
    === ======================================================================

    Robot's action, shape ``(1,)`` or a plain number: change of the hand command in this step [m],
    clipped to +-0.04 for a period of 100 ms (0.4 m/s; see
    :func:`~colift.agents.actions.action_limit`).

    Human's observation for ``n`` frames per step (10 for a period of 100 ms), slices of
    :class:`~colift.agents.agent.HumanObservation`, histories oldest first:

    ============ =============================================================
    0 to 9       height of the human's own end [m] in the last ten frames
    10 to 19     its velocity [m/s]
    20 to 29     height of the other end [m], as old as the visual delay
    30 to 39     force of the hands on the table [N], as old as the haptic delay
    40 to 39+n   private target: the intended height [m] in the next n frames
    40+n         time [s]
    ============ =============================================================

    Human's action, shape ``(n,)``: hand reference height [m] for each frame of the step.

    With ``partner="human"`` the agent "robot" is a second human: it has the human's spaces, and
    its target is to be level (the height at which it sees the other end).

    Rewards [m] at the end of a step, with the heights Z1 of the human's and Z2 of the robot's end:
    the robot's is ``-|Z1 - Z2|`` (the integrand of the paper's eq. 10), the human's
    ``-|Z1 - target| - |Z1 - Z2|``. Or, with ``reward="score"``, those of :func:`.score_rewards`.
    The episode is terminated when the table is dropped (``infos[agent]["dropped"]`` is the reason)
    and truncated at its horizon.

    Parameters
    ----------
    scenario
        The lift, see :class:`~colift.benchmark.episode.scenario.Scenario`.
    render_mode
        ``None``, ``"rgb_array"`` (headless) or ``"human"`` (a window).
    reward
        A name of :data:`.REWARDS`.
    drawing
        Draws the lift of each reset; ``scenario`` is then one of its scenarios. None: all lifts
        are of ``scenario``.

    Raises
    ------
    InputError
        If there is no such reward for the scenario's task.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 - PettingZoo's convention
        "name": "colift_v0",
        "render_modes": ["human", "rgb_array"],
        "render_fps": 10,
        "is_parallelizable": True,
    }

    def __init__(
        self,
        scenario: Scenario,
        render_mode: str | None = None,
        *,
        reward: str = TASK_REWARD,
        drawing: Drawing | None = None,
    ) -> None:
        require_engine()
        check_render_mode(render_mode)
        check_reward(reward, scenario.task)
        self.render_mode = render_mode
        self.metadata = {**type(self).metadata, "render_fps": 1 / scenario.control_period}
        self._reward, self._drawing = reward, drawing
        self.lift = Lift(scenario)
        self.possible_agents = [HUMAN, ROBOT]
        self.agents: list[str] = []
        agents = self.possible_agents
        self.observation_spaces = {agent: observation_space(self.lift, agent) for agent in agents}
        self.action_spaces = {agent: action_space(self.lift, agent) for agent in agents}
        self.state_space = state_space(*(self.observation_spaces[agent] for agent in agents))
        self._seen: dict[str, Observation] = {}
        self._actions: list[tuple[list[float], list[float]]] = []
        self._human: Agent | None = None
        """The human of a restored moment, who has kept up, until the next step."""
        self._rng = np.random.default_rng()
        self._scene: Scene | None = None
        self._begun = self._closed = False

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the parts of a copy, which goes on with the episode; see :meth:`restore`.

        A reset of it without a seed begins the episode that the original's would. Copies of an
        environment that was never reset have different episodes, as those of vector environments
        need. Copies share neither a world nor a generator.
        """
        make = partial(type(self), reward=self._reward, drawing=self._drawing)
        known = (deepcopy(self._rng), self.save()) if self._begun else None
        return make, (self.lift.scenario, self.render_mode), known

    def __setstate__(self, known: tuple[np.random.Generator, Moment]) -> None:
        """Go on as the original of this copy."""
        self._rng, moment = known
        self.restore(moment)

    def observation_space(self, agent: str) -> Box:
        """Return the observation space of ``agent``."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """Return the action space of ``agent``."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        """Begin an episode; the same ``seed`` gives the same plan and noise, bit for bit.

        If lifts are drawn, it also gives the same person and behaviour, and the ``infos`` have the
        name of the drawn ``scenario`` and the ``seed`` of its lift.

        Without a seed the episode follows from the last seed given, or from the system's
        entropy if there was none.

        Raises
        ------
        InputError
            If an option names a setting such as ``subject``: settings are fixed when the
            environment is made. Other options are ignored.
        RuntimeError
            If the environment is closed.
        """
        self._check_open()
        check_options(options, others=True)
        if seed is not None:
            self._rng = np.random.default_rng(seed)
        else:
            seed = int(self._rng.integers(2**62))
        scenario = self.lift.scenario
        if self._drawing is not None:
            scenario, seed = self._drawing.lift(seed)
        return self.restore(Moment(scenario, seed, ()))

    def save(self) -> Moment:
        """Return the present moment of the episode, for :meth:`restore`.

        Raises
        ------
        RuntimeError
            If no episode has begun.
        """
        self._check_begun()
        return Moment(self.lift.scenario, self.lift.seed, tuple(self._actions))

    def restore(self, moment: Moment) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        """Return to a moment, and return the observations and the ``infos`` of its :meth:`reset`.

        Its actions are played again, so that all is as it was, bit for bit; this takes about as
        long as it took to get there. The moment may be of another environment with the same
        settings, or of another process. The generator of later episodes stays as it is.

        Raises
        ------
        InputError
            If the settings are others.
        RuntimeError
            If the environment is closed.
        """
        self._check_open()
        drawing = self._drawing or Drawing(scenarios=(self.lift.scenario,), new_people=False)
        check_same_settings(moment, drawing.scenarios, new_people=drawing.new_people)
        if moment.scenario is not self.lift.scenario:
            self.lift = lift_after(self.lift, moment.scenario)
        self._human = bring_to(self.lift, moment)
        self._actions = list(moment.actions)
        self._begun = True
        self.agents = [] if self.lift.done else list(self.possible_agents)
        self._render_in_window()
        drawn = self._drawing is not None
        info = {"scenario": moment.scenario.name, "seed": moment.seed} if drawn else {}
        return self._observations(), {agent: dict(info) for agent in self.possible_agents}

    def step(
        self, actions: dict[str, Action]
    ) -> tuple[
        dict[str, Observation],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Advance by one control period.

        Raises
        ------
        ValueError
            If an action is missing, of the wrong shape or not finite, or of an unknown agent.
        RuntimeError
            If the episode is over, none has begun, or the environment is closed.
        """
        self._check_open()
        if not self.agents:
            raise RuntimeError("the episode is over or has not begun: call reset() first")
        missing = [agent for agent in self.agents if agent not in actions]
        if missing:
            raise ValueError(f"actions must name every agent, missing: {', '.join(missing)}")
        unknown = [agent for agent in actions if agent not in self.agents]
        if unknown:
            raise ValueError(f"actions must be of {' and '.join(self.agents)}, got {unknown}")
        lift = self.lift
        human = checked_action(HUMAN, actions[HUMAN], lift.frames_per_step)
        robot = checked_action(ROBOT, actions[ROBOT], lift.partner_size)
        lift.carry_out(human, robot)
        self._actions.append((human, robot))
        self._human = None
        rewards = score_rewards(lift) if self._reward == SCORE else lift.task.rewards(lift)
        dropped, truncated = lift.dropped is not None, lift.truncated
        agents = self.agents
        info = {"dropped": lift.dropped} if dropped else {}
        result = (
            self._observations(),
            dict(zip((HUMAN, ROBOT), rewards, strict=True)),
            dict.fromkeys(agents, dropped),
            dict.fromkeys(agents, truncated),
            {agent: dict(info) for agent in agents},
        )
        if dropped or truncated:
            self.agents = []
        self._render_in_window()
        return result

    def state(self) -> NDArray[np.float64]:
        """Return the global state, for a critic that is trained with it; no agent sees it.

        It begins with the numbers of :class:`.TrueState`, which are true and now. The human's and
        the robot's latest observations follow.

        Raises
        ------
        RuntimeError
            If no episode has begun.
        """
        self._check_begun()
        return np.concatenate([true_state(self.lift), *(self._seen.values())])

    def scripted_human(self) -> Agent:
        """Return the agent that carries out the current episode's private plan, from now on.

        Raises
        ------
        RuntimeError
            If no episode has begun.
        """
        self._check_begun()
        human, self._human = self._human, None
        if self.lift.frame == 0:
            return self.lift.scripted_human()
        return human or bring_to(self.lift, self.save())

    def render(self) -> NDArray[np.uint8] | None:
        """Return a picture of the lift (``"rgb_array"``), or draw it in the window."""
        if self.render_mode is None:
            return None
        if self._scene is None:
            from colift.benchmark.rendering.scene import Scene

            window = self.render_mode == "human"
            self._scene = Scene(self.lift.scenario.partner, window=window)
        world = self.lift.world
        self._scene.pose(world.human_end[-1], world.robot_end[-1])
        return self._scene.picture() if self.render_mode == "rgb_array" else None

    def _render_in_window(self) -> None:
        if self.render_mode == "human":
            self.render()

    def close(self) -> None:
        """Release the world and the scene; a closed environment cannot be used again."""
        self._closed = True
        self.lift.close()
        if self._scene is not None:
            self._scene.close()
            self._scene = None

    def _check_open(self) -> None:
        if self._closed:
            raise RuntimeError("the environment is closed: make a new one")

    def _check_begun(self) -> None:
        if not self._begun:
            raise RuntimeError("no episode has begun: call reset() first")

    def _observations(self) -> dict[str, Observation]:
        found = {HUMAN: self.lift.human_observation(), ROBOT: self.lift.partner_observation()}
        self._seen = {agent: seen.copy() for agent, seen in found.items()}
        return found


def parallel_env(
    behaviour: str = "smooth",
    subject: str = "S1",
    partner: str = DEFAULT_ROBOT,
    control_period: float = CONTROL_PERIOD,
    latency: float = LATENCY,
    render_mode: str | None = None,
    reward: str = TASK_REWARD,
    task: str = TASK,
) -> ParallelLift:
    """Return the parallel environment of a behaviour, a person and a task.

    Parameters
    ----------
    behaviour
        Name of the human's behaviour, such as ``"smooth"`` or ``"pause"``; ``"any"`` draws one of
        the task's at each reset.
    subject
        Name of the human: ``"S1"`` to ``"S5"``, or ``"draw-N"``; ``"draw"`` draws a new person at
        each reset.
    partner
        Who holds the robot's end: a robot, such as ``"nao"``, or ``"human"``.
    control_period
        Time between two decisions [s], a multiple of 10 ms.
    latency
        Age of the robot's motion-capture sample [s], a multiple of 10 ms.
    render_mode
        ``None``, ``"rgb_array"`` or ``"human"``.
    reward
        ``"task"``, the task's own reward, for ``level`` the height difference at the end of a step
        [m]; or ``"score"``, the mean square over its frames [cm2].
    task
        Name of the task, such as ``"level"`` or ``"intent"``; it determines the observations, their
        bounds, the rewards, the end and the behaviours that are drawn.

    Raises
    ------
    InputError
        If a name is unknown (the message lists the known ones) or a time is out of range.
    """
    check_names(behaviour=behaviour, subject=subject, partner=partner, task=task)
    check_times(control_period=control_period, latency=latency)
    drawing = make_drawing(behaviour, subject, partner, control_period, latency, task)
    if drawing is None:
        made = make_scenario(behaviour, subject, partner, control_period, latency, task)
    else:
        made = drawing.scenarios[0]
    return ParallelLift(made, render_mode, reward=reward, drawing=drawing)
