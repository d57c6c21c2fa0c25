"""The emulated laboratory, frame by frame, on any clock: a NAO, a person, a motion capture.

The person begins a lift when the robot says "Go".
"""

import queue
import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.hardware.body import CHARGE, WARM, Body
from colift.benchmark.hardware.emulated_lift import EmulatedLift
from colift.benchmark.hardware.faults import Fault, Schedule
from colift.benchmark.hardware.joint_motion import TICK, JointMotion
from colift.benchmark.hardware.markers import Markers, Row
from colift.benchmark.hardware.services import (
    BatteryService,
    FaultService,
    LifeService,
    Log,
    MemoryService,
    MotionService,
    Pause,
    PostureService,
    SpeechService,
    SystemService,
)
from colift.robots.nao.kinematics import ARM_JOINTS, arm_path

NAMES: Final = list(ARM_JOINTS)

FAULTS: Final = "ColiftFaults"
"""Name of the service that accepts requests for faults."""

FRAMES_PER_TICK: Final = round(TICK / FRAME)

FOREIGN_FRACTION: Final = 0.1
"""Fraction of its greatest speed at which another client moves a joint: 0.8 rad/s."""

BREATHS: Final = 0.2
"""Breaths per second: 12 a minute, NAOqi's default."""

CAPTURE_LATENCY: Final = 0.01
"""Time from a motion-capture frame to its sending [s]."""


@dataclass(frozen=True, kw_only=True)
class Conditions:
    """The emulated conditions."""

    scenario: Scenario
    """The person, the behaviour and the timing."""
    seed: int = 0
    """Seed of the first lift; each one after it has the next."""
    capture_latency: float = CAPTURE_LATENCY
    """Time from a motion-capture frame to its sending [s]."""
    faults: tuple[Fault, ...] = ()
    """Faults; their times count from the beginning of the first lift [s]."""


class Laboratory:
    """A laboratory whose time passes frame by frame.

    Parameters
    ----------
    conditions
        The emulated conditions.
    now
        Its time [s].
    pause
        Lets time pass [s], for calls that block.
    log
        Called with a line for each event.
    """

    def __init__(
        self, conditions: Conditions, *, now: Callable[[], float], pause: Pause, log: Log
    ) -> None:
        self._conditions, self._now, self._log = conditions, now, log
        self._go: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._lift = EmulatedLift(conditions.scenario)
        rest = dict(zip(NAMES, arm_path().joint_angles(0.0), strict=True))
        self._motion = JointMotion(rest)
        self._body = Body()
        self._ahead = self._before = np.array(self._motion.set_points(NAMES))
        self._frame = self._lifts = 0
        self._faults = Schedule(conditions.faults)
        self._reported: set[Fault] = set()
        self._markers = Markers(conditions.capture_latency)
        self.answering = threading.Event()
        """Whether the robot answers calls for its joint angles; callers wait for it."""
        self.answering.set()
        self.services: dict[str, Any] = {
            "ALMotion": MotionService(self._motion, self._body, log, pause, self.answering),
            "ALMemory": MemoryService(self._body, log),
            "ALBattery": BatteryService(self._body),
            "ALRobotPosture": PostureService(),
            "ALAutonomousLife": LifeService(),
            "ALTextToSpeech": SpeechService(self._heard, log, pause),
            "ALSystem": SystemService(),
            FAULTS: FaultService(self.request, self._faults.clear),
        }
        """NAOqi's services by name, and the service for requesting faults."""

    def _heard(self, text: str) -> None:
        """Let the person begin when the robot says "Go"."""
        if text.rstrip(".! ").lower().endswith("go"):
            self._go.put(None)

    def request(self, fault: str) -> float:
        """Schedule a fault, whose time counts from now; return the time [s].

        Raises
        ------
        InputError
            If there is no such fault.
        """
        now = self._now()
        self._faults.request(fault, now)
        return now

    def frame(self) -> set[str]:
        """Advance by a frame, capture it, and return the kinds of the faults that are active."""
        phase = self._frame % FRAMES_PER_TICK
        if phase == 0:
            self._motion.tick()
            self._before, self._ahead = self._ahead, np.array(self._motion.set_points(NAMES))
        self._frame += 1
        self._begin_lift()
        now = self._now()
        faults = self._active(now)
        # The set-points of a tick are reached at its end, as with the robot's own interpolation.
        fraction = (phase + 1) / FRAMES_PER_TICK
        commanded = self._before + (self._ahead - self._before) * fraction
        lifting = self._lift.lifting
        self._lift.advance(commanded.tolist(), self._motion.stiffness(NAMES))
        if lifting and not self._lift.lifting:
            self._log(f"lift {self._lifts} is over")
        self._motion.measure(dict(zip(NAMES, self._lift.arms.angles(), strict=True)))
        world = self._lift.world
        self._markers.capture(now, world.human_end[-1], world.robot_end[-1], faults)
        return {fault.kind for fault in faults}

    def due(self) -> Iterator[Row]:
        """Yield the motion-capture frames that are to be sent now."""
        return self._markers.due(self._now())

    def _begin_lift(self) -> None:
        """Let the person begin a lift if the robot has said "Go"."""
        if self._go.empty():
            return
        self._go.get()
        seed = self._conditions.seed + self._lifts
        self._lift.start(seed)
        self._lifts += 1
        self._faults.lift_begins(self._now())
        self._log(f"lift {self._lifts} seed {seed}")

    def _active(self, now: float) -> list[Fault]:
        """Return the active faults; those of the motors take effect here."""
        active = self._faults.active(now)
        for fault in active:
            if fault not in self._reported:
                self._reported.add(fault)
                self._log(f"fault {fault.kind}")
            if fault.kind == "foreign-setpoint":
                self._motion.set_angles(NAMES[:1], [fault.value], FOREIGN_FRACTION)
        self._harm({fault.kind: fault for fault in active}, now)
        return active

    def _harm(self, active: Mapping[str, Fault], now: float) -> None:
        """Let the active faults of the robot's body take effect."""
        body, breath = self._body, active.get("breathing")
        self._motion.motors_off("motor-off" in active)
        body.elbow = active["hot"].value if "hot" in active else WARM
        body.charge = round(active["battery"].value) if "battery" in active else CHARGE
        body.idle_posture = "idle-posture" in active
        if breath or body.breathing:
            phase = 2 * np.pi * BREATHS * (now - breath.start) if breath else 0.0
            for joint in ("LShoulderPitch", "RShoulderPitch"):
                self._motion.breathe(joint, breath.value * float(np.sin(phase)) if breath else 0.0)
        body.breathing = breath is not None

    def close(self) -> None:
        """Release the world."""
        self._lift.close()
