"""The world in PyBullet: two holders and a table, stepped one motion-capture frame at a time."""

import math
import weakref
from collections.abc import Sequence
from typing import Final

from colift.agents.agent import FRAME
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.engine import disconnect, load_urdf_text, new_client
from colift.benchmark.world.human_body import BodyParameters, HumanBody
from colift.benchmark.world.nao_arms import NaoArms
from colift.benchmark.world.physics import PHYSICS, Physics
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
    table_urdf,
)
from colift.benchmark.world.world import HISTORY_FRAMES, FarEnd

_JOINTS: Final = [HANDS, PITCH]
_TORQUE: Final = pybullet.TORQUE_CONTROL


class BulletWorld:
    """The :class:`.World` that scores.

    Parameters
    ----------
    human
        The person at the near end.
    far_end
        Holder of the other end: :class:`.NaoFarEnd`, :class:`.HumanFarEnd`.
    physics
        Time step and solver.
    """

    def __init__(
        self, human: BodyParameters, far_end: FarEnd, *, physics: Physics = PHYSICS
    ) -> None:
        self.client = new_client(physics)
        # An unreferenced world releases its 30 MB, closed or not.
        self._release = weakref.finalize(self, disconnect, self.client)
        self._release.atexit = False
        self._step = physics.step
        self._begins = [i / physics.steps_per_frame for i in range(physics.steps_per_frame)]
        self._body = HumanBody(human, physics.step)
        self._mass = human.mass
        grip = NaoArms.REST_GRIP
        self._tree = load_urdf_text(
            self.client,
            table_urdf(human.mass, far_end.mass),
            (grip[0] + TABLE_LENGTH, 0.0, grip[2]),
        )
        for joint in (SLIDE, HANDS, PITCH):
            pybullet.setJointMotorControl2(
                self._tree, joint, pybullet.VELOCITY_CONTROL, force=0, physicsClientId=self.client
            )
        self.hands = far_end.hold(self.client, self._tree, physics)
        inertia = TABLE_INERTIA + far_end.mass * TABLE_LENGTH**2
        implicit = 1 + self._step * GRIP_DAMPING / inertia / 2
        self._pitch_gain = GRIP_STIFFNESS / implicit
        self._pitch_rate_gain = GRIP_DAMPING / implicit
        self._rest = pybullet.saveState(physicsClientId=self.client)
        self.reset()

    def reset(self) -> None:
        """Restore the state of rest; see :meth:`.World.reset`."""
        pybullet.restoreState(self._rest, physicsClientId=self.client)
        self._body.reset()
        self.hands.reset()
        self._reference = 0.0
        self._height = self._velocity = self._pitch = self._pitch_rate = 0.0
        self.human_end = [0.0] * HISTORY_FRAMES
        self.human_velocity = [0.0] * HISTORY_FRAMES
        self.robot_end = [0.0] * HISTORY_FRAMES
        self.robot_velocity = [0.0] * HISTORY_FRAMES
        self.human_force = [WEIGHT_SHARE] * HISTORY_FRAMES
        self.robot_force = [WEIGHT_SHARE] * HISTORY_FRAMES
        self.hand_height = self.hands.hand_height(0.0)

    def advance(self, human_reference: Sequence[float], robot_reference: Sequence[float]) -> None:
        """Advance by as many frames as the references have entries; see :meth:`.World.advance`."""
        client, tree, mass = self.client, self._tree, self._mass
        share, weight, half = self._step / FRAME, mass * GRAVITY, TABLE_LENGTH / 2 / FRAME
        stiffness, damping = self._pitch_gain, self._pitch_rate_gain
        sin, cos = math.sin, math.cos
        body, hands, begins = self._body, self.hands, self._begins
        control, states = pybullet.setJointMotorControlArray, pybullet.getJointStates
        step_engine = pybullet.stepSimulation
        human_end, robot_end = self.human_end, self.robot_end
        human_force, robot_force = self.human_force, self.robot_force
        human_velocity, robot_velocity = self.human_velocity, self.robot_velocity
        height, velocity = self._height, self._velocity
        pitch, pitch_rate = self._pitch, self._pitch_rate
        previous = self._reference
        lever = TABLE_LENGTH * cos(pitch)
        far_height, far_velocity = robot_end[-1], robot_velocity[-1]
        for wanted, command in zip(human_reference, robot_reference, strict=True):
            reference = wanted + body.reflex(human_end, robot_end, human_force)
            change = reference - previous
            rate = change / FRAME
            hands.prepare(command, robot_end, human_end, robot_force)
            first_velocity, first_pitch_rate, impulse = velocity, pitch_rate, 0.0
            for begin in begins:
                arms = body.arm_force(previous + change * begin, rate, height, velocity)
                far_arms = hands.drive(begin, far_height, far_velocity)
                torque = lever * far_arms - stiffness * pitch - damping * pitch_rate
                forces = [arms + weight + far_arms, torque]
                control(tree, _JOINTS, _TORQUE, forces=forces, physicsClientId=client)
                step_engine(client)
                (height, velocity, _, _), (pitch, pitch_rate, _, _) = states(tree, _JOINTS, client)
                lever = TABLE_LENGTH * cos(pitch)
                far_height = height + TABLE_LENGTH * sin(pitch)
                far_velocity = velocity + lever * pitch_rate
                impulse += arms
            acceleration = (velocity - first_velocity) / FRAME
            centre = acceleration + half * (pitch_rate - first_pitch_rate)
            force = share * impulse - mass * acceleration
            human_end.append(height)
            robot_end.append(far_height)
            human_force.append(force)
            human_velocity.append(velocity)
            robot_velocity.append(far_velocity)
            robot_force.append(TABLE_MASS * (GRAVITY + centre) - force)
            previous = reference
        self._reference = previous
        self._height, self._velocity = height, velocity
        self._pitch, self._pitch_rate = pitch, pitch_rate
        self.hand_height = hands.hand_height(far_height)

    def state(self) -> tuple[float, ...]:
        """Return the last frame's read-outs; see :meth:`.World.state`."""
        return (
            self.human_end[-1],
            self.human_velocity[-1],
            self.robot_end[-1],
            self.robot_velocity[-1],
            self.human_force[-1],
            self.robot_force[-1],
            self.hand_height,
        )

    def close(self) -> None:
        """Disconnect from the engine; the world cannot be used afterwards."""
        self._release()
