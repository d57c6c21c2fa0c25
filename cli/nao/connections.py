"""From what a user types to a robot and a motion capture."""

from ...agents.errors import InputError
from ...agents.hardware.lsl import Layout, LslCapture
from ...agents.hardware.naoqi import NaoqiArm
from ...agents.hardware.naoqi_session import NaoqiSession
from ...agents.hardware.ports import RobotLostError


def open_capture(text: str, layout: Layout) -> LslCapture:
    """Return the motion capture of ``lsl:NAME``.

    Raises
    ------
    InputError
        If it is not there, or the text is none.
    """
    kind, colon, name = text.partition(":")
    if kind != "lsl" or not colon or not name:
        raise InputError(f"the motion capture must be lsl:NAME, got {text!r}")
    return LslCapture(name, layout)


def open_robot(url: str) -> NaoqiArm:
    """Return the robot at an address such as ``tcp://nao.local:9559``.

    Raises
    ------
    InputError
        If it is not there, or no NAO.
    """
    try:
        return NaoqiArm(NaoqiSession(url))
    except RobotLostError as error:
        raise InputError(f"the robot cannot be used: {error}") from error


def layout_of(human: str, robot: str, up: str) -> Layout:
    """Return a layout from lists of markers with commas between them.

    Raises
    ------
    InputError
        If a list is empty, or there is no such axis.
    """
    ends = [tuple(filter(None, text.split(","))) for text in (human, robot)]
    if not all(ends):
        raise InputError("each end needs at least one marker")
    if up.upper() not in ("X", "Y", "Z"):
        raise InputError(f"the axis that points up must be X, Y or Z, got {up!r}")
    return Layout(human=ends[0], robot=ends[1], up=up.upper())
