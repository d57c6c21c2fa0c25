"""The ports of a recorded trial: the same frames, hands and times, through the same loop."""

from collections.abc import Sequence

from ..agent import Agent, Observation
from .decisions import Decision, Inline
from .loop import LoopSettings, run_trial
from .ports import ArmState, CaptureLostError, HandLimits, Sample
from .record import Record, Step
from .recording import TrialRecording
from .safety import next_command
from .stops import HoldReason, Stop, StopTrialError


class CsvReplay:
    """A recorded trial as motion capture, robot, clock, and end of a trial.

    Parameters
    ----------
    recording
        The trial.
    """

    def __init__(self, recording: TrialRecording) -> None:
        record = recording.record
        self._limits = recording.limits
        self._dry = recording.dry
        self._record = record
        self._groups: list[list[Sample]] = [[]]
        for event in record.events:
            if isinstance(event, Step):
                self._groups.append([])
            else:
                self._groups[-1].append(event)
        self._steps = record.steps
        self._next = 0
        self._command = 0.0

    @property
    def limits(self) -> HandLimits:
        """What the robot held its commands to."""
        return self._limits

    @property
    def step(self) -> Step:
        """The recorded step that is being played."""
        return self._steps[min(self._next, len(self._steps)) - 1]

    def now(self) -> float:
        """Return the time of the recorded step [s]."""
        return self.step.time if self._next else self._record.begin

    def wait_until(self, time: float) -> str | None:
        """Go on to the next recorded step."""
        self._next += 1
        if self._next > len(self._steps) and self._record.stop is Stop.OPERATOR:
            return self._record.reason
        return None

    @property
    def unseen(self) -> str:
        """Nothing is known of single markers."""
        return ""

    def drain(self) -> list[Sample]:
        """Return the frames that came before the recorded step."""
        if self._next > len(self._steps) and self._record.stop is Stop.CAPTURE_LOST:
            raise CaptureLostError(self._record.reason)
        group = self._groups[max(self._next - 1, 0)]
        taken, group[:] = list(group), []
        return taken

    def state(self) -> ArmState:
        """Return where the hands were."""
        if self._next > len(self._steps):
            assert self._record.stop is not None
            raise StopTrialError(self._record.stop, self._record.reason)
        step = self.step
        return ArmState(step.hand_height, step.set_point, step.stiffness, step.astray)

    def command(self, height: float, duration: float) -> float:
        """Return what the robot would have been told."""
        set_point = self._command if self._dry else self.step.set_point
        self._command = next_command(height, self._command, set_point, duration, self._limits)
        return self._command

    def stop(self) -> None:
        """Do nothing: nothing moves."""

    def close(self) -> None:
        """Do nothing: nothing is open."""

    def over(self, record: Record) -> bool:
        """Return whether all steps have been played, and nothing stopped the trial."""
        return self._next >= len(self._steps) and self._record.stop is None


class RecordedDecider(Inline):
    """Asks the policy as it was asked; one that was late then is late again."""

    def __init__(self, policy: Agent, replay: CsvReplay) -> None:
        super().__init__(policy)
        self._replay = replay

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return the policy's action, unless it was late."""
        held = self._replay.step.hold
        if held == HoldReason.POLICY_BUSY.value:
            return Decision(hold=HoldReason.POLICY_BUSY)
        answer = super().decide(observation, budget)
        return (
            Decision(hold=HoldReason.POLICY_LATE)
            if held == HoldReason.POLICY_LATE.value
            else answer
        )


def replay_trial(recording: TrialRecording, policy: Agent) -> Record:
    """Play a recorded trial again, with a policy that has been reset; return the outcome."""
    replay = CsvReplay(recording)
    record = recording.record
    settings = LoopSettings(period=record.period, latency=record.latency)
    played = run_trial(
        replay, replay, RecordedDecider(policy, replay), replay, settings=settings, end=replay
    )
    played.late_steps = record.late_steps
    return played


def recorded_commands(record: Record) -> Sequence[float]:
    """Return the commands of a trial's steps [m]."""
    return [step.command for step in record.steps]
