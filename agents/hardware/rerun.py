"""Rerun of a logged trial: the same frames, hand states and times through the same loop."""

from collections.abc import Sequence

from colift.agents.agent import Agent, Observation
from colift.agents.hardware.decisions import Decision, Inline
from colift.agents.hardware.loop import LoopSettings, run_trial
from colift.agents.hardware.ports import ArmState, CaptureLostError, HandLimits, Sample
from colift.agents.hardware.safety import next_command
from colift.agents.hardware.stops import HoldReason, Stop, StopTrialError
from colift.agents.hardware.trial_log import LoggedTrial, Step, TrialLog


class LoggedPorts:
    """A logged trial as motion capture, robot, clock and trial end.

    Parameters
    ----------
    trial
        The trial.
    """

    def __init__(self, trial: LoggedTrial) -> None:
        log = trial.log
        self._limits = trial.limits
        self._dry = trial.dry
        self._log = log
        self._groups: list[list[Sample]] = [[]]
        for event in log.events:
            if isinstance(event, Step):
                self._groups.append([])
            else:
                self._groups[-1].append(event)
        self._steps = log.steps
        self._next = 0
        self._command = 0.0

    @property
    def limits(self) -> HandLimits:
        """Limits to which the robot clipped its commands."""
        return self._limits

    @property
    def step(self) -> Step:
        """The present step of the log."""
        return self._steps[min(self._next, len(self._steps)) - 1]

    def now(self) -> float:
        """Return the time of the present step [s]."""
        return self.step.time if self._next else self._log.begin

    def wait_until(self, time: float) -> str | None:
        """Advance to the next logged step."""
        self._next += 1
        if self._next > len(self._steps) and self._log.stop is Stop.OPERATOR:
            return self._log.reason
        return None

    @property
    def unseen(self) -> str:
        """Empty: the log has no markers."""
        return ""

    def drain(self) -> list[Sample]:
        """Return the frames that came before the present step."""
        if self._next > len(self._steps) and self._log.stop is Stop.CAPTURE_LOST:
            raise CaptureLostError(self._log.reason)
        group = self._groups[max(self._next - 1, 0)]
        taken, group[:] = list(group), []
        return taken

    def state(self) -> ArmState:
        """Return the logged state of the hands."""
        if self._next > len(self._steps):
            assert self._log.stop is not None
            raise StopTrialError(self._log.stop, self._log.reason)
        step = self.step
        return ArmState(step.hand_height, step.set_point, step.stiffness, step.astray)

    def command(self, height: float, duration: float) -> float:
        """Return the height that would have been commanded [m]."""
        set_point = self._command if self._dry else self.step.set_point
        self._command = next_command(height, self._command, set_point, duration, self._limits)
        return self._command

    def stop(self) -> None:
        """Do nothing: nothing moves."""

    def close(self) -> None:
        """Do nothing: nothing is open."""

    def over(self, log: TrialLog) -> bool:
        """Return whether all steps are done, and the logged trial was not stopped."""
        return self._next >= len(self._steps) and self._log.stop is None


class LoggedDecider(Inline):
    """Requests to a policy; an answer that was late in the log is late again."""

    def __init__(self, policy: Agent, ports: LoggedPorts) -> None:
        super().__init__(policy)
        self._ports = ports

    def decide(self, observation: Observation, budget: float) -> Decision:
        """Return the policy's action, unless it was late."""
        held = self._ports.step.hold
        if held == HoldReason.POLICY_BUSY.value:
            return Decision(hold=HoldReason.POLICY_BUSY)
        answer = super().decide(observation, budget)
        if held == HoldReason.POLICY_LATE.value:
            return Decision(hold=HoldReason.POLICY_LATE)
        return answer


def rerun_trial(trial: LoggedTrial, policy: Agent) -> TrialLog:
    """Run a logged trial again with a policy that has been reset; return the new log."""
    ports = LoggedPorts(trial)
    settings = LoopSettings(period=trial.log.period, latency=trial.log.latency)
    decider = LoggedDecider(policy, ports)
    log = run_trial(ports, ports, decider, ports, settings=settings, end=ports)
    log.late_steps = trial.log.late_steps
    return log


def logged_commands(log: TrialLog) -> Sequence[float]:
    """Return the commands of a trial's steps [m]."""
    return [step.command for step in log.steps]
