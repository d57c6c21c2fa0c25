"""An arm that reads the robot and never moves it."""

from .naoqi import NaoqiArm
from .ports import ArmState, HandLimits
from .safety import next_command


class DryArm:
    """A :class:`.RobotArm` whose commands go nowhere: held to the limits and returned, not sent."""

    def __init__(self, arm: NaoqiArm) -> None:
        self._arm = arm
        self._command = 0.0

    @property
    def limits(self) -> HandLimits:
        """What commands are held to."""
        return self._arm.limits

    def state(self) -> ArmState:
        """Return where the robot's hands really are; its motors may be off."""
        return self._arm.state()._replace(stiffness=1.0)

    def command(self, height: float, duration: float) -> float:
        """Return the height that would be commanded [m]."""
        self._command = next_command(height, self._command, self._command, duration, self.limits)
        return self._command

    def stop(self) -> None:
        """Do nothing: nothing moves."""
