"""The world of tasks with touch: wrists with an intended pitch, torques, a rolling ball."""

import math
from collections.abc import Sequence
from typing import Final

from colift.agents.agent import FRAME
from colift.benchmark.world.ball import Ball, TableMotion
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.bullet_world import BulletWorld
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.physics import PHYSICS, Physics
from colift.benchmark.world.second_human import HumanFarEnd
from colift.benchmark.world.table import (
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    HANDS,
    PITCH,
    SLIDE,
    TABLE_INERTIA,
    TABLE_LENGTH,
    TABLE_MASS,
    WEIGHT_SHARE,
)
from colift.benchmark.world.world import HISTORY_FRAMES, FarEnd

FAR_GRIP_STIFFNESS: Final = 1.0
"""Pitch stiffness of the grip at the far end [Nm/rad], a tenth of the human's: an assumption for
fingers that hold an edge without clamping it."""

FAR_GRIP_DAMPING: Final = 0.03
"""Pitch damping of that grip [Nm s/rad], in the same ratio to the human's."""

_JOINTS: Final = [HANDS, PITCH]
_ALL: Final = [HANDS, PITCH, SLIDE]
_TORQUE: Final = pybullet.TORQUE_CONTROL


class HapticWorld(BulletWorld):
    """The world of :class:`.BulletWorld` with torques at both grips.

    The wrists of the person turn towards an intended pitch, and the person's reflexes correct only
    deviations from the intended height difference; both intentions are 0 unless :meth:`intend` is
    called. The grip at the far end resists pitching a little, so that a torque can be sensed there.
    A ball may roll on the table; people carry half of its weight, like that of the table, without
    feeling it as a disturbance.

    Parameters
    ----------
    human, far_end, physics
        As for :class:`.BulletWorld`.
    ball
        The ball, if there is one; it starts at rest in the middle.
    """

    def __init__(
        self,
        human: BodyParameters,
        far_end: FarEnd,
        *,
        physics: Physics = PHYSICS,
        ball: Ball | None = None,
    ) -> None:
        self._ball = ball
        carried = 0.0 if ball is None else ball.mass * GRAVITY / 2
        self._carried = carried
        self._far_carried = carried if isinstance(far_end, HumanFarEnd) else 0.0
        super().__init__(human, far_end, physics=physics)
        inertia = TABLE_INERTIA + far_end.mass * TABLE_LENGTH**2
        damping = GRIP_DAMPING + FAR_GRIP_DAMPING
        self._implicit = 1 + self._step * damping / inertia / 2

    def reset(self) -> None:
        """Restore the state of rest; see :meth:`.World.reset`."""
        super().reset()
        self._difference = self._wrists = self._backwards = 0.0
        self._load = 0.0 if self._ball is None else self._ball.load(0.0)
        self._intended: tuple[Sequence[float], Sequence[float]] | None = None
        self.human_force = [WEIGHT_SHARE + self._carried] * HISTORY_FRAMES
        self.robot_force = [WEIGHT_SHARE + self._carried] * HISTORY_FRAMES
        self._even = [0.0] * HISTORY_FRAMES
        self._felt = [WEIGHT_SHARE] * HISTORY_FRAMES
        self._far_felt = [WEIGHT_SHARE] * HISTORY_FRAMES
        self.robot_torque = [0.0] * HISTORY_FRAMES
        """Torque of the far hands on the table about their grip [Nm], positive if it raises the far
        end; with one entry per frame, like the other read-outs."""
        self.ball_place = [0.0] * HISTORY_FRAMES
        """Place of the ball on the table [m], from the middle towards the far end."""
        self.ball_speed = [0.0] * HISTORY_FRAMES
        """Speed of the ball's centre along the table [m/s]."""

    def intend(self, differences: Sequence[float], pitches: Sequence[float]) -> None:
        """Set the person's intention for the frames of the next :meth:`advance`.

        Parameters
        ----------
        differences
            The intended height of the far end above the near one at the end of each frame [m].
        pitches
            The pitch that the wrists turn towards at the end of each frame [rad].
        """
        self._intended = differences, pitches

    def advance(self, human_reference: Sequence[float], robot_reference: Sequence[float]) -> None:
        """Advance by as many frames as the references have entries; see :meth:`.World.advance`."""
        client, tree, mass, ball = self.client, self._tree, self._mass, self._ball
        share, weight, half = self._step / FRAME, mass * GRAVITY, TABLE_LENGTH / 2 / FRAME
        implicit, step = self._implicit, self._step
        carried, far_carried = self._carried, self._far_carried
        sin, cos = math.sin, math.cos
        body, hands, begins = self._body, self.hands, self._begins
        control, states = pybullet.setJointMotorControlArray, pybullet.getJointStates
        human_end, robot_end = self.human_end, self.robot_end
        height, velocity = self._height, self._velocity
        pitch, pitch_rate = self._pitch, self._pitch_rate
        place, speed = self.ball_place[-1], self.ball_speed[-1]
        backwards, load = self._backwards, self._load
        joints = _JOINTS if ball is None else _ALL
        previous, wrists = self._reference, self._wrists
        frames = len(human_reference)
        unchanged = [self._difference] * frames, [wrists] * frames
        differences, pitches = self._intended or unchanged
        lever = TABLE_LENGTH * cos(pitch)
        far_height, far_velocity = robot_end[-1], self.robot_velocity[-1]
        for wanted, command, difference, turned in zip(
            human_reference, robot_reference, differences, pitches, strict=True
        ):
            reference = wanted + body.reflex(human_end, self._even, self._felt)
            change = reference - previous
            rate, turn = change / FRAME, (turned - wrists) / FRAME
            hands.prepare(command, robot_end, human_end, self._far_felt)
            first_velocity, first_pitch_rate = velocity, pitch_rate
            impulse = twist = 0.0
            for begin in begins:
                arms = body.arm_force(previous + change * begin, rate, height, velocity) + carried
                far_arms = hands.drive(begin, far_height, far_velocity) + far_carried
                meant = wrists + (turned - wrists) * begin
                wrist = GRIP_STIFFNESS * (meant - pitch) + GRIP_DAMPING * (turn - pitch_rate)
                grip = -FAR_GRIP_STIFFNESS * pitch - FAR_GRIP_DAMPING * pitch_rate
                torque = lever * far_arms + (wrist + grip) / implicit
                lift = arms + weight + far_arms
                lift -= load * cos(pitch)
                torque -= load * (TABLE_LENGTH / 2 + place)
                control(tree, _JOINTS, _TORQUE, forces=[lift, torque], physicsClientId=client)
                pybullet.stepSimulation(client)
                before = velocity, pitch
                now = states(tree, joints, client)
                (height, velocity, _, _), (pitch, pitch_rate, _, _) = now[:2]
                if ball is not None:
                    was, backwards = backwards, now[2][1]
                    table = TableMotion(
                        pitch=(before[1] + pitch) / 2,
                        pitch_rate=(pitch - before[1]) / step,
                        turn=pitch - before[1],
                        rise=(velocity - before[0]) / step,
                        push=(backwards - was) / step,
                    )
                    place, speed = ball.rolled(place, speed, table, step)
                    load = ball.load(pitch)
                lever = TABLE_LENGTH * cos(pitch)
                far_height = height + TABLE_LENGTH * sin(pitch)
                far_velocity = velocity + lever * pitch_rate
                impulse += arms
                twist += grip / implicit
            acceleration = (velocity - first_velocity) / FRAME
            centre = acceleration + half * (pitch_rate - first_pitch_rate)
            force = share * impulse - mass * acceleration
            human_end.append(height)
            robot_end.append(far_height)
            self._even.append(far_height - difference)
            self._felt.append(force - carried)
            self.human_force.append(force)
            self.human_velocity.append(velocity)
            self.robot_velocity.append(far_velocity)
            far_force = TABLE_MASS * (GRAVITY + centre) + load * cos(pitch) - force
            self.robot_force.append(far_force)
            self._far_felt.append(far_force - far_carried)
            self.robot_torque.append(share * twist)
            self.ball_place.append(place)
            self.ball_speed.append(speed)
            previous, wrists = reference, turned
            self._difference = difference
        self._intended = None
        self._reference, self._wrists = previous, wrists
        self._backwards, self._load = backwards, load
        self._height, self._velocity = height, velocity
        self._pitch, self._pitch_rate = pitch, pitch_rate
        self.hand_height = hands.hand_height(far_height)

    def state(self) -> tuple[float, ...]:
        """Return the last frame's read-outs, with those of touch and of the ball."""
        return (
            *super().state(),
            self.robot_torque[-1],
            self.ball_place[-1],
            self.ball_speed[-1],
        )
