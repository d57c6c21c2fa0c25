"""The real-time loop: one decision and at most one command in each control period.

Deadlines are absolute, ``start + k T``: a step that comes late does not shift those after it.
Periods that were missed as a whole are skipped, count as holds, and are not made up for. A process
that was suspended, or a machine that was, cannot keep any limit meanwhile: the loop stops the trial
before it sends anything after a gap of :data:`LONGEST_GAP`.

Each step reads the robot, judges the motion capture, asks the policy, and gives one command: the
same as in simulation, apart from timing. A fault in one of these holds the hands at the last
command; a fault that lasts longer than :data:`.holds.LIMIT`, or that waiting cannot end, stops the
trial.
"""

from dataclasses import dataclass
from math import nan
from typing import Final

import numpy as np
from colift.agents.agent import Observation, RobotObservation
from colift.agents.hardware.conduct import Conduct
from colift.agents.hardware.decisions import Decider, Decision
from colift.agents.hardware.frames import UNDATED, drained
from colift.agents.hardware.holds import LIMIT, WINDOW, Holds
from colift.agents.hardware.plausibility import CaptureMonitor, at
from colift.agents.hardware.ports import ArmState, Clock, MotionCapture, RobotArm
from colift.agents.hardware.safety import limited, motor_fault
from colift.agents.hardware.stops import HoldReason, Stop, StopTrialError, losses_stop
from colift.agents.hardware.trial_end import TrialEnd
from colift.agents.hardware.trial_log import Step, TrialLog
from colift.agents.real_time import POLICY_SHARE
from colift.base.errors import InputError

DEAD_TIME: Final = 0.01
"""Mean time from a command until the hands begin to move [s]: half a cycle of ALMotion, which
accepts commands every 20 ms."""

FASTEST_LOOP: Final = 0.02
"""Shortest control period [s]: one cycle of the NAO's motion thread."""

SLOWEST_LOOP: Final = 0.5
"""Longest control period [s], as in simulation."""

LONGEST_GAP: Final = 0.5
"""Longest time between two steps, or from the start of a step to its command [s]; or two periods,
if these are longer."""


