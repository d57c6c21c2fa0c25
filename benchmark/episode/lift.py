"""The lift: sensors, actions and time on top of a world, independent of PettingZoo."""

from collections.abc import Callable, Sequence
from typing import Final, Protocol, runtime_checkable

import numpy as np
from colift.agents.actions import action_limit, checked_action
from colift.agents.agent import FRAME, HISTORY, Agent, HumanObservation, Observation
from colift.agents.humans import Embodied, Plan, ScriptedHuman, Subject
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import body_parameters, within_range
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.world import HISTORY_FRAMES, BodyParameters, FarEnd, Intended, World
from numpy.typing import ArrayLike, NDArray

MOCAP_NOISE: Final = 0.00023
"""Standard deviation of a motion-capture height [m]; the system of the paper is precise within
0.7 mm (section II.A), read as three standard deviations."""

MakeWorld = Callable[[BodyParameters, FarEnd], World]
"""Returns a world of a person and a holder of the far end."""


class Lift:
    """One human, one partner, one table, from rest to rest.

    A step is one control period of the robot: ``frames_per_step`` frames. The robot's action
    changes its hand command, which moves at constant speed over the period; the human's action
    is a hand reference for each frame. A step is made as a whole, by :meth:`step`, or frame by
    frame while a person moves: :meth:`commands`, :meth:`move` for each frame, :meth:`end`. The
    results are equal bit for bit.

    Parameters
    ----------
    scenario
        The people, the task and the timing.
    world
        Makes the world of the human's body and the far end; the task's own world if None.
    """

    def __init__(self, scenario: Scenario, *, world: MakeWorld | None = None) -> None:
        self.scenario = scenario
        self.task = scenario.task
        self.seat = seat = scenario.seat
        self.frames_per_step = scenario.frames_per_step
        self.partner_size = seat.action_size(self.frames_per_step)
        self.step_limit = action_limit(scenario.control_period)
        self._human_delays = _delays(scenario.subject)
        self._partner_delays = (0, 0) if seat.person is None else _delays(seat.person)
        make = world or self.task.world
        self.world: World = make(body_parameters(scenario.subject), seat.body)

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``: draw the human's plan and the sensors' noise."""
        scenario = self.scenario
        self.world.reset()
        self.seed = seed
        self.plan: Plan = scenario.human.plan(scenario.subject, self.role_seed("plan"))
        size = self.frames_per_step
        steps = -(-len(self.plan.target) // size)
        self.horizon = steps * size
        target = np.full(self.horizon, self.plan.target[-1])
        target[: len(self.plan.target)] = self.plan.target
        self.target = target
        rng = np.random.default_rng(self.role_seed("sensor"))
        noise = rng.normal(0.0, MOCAP_NOISE, (2, HISTORY_FRAMES + self.horizon))
        self._human_noise, self._robot_noise = noise.tolist()
        self.frame = 0
        self.command = 0.0
        self.dropped: str | None = None

    def role_seed(self, role: str) -> int:
        """Return the episode's seed of a role, independent of those of other scenarios."""
        return derive_seed(self.seed, f"{role}/{self.scenario.name}")

    @property
    def truncated(self) -> bool:
        """Whether the horizon has been reached."""
        return self.frame >= self.horizon

    @property
    def done(self) -> bool:
        """Whether the episode is over, by the horizon or by a drop."""
        return self.dropped is not None or self.frame >= self.horizon

    def scripted_human(self) -> Agent:
        """Return the agent that executes the human's plan, reset for the current episode."""
        behaviour, subject = self.scenario.human, self.scenario.subject
        human: Agent = ScriptedHuman(subject=subject)
        if isinstance(behaviour, Embodied):
            human = behaviour.person(subject)
        human.reset(self.role_seed("human"))
        return human

    def step(self, human: ArrayLike, partner: ArrayLike) -> None:
        """Advance by one control period.

        Parameters
        ----------
        human
            Hand reference for each frame [m], shape ``(frames_per_step,)``.
        partner
            The robot's change of its hand command [m], shape ``(1,)``, clipped to the hand's speed
            and stroke; or the second human's hand references, as ``human``.

        Raises
        ------
        ActionError
            If an action has the wrong shape or is not finite.
        """
        self.carry_out(
            checked_action("human", human, self.frames_per_step),
            checked_action("robot", partner, self.partner_size),
        )

    def carry_out(self, human: list[float], partner: list[float]) -> None:
        """Advance by one control period, by two actions that :func:`.checked_action` returned."""
        commands = self.commands(partner)
        self.move(human, commands)
        self.end(commands[-1])

    def commands(self, partner: list[float]) -> Sequence[float]:
        """Return the heights to reach at the far end, one per frame, for its holder's action."""
        return self.seat.commands(self, partner)

    def move(self, human: Sequence[float], commands: Sequence[float]) -> None:
        """Advance by a frame for each hand reference and command of the far end [m]."""
        self.world.advance(within_range(human), commands, self.intended_in(human))

    def intended_in(self, human: Sequence[float]) -> Intended | None:
        """Return the person's intention in the frames of some hand references."""
        return None

    def end(self, command: float) -> None:
        """End the control period after all of its frames, with its last command [m]."""
        self.command = command
        self.frame += self.frames_per_step
        self.dropped = self.task.failure(self)

    def partner_observation(self) -> Observation:
        """Return the observation of the holder of the robot's end."""
        return self.seat.observation(self.task, self)

    def human_observation(self) -> Observation:
        """Return the human's observation."""
        return self.task.human_observation(self)

    def robot_view(self) -> Observation:
        """Return the robot's senses now, laid out as :class:`.RobotObservation`."""
        world, age = self.world, self.scenario.latency_frames
        sample = -1 - age
        noise = self.frame + HISTORY_FRAMES - 1 - age
        return np.array(
            (
                world.human_end[sample] + self._human_noise[noise],
                world.robot_end[sample] + self._robot_noise[noise],
                world.hand_height,
                self.command,
                self.frame * FRAME,
            )
        )

    def human_view(self, target: Observation) -> Observation:
        """Return the human's senses now, laid out as :class:`.HumanObservation`.

        ``target`` is the private target: the intended height in each frame of the step [m].
        """
        world = self.world
        return self._senses(
            world.human_end,
            world.human_velocity,
            world.robot_end,
            world.human_force,
            target,
            self._human_delays,
        )

    def partner_view(self, target: Observation) -> Observation:
        """Return the senses of a second human at the robot's end, as :meth:`human_view`."""
        world = self.world
        return self._senses(
            world.robot_end,
            world.robot_velocity,
            world.human_end,
            world.robot_force,
            target,
            self._partner_delays,
        )

    def seen_by_partner(self) -> float:
        """Return the height of the human's end [m] that a second human sees now."""
        return self.world.human_end[-1 - self._partner_delays[0]]

    def clipped(self, actions: NDArray[np.float64]) -> float:
        """Return the share of actions beyond the hands' speed; NaN for a second human."""
        return self.seat.clipped(actions, self.step_limit)

    def _senses(
        self,
        own: list[float],
        velocity: list[float],
        other: list[float],
        force: list[float],
        target: Observation,
        delays: tuple[int, int],
    ) -> Observation:
        seen, felt = len(other) - delays[0], len(force) - delays[1]
        view = np.empty(HumanObservation.size(self.frames_per_step))
        view[HumanObservation.OWN_HEIGHT] = own[-HISTORY:]
        view[HumanObservation.OWN_VELOCITY] = velocity[-HISTORY:]
        view[HumanObservation.OTHER_END] = other[seen - HISTORY : seen]
        view[HumanObservation.HAND_FORCE] = force[felt - HISTORY : felt]
        # Beyond a truncated horizon the person intends to stay.
        view[HumanObservation.TARGET] = target if len(target) else self.target[-1]
        view[HumanObservation.TIME] = self.frame * FRAME
        return view

    def close(self) -> None:
        """Release the world."""
        self.world.close()


def _delays(person: Subject) -> tuple[int, int]:
    """Return a person's visual and haptic delay in frames."""
    return round(person.visual_delay / FRAME), round(person.haptic_delay / FRAME)


@runtime_checkable
class Staging(Protocol):
    """A task with its own class of lifts."""

    def lift(self, scenario: Scenario) -> Lift:
        """Return the lift of a scenario of the task."""


def make_lift(scenario: Scenario, world: MakeWorld | None = None) -> Lift:
    """Return the lift of a scenario, of the class that its task requires."""
    task = scenario.task
    return task.lift(scenario) if isinstance(task, Staging) else Lift(scenario, world=world)
