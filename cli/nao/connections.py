"""Options for a robot and a motion-capture system, and the connections to both."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Final

import typer
from colift.agents.agent import Agent
from colift.agents.hardware.clocks import MonotonicClock
from colift.agents.hardware.decisions import Decider, Inline, Timed
from colift.agents.hardware.lsl import Layout, LslCapture
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.nao.session import NaoqiSession
from colift.agents.hardware.operator import StopButton
from colift.agents.hardware.ports import Clock, Naoqi, RobotLostError, TableCapture
from colift.base.errors import InputError
from colift.benchmark.hardware.laboratory import Conditions
from colift.benchmark.hardware.simulated import SimulatedLaboratory
from colift.benchmark.suites.catalogue import make_scenario

WORLD: Final = "world"
"""Name of the simulated laboratory, instead of a robot's address."""

URL: Final = "tcp://127.0.0.1:9559"
"""The default address of a robot's NAOqi."""

MotionCapture = Annotated[
    str,
    typer.Option(
        metavar="lsl:NAME[@HOST]",
        help="Stream of the motion capture; with the sender's host or source id, where several "
        "streams have the name.",
    ),
]
HumanMarkers = Annotated[
    str, typer.Option(metavar="NAMES", help="Markers at the human's end, separated by commas.")
]
RobotMarkers = Annotated[
    str, typer.Option(metavar="NAMES", help="Markers at the robot's end, separated by commas.")
]
UpAxis = Annotated[str, typer.Option(metavar="AXIS", help="The stream's upward axis: X, Y or Z.")]


@dataclass(frozen=True, kw_only=True)
class Place:
    """A laboratory, real or simulated."""

    arm: NaoqiArm
    capture: TableCapture
    clock: Clock
    asked_by: Callable[[Agent], Decider]
    """The caller of the policy."""
    simulated: bool
    """Whether time is simulated and no operator confirms."""


def open_place(robot: str, mocap: str, layout: Layout, button: StopButton) -> Place:
    """Return a laboratory, or the simulated one of ``world`` or ``world:BEHAVIOUR/SUBJECT``.

    Raises
    ------
    InputError
        If the robot or the motion capture is missing.
    """
    kind, _, scenario = robot.partition(":")
    if kind == WORLD:
        behaviour, _, subject = (scenario or "smooth").partition("/")
        conditions = Conditions(scenario=make_scenario(behaviour, subject or "S1"))
        world = SimulatedLaboratory(conditions, button)
        return Place(
            arm=NaoqiArm(world), capture=world, clock=world, asked_by=Inline, simulated=True
        )
    return Place(
        arm=open_robot(robot),
        capture=open_capture(mocap, layout),
        clock=MonotonicClock(button),
        asked_by=Timed,
        simulated=False,
    )


def open_capture(text: str, layout: Layout) -> LslCapture:
    """Return the motion capture of ``lsl:NAME`` or ``lsl:NAME@HOST``.

    Raises
    ------
    InputError
        If it is missing, or the text has another form.
    """
    kind, colon, name = text.partition(":")
    if kind != "lsl" or not colon or not name:
        raise InputError(f"the motion capture must be lsl:NAME or lsl:NAME@HOST, got {text!r}")
    return LslCapture(name, layout)


def open_robot(url: str) -> NaoqiArm:
    """Return the robot at an address such as ``tcp://nao.local:9559``.

    Raises
    ------
    InputError
        If it is missing, or not a NAO.
    """
    try:
        return NaoqiArm(NaoqiSession(url))
    except RobotLostError as error:
        raise InputError(f"the robot cannot be used: {error}") from error


def describe_robot(session: Naoqi) -> str:
    """Return the name, address and version of a robot, as far as it tells them."""
    if not session.has("ALSystem"):
        return f"at {session.url}"
    name, naoqi = session.calls("ALSystem", [("robotName",), ("systemVersion",)], within=2.0)
    return f"{name} at {session.url}, NAOqi {naoqi}"


def describe_stream(info: Mapping[str, object]) -> str:
    """Return the name and the sender of a stream."""
    return f"{info['name']} of {info['host']} (source id {info['source_id'] or 'none'})"


def layout_of(human: str, robot: str, up: str) -> Layout:
    """Return a layout from comma-separated lists of markers.

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
