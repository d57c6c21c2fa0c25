"""The end of a session: the table is taken out, the arms go limp, the robot rests."""

from collections.abc import Callable
from contextlib import suppress
from typing import Final

from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.ports import Clock, RobotLostError, RobotTakenError

BACK: Final = 3.0
"""Longest wait for a robot that does not answer [s]."""

INSTRUCTION: Final = "Take the table out of the hands: the arms go limp."
"""Instruction to the operator before the arms are released; the robot says it, too."""

UNKNOWN: Final = (
    "The robot does not answer; nothing is known of the arms: they may be stiff, limp, or on the "
    "way to their last target. Take the table out with care, and press the chest button twice."
)
"""Instruction to the operator when the robot does not answer."""


def release(
    arm: NaoqiArm, clock: Clock, tell: Callable[[str], None], taken_out: Callable[[], None]
) -> None:
    """Release the arms smoothly, and bring the robot to rest.

    A robot that another client commands is left alone. If a robot does not answer, wait for it up
    to :data:`BACK`.

    Parameters
    ----------
    arm, clock
        The robot and the time.
    tell
        Shows a line to the operator.
    taken_out
        Waits until the operator has taken the table out of the hands.
    """
    try:
        arm.refuse_if_taken()
        known = arm.answers()
        tell(INSTRUCTION if known else UNKNOWN)
        if known:
            with suppress(RobotLostError):
                arm.say(INSTRUCTION)
        taken_out()
        if not known:
            _await_answer(arm, clock)
        arm.release()
        tell("the arms are released, the robot is at rest")
    except RobotTakenError as error:
        tell(f"Nothing more is sent to the robot: {error}.")
    except RobotLostError as error:
        tell(f"the arms are NOT released: {error}; press the robot's chest button twice")


def _await_answer(arm: NaoqiArm, clock: Clock) -> None:
    """Return when a robot that did not answer does, or after :data:`BACK`."""
    end = clock.now() + BACK
    while not arm.answers() and clock.now() < end:
        if clock.wait_until(clock.now() + 0.25) is not None:
            return
