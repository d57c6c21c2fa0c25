"""A NAO as the holder of the far end of the table."""

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from colift.agents.agent import FRAME
from colift.benchmark.world.interface import Engine, Hands
from colift.benchmark.world.servo import SERVO, Servo


@dataclass(frozen=True)
class NaoFarEnd:
    """A NAO as the holder of the far end."""

    servo: Servo = SERVO
    """The position servo of its joints."""

    apart: bool = False
    """Whether the engine has both arms, instead of one for both; see :class:`.NaoArms`."""

    mass: ClassVar[float] = 0.0
    """No mass beside that of the robot's own bodies [kg]."""

    carries: ClassVar[bool] = False

    def with_arms(self, sag: float, gain: float) -> Self:
        """Return the same robot with other servos; see :class:`.Adjustable`."""
        servo = self.servo
        share = -math.expm1(-FRAME / servo.time)
        time = -FRAME / math.log1p(-gain * share)
        return replace(self, servo=replace(servo, time=time, stiffness=servo.stiffness / sag))

    def hold(self, engine: Engine) -> Hands:
        """Grip the table with both hands; see :meth:`.FarEnd.hold`."""
        # The engine is imported where it is used: the twin has the numbers of the arms alone.
        from colift.benchmark.world.engine import BulletEngine
        from colift.benchmark.world.nao_arms import NaoArms

        assert isinstance(engine, BulletEngine)
        return NaoArms(engine, self.servo, apart=self.apart)
