"""The common part of the tasks with touch: world, sensors and observation."""

import math
from typing import Final

import numpy as np
from colift.agents.agent import Observation
from colift.agents.observations import HapticObservation
from colift.benchmark.episode.level import FORCE_BOUND, Level
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.task import Bounds, Playing
from colift.benchmark.world import BodyParameters, BulletWorld, FarEnd, Physics
from colift.benchmark.world.table import WEIGHT_SHARE

SENSED_FRAMES: Final = 5
"""Frames over which the force and torque sensors average."""

FORCE_NOISE: Final = 0.05
"""Standard deviation of a sensed force [N], see :class:`.HapticObservation`: an assumption, some
ten times the resolution of small six-axis sensors, to include the effect of a wrist's own
motion."""

TORQUE_NOISE: Final = 0.002
"""Standard deviation of a sensed torque [Nm]."""


FINER: Final = Physics(step=0.0025)
"""The physics of the tasks with touch. People and policies that act on touch amplify small
differences: at the usual step the mean error of two people on ``agree-v1`` is 4 % off (``colift
bench --convergence --suite agree-v1``)."""


class HapticLift(Lift):
    """A lift in a world with touch, with sensors of force and torque at the robot's hands."""

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``: draw plan and noise, as :meth:`.Lift.reset`."""
        super().reset(seed)
        rng = np.random.default_rng(self.role_seed("force sensor"))
        steps = self.horizon // self.frames_per_step + 1
        noise = rng.normal(0.0, 1.0, (2, steps))
        self._force_noise = (FORCE_NOISE * noise[0]).tolist()
        self._torque_noise = (TORQUE_NOISE * noise[1]).tolist()

    def touch(self) -> tuple[float, float]:
        """Return the sensed force beyond half of the weight [N], and the sensed torque [Nm]."""
        world, step = self.world, self.frame // self.frames_per_step
        force = math.fsum(world.robot_force[-SENSED_FRAMES:]) / SENSED_FRAMES - WEIGHT_SHARE
        torque = math.fsum(world.robot_torque[-SENSED_FRAMES:]) / SENSED_FRAMES
        return force + self._force_noise[step], torque + self._torque_noise[step]

    def haptic_view(self) -> Observation:
        """Return the robot's senses now, laid out as :class:`.HapticObservation`."""
        return np.concatenate((self.robot_view(), self.touch()))


class Haptic(Level):
    """The base of tasks with touch: subclasses state purpose, end and scores."""

    def world(
        self, human: BodyParameters, far_end: FarEnd, *, physics: Physics = FINER
    ) -> BulletWorld:
        """Return a world with torques at both grips."""
        return BulletWorld(human, far_end, physics=physics, touch=True)

    def lift(self, scenario: Scenario) -> HapticLift:
        """Return a lift with the sensors of touch."""
        return HapticLift(scenario)

    def robot_observation(self, lift: Playing) -> Observation:
        """Return the robot's senses, laid out as :class:`.HapticObservation`."""
        assert isinstance(lift, HapticLift)
        return lift.haptic_view()

    def robot_bounds(self) -> Bounds:
        """Return the bounds of :class:`.HapticObservation`."""
        low, high = super().robot_bounds()
        touch = np.full(len(HapticObservation) - len(low), FORCE_BOUND)
        return np.concatenate((low, -touch)), np.concatenate((high, touch))
