"""The world in PyBullet: two holders and a table, stepped one motion-capture frame at a time."""

import math
import weakref
from collections.abc import Sequence
from typing import Final, Self

from colift.agents.agent import FRAME
from colift.benchmark.world.ball import Ball, TableMotion
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.engine import BulletEngine, disconnect, load_urdf_text, new_client
from colift.benchmark.world.human_body import BodyParameters, HumanBody
from colift.benchmark.world.interface import HISTORY_FRAMES, FarEnd, Intended
from colift.benchmark.world.physics import PHYSICS, Physics
from colift.benchmark.world.table import (
    FAR_GRIP,
    FAR_GRIP_DAMPING,
    FAR_GRIP_STIFFNESS,
    GRAVITY,
    GRIP_DAMPING,
    GRIP_STIFFNESS,
    HANDS,
    PITCH,
    SLIDE,
    TABLE,
    TABLE_LENGTH,
    Table,
    table_urdf,
)

_JOINTS: Final = [HANDS, PITCH]
_ALL: Final = [HANDS, PITCH, SLIDE]
_TORQUE: Final = pybullet.TORQUE_CONTROL


class BulletWorld:
    """The :class:`.World` that scores.

    Parameters
    ----------
    human
        The person at the near end.
    far_end
        Holder of the other end: :class:`.NaoFarEnd`, :class:`.HumanFarEnd`.
    table
        The table.
    physics
        Time step and solver.
    touch
        Whether the grip at the far end resists pitching a little, so that a torque can be sensed
        there.
    ball
        A ball on the table, at rest in the middle at first. People carry half of its weight, like
        that of the table, without feeling it as a disturbance.
    """

    def __init__(
        self,
        human: BodyParameters,
        far_end: FarEnd,
        table: Table = TABLE,
        *,
        physics: Physics = PHYSICS,
        touch: bool = False,
        ball: Ball | None = None,
    ) -> None:
        self.client = new_client(physics)
        # An unreferenced world releases its 30 MB, closed or not.
        self._release = weakref.finalize(self, disconnect, self.client)
        self._release.atexit = False
        self._touch, self._ball = touch or ball is not None, ball
        self._table = table
        self._carried = 0.0 if ball is None else ball.mass * GRAVITY / 2
        self._far_carried = self._carried if far_end.carries else 0.0
        self._step = physics.step
        self._begins = [i / physics.steps_per_frame for i in range(physics.steps_per_frame)]
        self._body = HumanBody(human, physics.step, table.weight_share)
        self._mass = human.mass
        self._tree = load_urdf_text(
            self.client,
            table_urdf(human.mass, far_end.mass, table),
            (FAR_GRIP[0] + TABLE_LENGTH, 0.0, FAR_GRIP[2]),
        )
        for joint in (SLIDE, HANDS, PITCH):
            pybullet.setJointMotorControl2(
                self._tree, joint, pybullet.VELOCITY_CONTROL, force=0, physicsClientId=self.client
            )
        self.hands = far_end.hold(
            BulletEngine(
                physics=physics,
                weight_share=table.weight_share,
                client=self.client,
                table=self._tree,
            )
        )
        far = (FAR_GRIP_STIFFNESS, FAR_GRIP_DAMPING) if self._touch else (0.0, 0.0)
        inertia = table.inertia + far_end.mass * TABLE_LENGTH**2
        # The dampers act at mid-step.
        implicit = 1 + self._step * (GRIP_DAMPING + far[1]) / inertia / 2
        self._grip = GRIP_STIFFNESS / implicit, GRIP_DAMPING / implicit
        self._far_grip = far[0] / implicit, far[1] / implicit
        self._rest = pybullet.saveState(physicsClientId=self.client)
        self.reset()

    def with_person(self, human: BodyParameters) -> Self:
        """Exchange the person, and return the world, which must then be reset.

        A new world takes 20 ms. The person's mass is changed in the engine; everything is then as
        in a new world, bit for bit.
        """
        for link in (SLIDE, HANDS):
            inertia = pybullet.getDynamicsInfo(self._tree, link, physicsClientId=self.client)[2]
            pybullet.changeDynamics(
                self._tree,
                link,
                mass=human.mass,
                localInertiaDiagonal=inertia,  # Otherwise derived from the mass.
                physicsClientId=self.client,
            )
        self._mass = human.mass
        self._body = HumanBody(human, self._step, self._table.weight_share)
        return self

    def reset(self) -> None:
        """Restore the state of rest; see :meth:`.World.reset`."""
        pybullet.restoreState(self._rest, physicsClientId=self.client)
        self._body.reset()
        self.hands.reset()
        self._reference = self._difference = self._wrists = self._backwards = 0.0
        self._height = self._velocity = self._pitch = self._pitch_rate = 0.0
        self._load = 0.0 if self._ball is None else self._ball.load(0.0)
        share = self._table.weight_share
        zero, weight = [0.0], [share + self._carried]
        self.human_end, self.robot_end = zero * HISTORY_FRAMES, zero * HISTORY_FRAMES
        self.human_velocity, self.robot_velocity = zero * HISTORY_FRAMES, zero * HISTORY_FRAMES
        self.human_force, self.robot_force = weight * HISTORY_FRAMES, weight * HISTORY_FRAMES
        self.robot_torque = zero * HISTORY_FRAMES
        self.ball_place, self.ball_speed = zero * HISTORY_FRAMES, zero * HISTORY_FRAMES
        # What the reflexes answer to: the height difference less the intended one, the force less
        # that of the ball's weight.
        self._even, self._felt, self._far_felt = self.robot_end, self.human_force, self.robot_force
        if self._touch:
            self._even = zero * HISTORY_FRAMES
        if self._ball is not None:
            self._felt = [share] * HISTORY_FRAMES
            self._far_felt = [share] * HISTORY_FRAMES
        self.hand_height = self.hands.hand_height(0.0)

    def advance(
        self,
        human_reference: Sequence[float],
        robot_reference: Sequence[float],
        intended: Intended | None = None,
    ) -> None:
        """Advance by as many frames as the references have entries; see :meth:`.World.advance`."""
        client, tree, mass, step = self.client, self._tree, self._mass, self._step
        touch, ball = self._touch, self._ball
        share, weight, half = step / FRAME, mass * GRAVITY, TABLE_LENGTH / 2 / FRAME
        (stiffness, damping), (far_stiffness, far_damping) = self._grip, self._far_grip
        sin, cos = math.sin, math.cos
        body, hands, begins = self._body, self.hands, self._begins
        control, states = pybullet.setJointMotorControlArray, pybullet.getJointStates
        step_engine = pybullet.stepSimulation
        human_end, robot_end = self.human_end, self.robot_end
        human_force, robot_force = self.human_force, self.robot_force
        human_velocity, robot_velocity = self.human_velocity, self.robot_velocity
        even, felt, far_felt = self._even, self._felt, self._far_felt
        carried, far_carried = self._carried, self._far_carried
        height, velocity = self._height, self._velocity
        pitch, pitch_rate = self._pitch, self._pitch_rate
        place, speed = self.ball_place[-1], self.ball_speed[-1]
        backwards, load = self._backwards, self._load
        table_mass = self._table.mass
        joints = _JOINTS if ball is None else _ALL
        previous, wrists = self._reference, self._wrists
        frames = len(human_reference)
        differences, pitches = intended or ([self._difference] * frames, [wrists] * frames)
        lever = TABLE_LENGTH * cos(pitch)
        far_height, far_velocity = robot_end[-1], robot_velocity[-1]
        for wanted, command, difference, turned in zip(
            human_reference, robot_reference, differences, pitches, strict=True
        ):
            reference = wanted + body.reflex(human_end, even, felt)
            change, turning = reference - previous, turned - wrists
            rate, turn = change / FRAME, turning / FRAME
            hands.prepare(command, robot_end, human_end, far_felt)
            first_velocity, first_pitch_rate, impulse, twist = velocity, pitch_rate, 0.0, 0.0
            for begin in begins:
                arms = body.arm_force(previous + change * begin, rate, height, velocity) + carried
                far_arms = hands.drive(begin, far_height, far_velocity) + far_carried
                lift, torque = arms + weight + far_arms, lever * far_arms
                torque += stiffness * (wrists + turning * begin - pitch)
                torque += damping * (turn - pitch_rate)
                if touch:
                    grip = -far_stiffness * pitch - far_damping * pitch_rate
                    torque += grip
                    twist += grip
                if ball is not None:
                    lift -= load * cos(pitch)
                    torque -= load * (TABLE_LENGTH / 2 + place)
                control(tree, _JOINTS, _TORQUE, forces=[lift, torque], physicsClientId=client)
                step_engine(client)
                now = states(tree, joints, client)
                before = velocity, pitch
                (height, velocity, _, _), (pitch, pitch_rate, _, _) = now[:2]
                lever = TABLE_LENGTH * cos(pitch)
                far_height = height + TABLE_LENGTH * sin(pitch)
                far_velocity = velocity + lever * pitch_rate
                impulse += arms
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
            acceleration = (velocity - first_velocity) / FRAME
            centre = acceleration + half * (pitch_rate - first_pitch_rate)
            force = share * impulse - mass * acceleration
            far_force = table_mass * (GRAVITY + centre) - force
            human_end.append(height)
            robot_end.append(far_height)
            human_force.append(force)
            human_velocity.append(velocity)
            robot_velocity.append(far_velocity)
            if touch:
                even.append(far_height - difference)
                self.robot_torque.append(share * twist)
            if ball is not None:
                far_force += load * cos(pitch)
                felt.append(force - carried)
                far_felt.append(far_force - far_carried)
                self.ball_place.append(place)
                self.ball_speed.append(speed)
            robot_force.append(far_force)
            previous, wrists = reference, turned
            self._difference = difference
        self._reference, self._wrists = previous, wrists
        self._backwards, self._load = backwards, load
        self._height, self._velocity = height, velocity
        self._pitch, self._pitch_rate = pitch, pitch_rate
        self.hand_height = hands.hand_height(far_height)

    def state(self) -> tuple[float, ...]:
        """Return the last frame's read-outs; see :meth:`.World.state`."""
        read = (
            self.human_end[-1],
            self.human_velocity[-1],
            self.robot_end[-1],
            self.robot_velocity[-1],
            self.human_force[-1],
            self.robot_force[-1],
            self.hand_height,
        )
        if not self._touch:
            return read
        return (*read, self.robot_torque[-1], self.ball_place[-1], self.ball_speed[-1])

    def close(self) -> None:
        """Disconnect from the engine; the world cannot be used afterwards."""
        self._release()
