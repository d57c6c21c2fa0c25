"""The real-time loop: one decision and at most one command in each control period.

Deadlines are absolute, ``start + k T``: a step that comes late does not shift those after it. When
whole periods have been missed, they are skipped and counted, and never caught up with.

Each step reads the robot, judges the motion capture, asks the policy, and gives one command: the
same as in simulation, up to what the clock makes of it. What cannot be acted on holds the hands
where they were told to go last; what lasts longer than :data:`HOLD_LIMIT`, or cannot be waited
for, stops the trial.
"""

from dataclasses import dataclass
from math import nan
from typing import Final

import numpy as np

from ..agent import Observation, RobotObservation
from ..errors import InputError
from .decisions import Decider, Decision
from .plausibility import Watch, at
from .ports import ArmState, CaptureLostError, Clock, MotionCapture, RobotArm, RobotLostError
from .record import Record, Step
from .safety import LOWEST_STIFFNESS, TRACKING_ERROR
from .stops import Hold, Stop, StopTrialError
from .trial_end import TrialEnd

HOLD_LIMIT: Final = 1.0
"""How long the hands are held before the trial is stopped [s]; also the age of the newest frame
from which the motion capture is lost."""

POLICY_SHARE: Final = 0.6
"""Share of the control period that the policy may take."""

DEAD_TIME: Final = 0.01
"""Mean time from a command to the hands' setting out [s]: half a cycle of ALMotion, which takes
commands in every 20 ms."""

FASTEST_LOOP: Final = 0.02
"""Shortest control period [s]: one cycle of the NAO's motion thread."""

SLOWEST_LOOP: Final = 0.5
"""Longest control period [s], as in simulation."""


@dataclass(frozen=True, kw_only=True)
class LoopSettings:
    """When the loop decides, and on how old a frame.

    Raises
    ------
    InputError
        If a time is out of range.
    """

    period: float = 0.1
    """Control period T [s]."""
    latency: float = 0.1
    """Time from the motion-capture frame that the policy is given to the hands' setting out [s]:
    its age and :data:`DEAD_TIME`, as in simulation, where there is no dead time. The newest frame
    there is, if that is older. The policies were made for 0.1 s, the paper's."""

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
) -> Record:
    """Play one trial, from the hands at rest to its end or to a stop.

    Whatever happens, this returns: with the robot stopped if ``record.stop`` is set.

    Parameters
    ----------
    robot, capture, clock
        The ports. The hands are at height 0.
    decider
        Asks the policy, which has been reset.
    settings
        Times.
    end
        Says when the trial is over.
    """
    record = Record(period=settings.period, latency=settings.latency)
    loop = _Loop(robot, capture, decider, clock, settings, record)
    try:
        loop.begin()
        while not end.over(record):
            loop.step()
    except StopTrialError as stop:
        robot.stop()
        record.stop, record.reason = stop.stop, stop.reason
    except BaseException:
        robot.stop()
        raise
    return record


