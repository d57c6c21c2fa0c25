"""One lift: the task on top of the world, without any library's dress."""

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from ...agents.actions import HAND_SPEED, checked_action
from ...agents.agent import FRAME, HISTORY, HumanObservation, Observation
from ...agents.humans import PARTNER_SUBJECT, Plan, ScriptedHuman, Subject
from ...robots.nao.kinematics import STROKE
from ..world import PHYSICS, BodyParameters, Physics, World
from ..world.human_body import HISTORY_FRAMES
from ..world.table import TABLE_LENGTH
from .scenario import Scenario
from .seeding import derive_seed

MOCAP_NOISE: Final = 0.00023
"""Standard deviation of a motion-capture height [m]; the system of the paper is precise within
0.7 mm (section II.A), read as three standard deviations."""

DROP_TILT: Final = math.radians(40)
"""A table inclined by more than this [rad] slides out of the hands."""

GRIP_FORCE: Final = 20.0
"""Mean force over a control period [N] above which the partner's two hands lose the table."""

GRIP_GAP: Final = 0.03
"""Distance between the NAO's hands and the table's end [m] at which the hold is lost."""

REFERENCE_RANGE: Final = (-0.2, 0.5)
"""Heights a human's hand reference is held to [m]."""


class Lift:
    """One human, one partner, one table, from rest to rest.

    A step is one control period of the robot: ``frames_per_step`` frames. The robot's action
    changes its hand command, which moves at constant speed over the period; the human's action
    is a hand reference for each frame.

    Parameters
    ----------
    scenario
        Who lifts how.
    physics
        Time step and solver of the world.
    """

    def __init__(self, scenario: Scenario, *, physics: Physics = PHYSICS) -> None:
        self.scenario = scenario
        self.frames_per_step = scenario.frames_per_step
        # How many numbers an action at the robot's end has.
        self.partner_size = 1 if scenario.partner == "nao" else self.frames_per_step
        self.step_limit = HAND_SPEED * scenario.control_period
        self._latency = scenario.latency_frames
        subject = scenario.subject
        self._human_delays = _delays(subject)
        self._partner_delays = _delays(PARTNER_SUBJECT)
        second = body_parameters(PARTNER_SUBJECT) if scenario.partner == "human" else None
        self.world = World(scenario.partner, body_parameters(subject), second, physics=physics)

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``: draw the human's plan and the sensors' noise."""
        scenario = self.scenario
        self.world.reset()
        self.seed = seed
        self.plan: Plan = scenario.human.plan(scenario.subject, self._role_seed("plan"))
        size = self.frames_per_step
        steps = -(-len(self.plan.target) // size)
        self.horizon = steps * size
        target = np.full(self.horizon, self.plan.target[-1])
        target[: len(self.plan.target)] = self.plan.target
        self.target = target
        rng = np.random.default_rng(self._role_seed("sensor"))
        noise = rng.normal(0.0, MOCAP_NOISE, (2, HISTORY_FRAMES + self.horizon))
        self._human_noise, self._robot_noise = noise.tolist()
        self.frame = 0
        self.command = 0.0
        self.dropped: str | None = None

    def _role_seed(self, role: str) -> int:
        """Return the seed of a role; other scenarios have others, so that they are independent."""
        return derive_seed(self.seed, f"{role}/{self.scenario.name}")

    @property
    def truncated(self) -> bool:
        """Whether the horizon has been reached."""
        return self.frame >= self.horizon

    @property
    def done(self) -> bool:
        """Whether the episode is over, by the horizon or by a drop."""
        return self.dropped is not None or self.frame >= self.horizon

    def scripted_human(self) -> ScriptedHuman:
        """Return the agent that carries the human's plan out, ready for the current episode."""
        human = ScriptedHuman(subject=self.scenario.subject)
        human.reset(self._role_seed("human"))
        return human

    def step(self, human: ArrayLike, partner: ArrayLike) -> None:
        """Advance by one control period.

        Parameters
        ----------
        human
            Hand reference for each frame [m], shape ``(frames_per_step,)``.
        partner
            The robot's change of its hand command [m], shape ``(1,)``, held to the hand's speed
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
        size, world = self.frames_per_step, self.world
        reference = _within_range(human)
        if self.scenario.partner == "nao":
            commands = self._ramp(partner[0])
        else:
            commands = _within_range(partner)
        world.advance(reference, commands)
        self.command = commands[-1]
        self.frame += size
        tilt = world.human_end[-1] - world.robot_end[-1]
        if abs(tilt) > TABLE_LENGTH * math.sin(DROP_TILT):
            self.dropped = f"the table is inclined by more than {math.degrees(DROP_TILT):.0f} deg"
        elif abs(sum(world.robot_force[-size:])) > GRIP_FORCE * size:
            self.dropped = f"more than {GRIP_FORCE:.0f} N pull at the partner's hands"
        elif abs(world.hand_height - world.robot_end[-1]) > GRIP_GAP:
            self.dropped = "the table's end is out of the partner's reach"

    def _ramp(self, change: float) -> list[float]:
        """Return the hand command at the end of each frame of the step [m]."""
        limit, (low, high) = self.step_limit, STROKE
        start = self.command
        change = min(max(change, -limit), limit)
        change = min(max(start + change, low), high) - start
        size = self.frames_per_step
        return [start + change * (i + 1) / size for i in range(size)]

    def partner_observation(self) -> Observation:
        """Return what the holder of the robot's end sees now.

        A robot: laid out as :class:`.RobotObservation`. A second human: as the first, but without
        a plan of its own; its target is to be level, the height at which it sees the other end.
        """
        if self.scenario.partner == "nao":
            return self._robot_view()
        world = self.world
        delays = self._partner_delays
        target = np.full(self.frames_per_step, world.human_end[-1 - delays[0]])
        return self._human_view(
            world.robot_end,
            world.robot_velocity,
            world.human_end,
            world.robot_force,
            target,
            delays,
        )

    def _robot_view(self) -> Observation:
        world, age = self.world, self._latency
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

    def human_observation(self) -> Observation:
        """Return what the human sees and feels now, laid out as :class:`.HumanObservation`."""
        world, frame = self.world, self.frame
        return self._human_view(
            world.human_end,
            world.human_velocity,
            world.robot_end,
            world.human_force,
            self.target[frame : frame + self.frames_per_step],
            self._human_delays,
        )

    def _human_view(
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
        # Past a truncated horizon there is nothing more to intend than to stay.
        view[HumanObservation.TARGET] = target if len(target) else self.target[-1]
        view[HumanObservation.TIME] = self.frame * FRAME
        return view

    def close(self) -> None:
        """Release the world."""
        self.world.close()


def _within_range(references: list[float]) -> list[float]:
    """Return a human's references held to the range of heights."""
    low, high = REFERENCE_RANGE
    if min(references) < low or max(references) > high:
        return [min(max(value, low), high) for value in references]
    return references


def _delays(person: Subject) -> tuple[int, int]:
    """Return a person's visual and haptic delay in frames."""
    return round(person.visual_delay / FRAME), round(person.haptic_delay / FRAME)


def body_parameters(person: Subject) -> BodyParameters:
    """Return what the world needs to know of a person."""
    return BodyParameters(
        stiffness=person.stiffness,
        damping=person.damping,
        mass=person.mass,
        pull=person.pull,
        felt_share=person.felt_share,
        visual_delay=person.visual_delay,
        haptic_delay=person.haptic_delay,
    )
