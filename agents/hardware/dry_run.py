"""An arm for dry runs: it reads the robot and never moves it."""

import dataclasses
import math

from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.ports import ArmState, HandLimits
from colift.agents.hardware.safety import next_command


class DryArm:
    """A :class:`.RobotArm` whose commands are clipped to the limits and returned, but not sent."""

    def __init__(self, arm: NaoqiArm) -> None:
        self._arm = arm
        self._command = 0.0

    @property
    def limits(self) -> HandLimits:
        """Limits of the commands, without one of tilt, which the policy cannot influence."""
        return dataclasses.replace(self._arm.limits, tilt=math.inf)

    def state(self) -> ArmState:
        """Return the real height of the hands; motors may be off, and anybody may move them."""
        state = self._arm.state()
        return state._replace(set_point=state.height, stiffness=1.0, astray=0.0)

    def command(self, height: float, duration: float) -> float:
        """Return the height that would be commanded [m]."""
        self._command = next_command(height, self._command, self._command, duration, self.limits)
        return self._command

    def stop(self) -> None:
        """Do nothing: nothing moves."""