class _Loop:
    """The state of one trial."""

    def __init__(
        self,
        robot: RobotArm,
        capture: MotionCapture,
        decider: Decider,
        clock: Clock,
        settings: LoopSettings,
        record: Record,
    ) -> None:
        self._robot, self._capture, self._clock = robot, capture, clock
        self._decider, self._settings, self._record = decider, settings, record
        self._watch = Watch()
        self._command = 0.0
        self._speed = 0.0
        self._number = 0
        self._held_since: float | None = None

    def begin(self) -> None:
        """Set the first deadline."""
        self._record.begin = self._clock.now()
        self._frames()

    def step(self) -> None:
        """Wait for the deadline, decide and command."""
        period, record, clock = self._settings.period, self._record, self._clock
        deadline = record.start + self._number * period
        pressed = clock.wait_until(deadline)
        if pressed is not None:
            raise StopTrialError(Stop.OPERATOR, f"stopped by the operator: {pressed}")
        now = clock.now()
        missed = int((now - deadline) / period)
        if missed > 0:
            record.late_steps += missed
            self._number += missed
            deadline = record.start + self._number * period
        number = self._number
        self._number += 1
        self._frames()
        state = self._state()
        read = clock.now()
        hold = self._watch.judge(now, state.height)
        age = self._watch.age(now)
        fault = motor_fault(state)
        decision = Decision(hold=hold)
        if hold is None and fault is None:
            observation = self._observation(now, number * period, state)
            decision = self._decider.decide(observation, POLICY_SHARE * period)
        decided = clock.now()
        before = self._command
        if decision.action is not None:
            self._give(before + decision.action)
        self._speed = (self._command - before) / period
        commanded = clock.now()
        record.events.append(
            Step(
                time=now,
                deadline=deadline,
                hand_height=state.height,
                set_point=state.set_point,
                stiffness=state.stiffness,
                hand_command=before,
                action=nan if decision.action is None else decision.action,
                command=self._command,
                hold=fault or ("" if decision.hold is None else decision.hold.value),
                sensing_age=age,
                state_time=read - now,
                policy_time=decided - read,
                command_time=commanded - decided,
            )
        )
        if fault is not None:
            raise StopTrialError(Stop.MOTORS, fault)
        self._limit_hold(now, age, decision)

    def _frames(self) -> None:
        """Take in what the motion capture has sent."""
        try:
            frames = self._capture.drain()
        except CaptureLostError as error:
            raise StopTrialError(Stop.CAPTURE_LOST, str(error)) from error
        self._record.events.extend(frames)
        self._watch.take(frames)

    def _state(self) -> ArmState:
        try:
            return self._robot.state()
        except RobotLostError as error:
            raise StopTrialError(Stop.ROBOT_LOST, str(error)) from error

    def _give(self, height: float) -> None:
        try:
            self._command = self._robot.command(height, self._settings.period)
        except RobotLostError as error:
            raise StopTrialError(Stop.ROBOT_LOST, str(error)) from error

    def _observation(self, now: float, time: float, state: ArmState) -> Observation:
        """Return what the policy sees, laid out as in simulation.

        All of it is as at the time when the hands set out: until then they go on at the speed that
        they were told to have.
        """
        sample = at(self._watch.samples, now - max(0.0, self._settings.latency - DEAD_TIME))
        observation = np.empty(len(RobotObservation))
        observation[RobotObservation.HUMAN_END] = sample.human_end
        observation[RobotObservation.ROBOT_END] = sample.robot_end
        observation[RobotObservation.HAND_HEIGHT] = state.height + self._speed * DEAD_TIME
        observation[RobotObservation.HAND_COMMAND] = self._command
        observation[RobotObservation.TIME] = time
        return observation

    def _limit_hold(self, now: float, age: float, decision: Decision) -> None:
        """Stop if the hands have been held for too long."""
        hold = decision.hold
        if hold is None:
            self._held_since = None
            return
        if self._held_since is None:
            self._held_since = now
        # Steps come a period apart: the one nearest to the limit counts.
        lasted = now - self._held_since > HOLD_LIMIT - self._settings.period / 2
        if lasted or (hold is Hold.STALE and age > HOLD_LIMIT):
            told = f": {decision.reason}" if decision.reason else ""
            raise StopTrialError(Stop.after(hold), f"{hold.value} for {HOLD_LIMIT:g} s{told}")


def motor_fault(state: ArmState) -> str | None:
    """Return what is wrong with the hands, or None if they do what they were told."""
    if not state.stiffness >= LOWEST_STIFFNESS:
        return f"an arm motor has the stiffness {state.stiffness:.2f}"
    if not abs(state.height - state.set_point) <= TRACKING_ERROR:
        return f"the hands are at {state.height:.3f} m, told to be at {state.set_point:.3f} m"
    return None
