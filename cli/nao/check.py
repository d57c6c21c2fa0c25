"""``colift nao check``: the state of a robot and a motion-capture system before trials."""

import time
from collections.abc import Callable, Iterator
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated, Any, Final

import numpy as np
import typer
from colift.agents.hardware.claim import BEAT, holder
from colift.agents.hardware.clocks import MonotonicClock, awake_or_asleep
from colift.agents.hardware.lsl import LslCapture
from colift.agents.hardware.nao.health import findings
from colift.agents.hardware.nao.naoqi import NaoqiArm
from colift.agents.hardware.ports import Naoqi, RobotLostError
from colift.agents.hardware.safety import LOWEST_STIFFNESS
from colift.agents.hardware.setup import measure_rest
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.cli.nao.connections import (
    URL,
    HumanMarkers,
    MotionCapture,
    RobotMarkers,
    UpAxis,
    describe_robot,
    describe_stream,
    layout_of,
    open_capture,
    open_robot,
)
from rich.console import Console

READINGS: Final = 50
"""Number of readings by which reading the robot is timed."""

Line = tuple[bool, str, str]
"""Whether a part is ready, its name, and its state or its fault."""


def check_setup(
    robot: Annotated[str, typer.Option(metavar="URL", help="Address of the robot's NAOqi.")] = URL,
    mocap: MotionCapture = "lsl:colift",
    human_markers: HumanMarkers = "H1,H2",
    robot_markers: RobotMarkers = "R1,R2",
    up: UpAxis = "Z",
) -> None:
    """Check a robot and a motion-capture system, and list what is missing; nothing moves.

    Example: colift nao check --robot tcp://nao.local:9559 --mocap lsl:table
    """
    layout = layout_of(human_markers, robot_markers, up)
    console = Console()
    well = True
    for part, lines in (
        ("packages", package_lines),
        ("robot", lambda: robot_lines(open_robot(robot))),
        ("motion capture", lambda: capture_lines(open_capture(mocap, layout))),
    ):
        for good, name, found in _reported(part, lines):
            console.print(f"{'ok     ' if good else 'MISSING'} {name}: {found}", soft_wrap=True,
                          highlight=False, markup=False)  # fmt: skip
            well &= good
    if not well:
        raise typer.Exit(1)


def _reported(part: str, lines: Callable[[], Iterator[Line]]) -> Iterator[Line]:
    """Yield the lines of a part, and its error if there is one."""
    try:
        yield from lines()
    except (InputError, RobotLostError) as error:
        yield False, part, str(error)


def package_lines() -> Iterator[Line]:
    """Yield the versions of the packages for hardware."""
    for name in ("qi", "pylsl"):
        try:
            yield True, name, version(name)
        except PackageNotFoundError:
            yield False, name, f"not installed; run: {how_to_install('nao')}"


def robot_lines(arm: NaoqiArm) -> Iterator[Line]:
    """Yield the state of the robot."""
    session = arm.session
    yield True, "robot", describe_robot(session)
    if session.has("ALRobotPosture"):
        posture = session.call("ALRobotPosture", "getPosture", within=2.0)
        yield True, "posture", str(posture)
    if session.has("ALAutonomousLife"):
        life = str(session.call("ALAutonomousLife", "getState", within=2.0))
        switched_off = life == "disabled"
        yield switched_off, "autonomous life", life + ("" if switched_off else ": switch it off")
    limits = arm.limits
    yield (
        True,
        "hands",
        (f"{limits.low:.3f} to {limits.high:.3f} m around rest, at most {limits.speed:.2f} m/s"),
    )
    state = arm.state()
    yield True, "hands now", f"{state.height:.3f} m"
    stiff = "stiff" if state.stiffness >= LOWEST_STIFFNESS else "limp; 'colift nao run' wakes them"
    yield True, "arms", f"stiffness {state.stiffness:.2f}, {stiff}"
    for method, arguments, name in (
        ("getFallManagerEnabled", (), "fall manager"),
        ("getCollisionProtectionEnabled", ("LArm",), "collision protection, left arm"),
        ("getCollisionProtectionEnabled", ("RArm",), "collision protection, right arm"),
    ):
        on = bool(arm.motion(method, *arguments, within=2.0))
        yield on, name, "on" if on else "off: switch it on"
    smart = arm.motion("getSmartStiffnessEnabled", within=2.0)
    yield True, "smart stiffness", "on: the arms give way more at rest" if smart else "off"
    for finding in findings(arm):
        yield (
            not finding.remedy,
            finding.name,
            f"{finding.state}{finding.remedy and ': '}{finding.remedy}",
        )
    yield commander(session)
    times = []
    for _ in range(READINGS):
        begin = time.monotonic()
        arm.state()
        times.append(time.monotonic() - begin)
    yield True, "reading the robot", _milliseconds(times)
    speech = session.has("ALTextToSpeech")
    yield True, "speech", "says 'Go'" if speech else "none: give the person the signal yourself"


def commander(session: Naoqi) -> Line:
    """Return the holder of the robot: a claim counts if it has a heartbeat."""
    first = holder(session)
    if not first.name:
        return True, "commanded by", "nobody"
    time.sleep(3 * BEAT)
    if holder(session) == first:
        return True, "commanded by", f"nobody; {first.name} did, and has not released it"
    return False, "commanded by", f"{first.name}: end that first"


def capture_lines(capture: LslCapture) -> Iterator[Line]:
    """Yield the state of the motion capture."""
    info: dict[str, Any] = capture.info
    yield (
        True,
        "stream",
        f"{describe_stream(info)}, {info['channels']} channels at "
        f"{info['rate_hz']:g} Hz, clock offset {1000 * info['clock_offset_s']:.3f} ms",
    )
    capture.drain()
    ages = []
    for _ in range(READINGS):
        time.sleep(0.02)
        frames = capture.drain()
        if frames:
            ages.append(awake_or_asleep() - frames[-1].time)
    if ages:
        yield max(ages) < 0.2, "age of the newest frame", _milliseconds(ages)
    rest = measure_rest(capture, MonotonicClock())
    yield (
        True,
        "table at rest",
        (
            f"human's end {rest.human_end:.4f} m, robot's end {rest.robot_end:.4f} m, "
            f"noise {1000 * rest.noise:.2f} mm, {rest.rate:.0f} frames a second"
        ),
    )


def _milliseconds(times: list[float]) -> str:
    p50, p99 = 1000 * np.percentile(times, [50, 99])
    return f"median {p50:.1f} ms, p99 {p99:.1f} ms"
