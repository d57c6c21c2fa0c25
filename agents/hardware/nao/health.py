"""The robot's health: what makes a lift unsafe before it begins.

A hot joint, an empty battery and movements of the robot's own show only after minutes, in the
middle of a lift: they are read before each one. Sources: Aldebaran, "Idle" of NAOqi 2.8 (breathing
and idle posture by chain; both begin whenever no command is sent), and the keys of ALMemory that
``naoqi_driver`` of ROS reads.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from colift.agents.hardware.nao.naoqi import NAMES, NaoqiArm
from colift.agents.hardware.ports import Naoqi
from colift.base.errors import InputError

HOTTEST: Final = 70.0
"""Temperature of an arm joint [degrees Celsius] from which no lift begins. The firmware reduces the
stiffness of a joint beyond 76 degrees, until it is below 70 (github.com/HULKs/hulk/issues/1826)."""

LOWEST_CHARGE: Final = 20.0
"""Charge of the battery [%] below which no lift begins: NAOs go to rest by themselves when the
battery is empty."""

MOVING: Final = ("LArm", "RArm", "Legs")
"""Chains whose own movements would move the table."""

READ_TIME: Final = 2.0
"""Longest time to read one part of the health [s]."""

TEMPERATURE: Final = "Device/SubDeviceList/{}/Temperature/Sensor/Value"
"""Key of a joint's temperature in ALMemory."""


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One part of the robot's health."""

    name: str
    """The part."""
    state: str
    """What was read."""
    remedy: str = ""
    """What to do before a lift; empty if the part is well."""


def findings(arm: NaoqiArm) -> Iterator[Finding]:
    """Yield the health of a robot, part by part.

    Raises
    ------
    RobotLostError
        If the robot does not answer.
    """
    yield _temperatures(arm.session)
    yield _battery(arm.session)
    for name, method in (
        ("breathing", "getBreathEnabled"),
        ("idle posture", "getIdlePostureEnabled"),
    ):
        on = [chain for chain in MOVING if bool(arm.motion(method, chain, within=READ_TIME))]
        setter = method.replace("get", "set")
        remedy = "; ".join(f"switch it off: ALMotion.{setter}({chain!r}, False)" for chain in on)
        yield Finding(name=name, state=f"on in {', '.join(on)}" if on else "off", remedy=remedy)


def _temperatures(session: Naoqi) -> Finding:
    """Return the temperatures of the arms' joints."""
    keys = [TEMPERATURE.format(joint) for joint in NAMES]
    read = session.call("ALMemory", "getListData", keys, within=READ_TIME)
    known = {
        joint: float(value)
        for joint, value in zip(NAMES, read, strict=True)
        if isinstance(value, int | float) and math.isfinite(value)
    }
    if len(known) < len(NAMES):
        unknown = ", ".join(joint for joint in NAMES if joint not in known)
        return Finding(
            name="temperatures", state=f"unknown: {unknown}", remedy="let the robot report them"
        )
    hot = [joint for joint in NAMES if known[joint] >= HOTTEST]
    if hot:
        state = ", ".join(f"{joint} {known[joint]:.0f} °C" for joint in hot)
        remedy = f"let the robot rest until its arms are below {HOTTEST:.0f} °C"
        return Finding(name="temperatures", state=state, remedy=remedy)
    hottest = max(NAMES, key=lambda joint: known[joint])
    return Finding(
        name="temperatures", state=f"{known[hottest]:.0f} °C or less in the arms ({hottest})"
    )


def _battery(session: Naoqi) -> Finding:
    """Return the charge of the battery."""
    try:
        charge = float(session.call("ALBattery", "getBatteryCharge", within=READ_TIME))
    except (TypeError, ValueError):
        charge = math.nan
    well = charge >= LOWEST_CHARGE
    return Finding(
        name="battery",
        state=f"{charge:.0f} %",
        remedy="" if well else f"charge it to {LOWEST_CHARGE:.0f} % or more",
    )


def refuse_unless_well(arm: NaoqiArm) -> None:
    """Refuse to begin a lift if the robot is not well.

    Raises
    ------
    InputError
        If a joint is hot, the battery is empty, or the robot moves by itself.
    RobotLostError
        If the robot does not answer.
    """
    for finding in findings(arm):
        if finding.remedy:
            raise InputError(
                f"the robot must not lift: {finding.name}: {finding.state}; {finding.remedy}"
            )
