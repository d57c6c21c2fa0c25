"""A laboratory that is not there: a NAO and a motion capture, over the real protocols.

A libqi server offers the NAOqi services, an outlet of the Lab Streaming Layer the markers; between
them the simulated world runs in real time. The person begins a lift when the robot says "Go".
"""

import queue
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from ...agents.agent import FRAME
from ...agents.errors import InputError
from ...agents.hardware.missing import load
from ...agents.hardware.naoqi_session import one_line, quiet
from ...agents.hardware.operator import StopButton
from ...robots.arm_kinematics import ARM_JOINTS, arm_path
from ..scenario import Scenario
from .emulated_lift import EmulatedLift
from .faults import Fault
from .joint_motion import TICK, JointMotion
from .outlet import Outlet
from .services import MotionService, PostureService, SpeechService, SystemService

BEHIND: Final = 0.1
"""How far behind the clock the emulator may be [s]; further, it lets the time pass."""

NAMES: Final = list(ARM_JOINTS)


@dataclass(frozen=True, kw_only=True)
class Laboratory:
    """What is emulated."""

    scenario: Scenario
    """Who lifts how."""
    url: str = "tcp://127.0.0.1:9559"
    """Where the robot listens."""
    stream: str = "colift"
    """Name of the motion-capture stream."""
    seed: int = 0
    """Seed of the first lift; each one after it has the next."""
    capture_latency: float = 0.01
    """Time from a motion-capture frame to its sending [s]."""
    faults: tuple[Fault, ...] = ()
    """What goes wrong."""


class Emulator:
    """Runs a laboratory in real time.

    Parameters
    ----------
    laboratory
        What is emulated.
    log
        Called with a line for each thing that happens.

    Raises
    ------
    InputError
        If the robot cannot listen there, or libqi or pylsl is not installed.
    """

    def __init__(self, laboratory: Laboratory, log: Callable[[str], None]) -> None:
        self._laboratory = laboratory
        self._log = log
        self._go: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._lift = EmulatedLift(laboratory.scenario)
        rest = dict(zip(NAMES, arm_path().joint_angles(0.0), strict=True))
        self._motion = JointMotion(rest)
        self._service = MotionService(self._motion, log)
        self._session = self._serve(laboratory.url)
        self._outlet = Outlet(laboratory.stream, laboratory.capture_latency)
        self._first: float | None = None
        self._lifts = 0
        self._over: set[Fault] = set()

    def _serve(self, url: str) -> Any:
        """Return a libqi session that offers the services."""
        quiet()
        qi = load("qi")
        session = qi.Session()
        try:
            session.listenStandalone(url)
        except RuntimeError as error:
            raise InputError(f"cannot listen at {url}: {one_line(error)}") from error
        for name, service in (
            ("ALMotion", self._service),
            ("ALRobotPosture", PostureService()),
            ("ALTextToSpeech", SpeechService(self._heard, self._log)),
            ("ALSystem", SystemService()),
        ):
            session.registerService(name, service)
        return session

    def _heard(self, text: str) -> None:
        """Let the person begin when the robot says so."""
        if text.rstrip(".! ").lower().endswith("go"):
            self._go.put(None)

    def run(self, button: StopButton) -> None:
        """Run until the button is pressed."""
        begin, frame, behind = time.monotonic(), 0, 0
        ahead = before = np.array(self._motion.set_points(NAMES))
        per_tick = round(TICK / FRAME)
        while not button.wait(max(0.0, begin + frame * FRAME - time.monotonic())):
            if time.monotonic() - begin - frame * FRAME > BEHIND:
                begin = time.monotonic() - frame * FRAME
                behind += 1
                self._log(f"behind the clock, {behind} times")
            phase = frame % per_tick
            if phase == 0:
                self._motion.tick()
                before, ahead = ahead, np.array(self._motion.set_points(NAMES))
            self._begin_lift()
            faults = self._active()
            # The set-points of a tick are reached at its end, as by the robot's own interpolation.
            commanded = before + (ahead - before) * (phase + 1) / per_tick
            self._lift.advance(commanded.tolist(), self._motion.stiffness(NAMES))
            self._motion.measure(dict(zip(NAMES, self._lift.arms.angles(), strict=True)))
            world = self._lift.world
            self._outlet.frame(world.human_end[-1], world.robot_end[-1], faults, self._since())
            frame += 1

    def _since(self) -> float:
        """Return the time since the first lift was begun [s], negative before."""
        return -1.0 if self._first is None else time.monotonic() - self._first

    def _begin_lift(self) -> None:
        """Let the person begin a lift if the robot has said so."""
        if self._go.empty():
            return
        self._go.get()
        seed = self._laboratory.seed + self._lifts
        self._lift.start(seed)
        self._lifts += 1
        self._first = self._first or time.monotonic()
        self._log(f"lift {self._lifts} seed {seed}")

    def _active(self) -> Sequence[Fault]:
        """Return the active faults; those of the robot take effect here."""
        since = self._since()
        active = [fault for fault in self._laboratory.faults if fault.active(since)]
        for fault in active:
            if fault not in self._over:
                self._over.add(fault)
                self._log(f"fault {fault.kind}")
                if fault.kind == "disconnect":
                    self._session.close()
                elif fault.kind == "motor-off":
                    self._motion.motors_off()
        self._service._silence(any(fault.kind == "silence" for fault in active))
        return active

    def close(self) -> None:
        """Close the connections and the world."""
        self._service._silence(False)
        self._session.close()
        self._outlet.close()
        self._lift.close()