@dataclass(frozen=True, kw_only=True)
class LoopSettings:
    """Times of the loop: the control period, and the age of the frame that it acts on.

    Raises
    ------
    InputError
        If a time is out of range.
    """

    period: float = 0.1
    """Control period T [s]."""
    latency: float = 0.1
    """Time from the policy's motion-capture frame until the hands begin to move [s]: the frame's
    age plus :data:`DEAD_TIME`, which is 0 in simulation. If even the newest frame is older, that
    one is used. The policies were made for 0.1 s, the suites' latency."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        if not FASTEST_LOOP <= self.period <= SLOWEST_LOOP:
            raise InputError(
                f"the control period must be {FASTEST_LOOP} to {SLOWEST_LOOP} s, got {self.period}"
            )
        if not 0 <= self.latency < 0.5:
            raise InputError(f"the latency must be in [0, 0.5) s, got {self.latency}")


def run_trial(
    robot: RobotArm,
    capture: MotionCapture,
    decider: Decider,
    clock: Clock,
    *,
    settings: LoopSettings,
    end: TrialEnd,
) -> TrialLog:
    """Play one trial, from the hands at rest to its end or to a stop.

    Whatever happens, this returns: with the robot stopped if ``log.stop`` is set.

    Parameters
    ----------
    robot, capture, clock
        The ports. The hands are at height 0.
    decider
        Requests actions from the policy, which has been reset.
    settings
        Control period and latency.
    end
        Criterion for the end of the trial.
    """
    log = TrialLog(period=settings.period, latency=settings.latency)
    loop = _Loop(robot, capture, decider, clock, settings, log)
    try:
        loop.begin()
        while not end.over(log):
            loop.step()
    except StopTrialError as stop:
        robot.stop()
        cause = loop.cause(stop)
        log.stop, log.reason = cause.stop, cause.reason
    except BaseException:
        robot.stop()
        raise
    return log


class _Loop:
    """The state of one trial."""

    def __init__(
        self,
        robot: RobotArm,
        capture: MotionCapture,
        decider: Decider,
        clock: Clock,
        settings: LoopSettings,
        log: TrialLog,
    ) -> None:
        self._robot, self._capture, self._clock = robot, capture, clock
        self._decider, self._settings, self._log = decider, settings, log
        self._watch, self._holds, self._conduct = (
            CaptureMonitor(),
            Holds(),
            Conduct(robot.limits.tilt),
        )
        self._command = 0.0
        self._speed = 0.0
        self._number = 0
        self._began = 0.0

    def begin(self) -> None:
        """Set the first deadline."""
        self._log.begin = self._began = self._clock.now()
        self._frames(self._log.begin)

    def cause(self, stop: StopTrialError) -> StopTrialError:
        """Return why the trial stops: what was late while this machine was away is not to blame."""
        late = stop.stop is Stop.ROBOT_LOST and self._away(self._clock.now())
        return late or stop

    def _away(self, now: float) -> StopTrialError | None:
        """Return a stop if too long a time has passed since the last step began."""
        gap = now - self._began
        if gap <= max(LONGEST_GAP, 2 * self._settings.period) + 1e-6:
            return None
        return StopTrialError(
            Stop.CONTROLLER,
            f"this machine was away for {gap:.1f} s: the process was stopped, the machine "
            "suspended, or too busy",
        )

    def _present(self, now: float) -> None:
        """Stop if this machine was away until now."""
        if away := self._away(now):
            raise away

    def step(self) -> None:
        """Wait for the deadline, decide and command."""
        period, log, clock = self._settings.period, self._log, self._clock
        deadline = log.start + self._number * period
        pressed = clock.wait_until(deadline)
        if pressed is not None:
            raise StopTrialError(Stop.OPERATOR, f"stopped by the operator: {pressed}")
        now = clock.now()
        self._present(now)
        missed = int((now - deadline) / period)
        if missed > 0:
            log.late_steps += missed
            self._holds.step(max(deadline, self._began), held=True)
            self._number += missed
            deadline = log.start + self._number * period
        number = self._number
        self._number += 1
        self._began = now
        self._frames(now)
        with losses_stop():
            state = self._robot.state()
        read = clock.now()
        hold = self._watch.judge(now, state.height)
        age = self._watch.age(now)
        fault = motor_fault(state)
        decision = Decision(hold=hold)
        if hold is None and fault is None:
            observation = self._observation(now, number * period, state)
            decision = self._decider.decide(observation, POLICY_SHARE * period)
        decided = clock.now()
        self._present(decided)
        before = self._command
        if decision.action is not None:
            wanted = limited(before + decision.action, before, period, self._robot.limits)
            self._give(self._conduct.level(wanted, before, self._watch.samples[-1].human_end))
        self._speed = (self._command - before) / period
        commanded = clock.now()
        log.events.append(
            Step(
                time=now,
                deadline=deadline,
                hand_height=state.height,
                set_point=state.set_point,
                stiffness=state.stiffness,
                astray=state.astray,
                hand_command=before,
                action=nan if decision.action is None else decision.action,
                command=self._command,
                hold=fault or ("" if decision.hold is None else decision.hold.value),
                sensing_age=age,
                rate=self._watch.rate(now),
                state_time=read - now,
                policy_time=decided - read,
                command_time=commanded - decided,
            )
        )
        if fault is not None:
            raise StopTrialError(Stop.MOTORS, fault)
        self._limit_hold(now, age, decision, skipped=missed > 0)
        self._conduct.commands(now, self._command)
        if hold is None:
            self._conduct.tilts(now, self._watch.samples[-1])

    def _frames(self, now: float) -> None:
        """Process the frames that the motion capture has sent."""
        frames, misdated = drained(self._capture, now)
        self._log.events.extend([*frames, *[UNDATED] * misdated])
        self._watch.take(frames, misdated)

    def _give(self, height: float) -> None:
        with losses_stop():
            self._command = self._robot.command(height, self._settings.period)

    def _observation(self, now: float, time: float, state: ArmState) -> Observation:
        """Return the policy's observation, laid out as in simulation.

        The hands are extrapolated to the time when they begin to move: until then they continue at
        their commanded speed.
        """
        sample = at(self._watch.samples, now - max(0.0, self._settings.latency - DEAD_TIME))
        observation = np.empty(len(RobotObservation))
        observation[RobotObservation.HUMAN_END] = sample.human_end
        observation[RobotObservation.ROBOT_END] = sample.robot_end
        observation[RobotObservation.HAND_HEIGHT] = state.height + self._speed * DEAD_TIME
        observation[RobotObservation.HAND_COMMAND] = self._command
        observation[RobotObservation.TIME] = time
        return observation

    def _limit_hold(self, now: float, age: float, decision: Decision, *, skipped: bool) -> None:
        """Stop if the hands have been held for too long."""
        held = self._holds.step(now, held=decision.hold is not None)
        hold = decision.hold or (HoldReason.SKIPPED if skipped else None)
        # Steps come a period apart: the one nearest to the limit counts.
        lasted = held > LIMIT - self._settings.period / 2
        if hold is None or not (lasted or (hold is HoldReason.STALE and age > LIMIT)):
            return
        detail = decision.reason
        if hold is HoldReason.SKIPPED:
            detail = f"{self._log.late_steps} in all; this machine is too busy"
        if hold is HoldReason.NOT_SEEN:
            detail = self._capture.unseen
        if hold is HoldReason.STALE and self._log.misdated:
            detail = f"{self._log.misdated} frames had time stamps ahead of the clock, or none"
        raise StopTrialError(
            Stop.after(hold),
            f"{hold.value}; the hands were held for {held:.1f} s of the last "
            f"{WINDOW:g} s{detail and ': '}{detail}",
        )
