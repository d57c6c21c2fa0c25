"""The emulated laboratory: a person, a table and a NAO, one motion-capture frame at a time."""

import dataclasses
from collections.abc import Sequence

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.hardware.joint_arms import JointArms, JointWorld
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import FarEnd
from colift.benchmark.world.servo import SERVO, Servo
from colift.benchmark.world.table import Table


class EmulatedLift(Lift):
    """Lifts in succession with a robot that is moved by joint angles.

    The person waits at rest for a request to lift, carries out a plan as in simulation, and waits
    again. The world continues between the lifts; nothing is put back.

    Parameters
    ----------
    scenario
        The person and the lifts; its control period is replaced by one frame, that of the person.
    servo
        The NAO's joint servos.
    """

    def __init__(self, scenario: Scenario, *, servo: Servo = SERVO) -> None:
        def world(human: BodyParameters, far_end: FarEnd, table: Table) -> JointWorld:
            self._world = JointWorld(human, servo)
            return self._world

        super().__init__(dataclasses.replace(scenario, control_period=FRAME), world=world)
        self.lifting = False
        self._rest()

    @property
    def arms(self) -> JointArms:
        """The NAO's arms."""
        return self._world.joint_arms

    def _rest(self) -> None:
        """Let the person wait at rest height."""
        super().reset(0)
        self.lifting = False
        self.begin(np.zeros(1))
        self._human = self.human()

    def start(self, seed: int) -> None:
        """Let the person begin the lift ``seed``."""
        super().reset(seed)
        self._human = self.human()
        self.lifting = True

    def advance(self, commanded: Sequence[float], stiffness: Sequence[float]) -> None:
        """Advance by one frame.

        Parameters
        ----------
        commanded
            The joints' set-points at the end of the frame [rad].
        stiffness
            Their stiffnesses, 0 to 1.
        """
        self.arms.commanded = np.array(commanded)
        self.arms.stiffness = np.array(stiffness)
        self.step(self._human.references(), [0.0])
        if self.lifting and self.truncated:
            self._rest()
