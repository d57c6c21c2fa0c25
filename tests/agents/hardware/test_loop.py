"""The real-time loop in simulated time: one command a period, and a policy that cannot do harm."""

import math
import threading

import numpy as np
import pytest
from colift.agents.hardware.loop import LoopSettings
from colift.agents.hardware.stops import HoldReason, Stop
from colift.base.errors import InputError
from colift.robots.nao.facts import JOINTS
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from .conftest import Patient

FRAME = 0.01


class Says:
    """Acts by a list; what is callable is called, and after the list it stays."""

    def __init__(self, actions):
        self.actions, self.seen = actions, []

    def reset(self, seed):
        self.left = list(self.actions)

    @property
    def sticks(self):
        """Whether the next action has to be waited for."""
        return bool(self.left) and callable(self.left[0])

    def act(self, observation):
        self.seen.append(observation)
        action = self.left.pop(0) if self.left else [0.0]
        return action() if callable(action) else action


def fail():
    raise RuntimeError("not today")


def test_one_command_a_period_on_time_to_the_end(play):
    trial = play("copy", duration=3.0)
    assert trial.log.stop is None
    assert np.diff(trial.lab.times("setAngles")) == pytest.approx(np.full(29, 0.1))
    assert [step.deadline for step in trial.log.steps] == pytest.approx(
        trial.log.start + 0.1 * np.arange(30)
    )
    assert trial.log.late_steps == 0


def test_the_policy_sees_what_it_would_see_in_simulation(play):
    policy = Says([[0.01]] * 5)
    trial = play(policy, duration=3.0, latency=0.15)
    seen, steps = np.array(policy.seen), trial.log.steps
    assert seen.shape == (30, 5)
    assert seen[:, 3] == pytest.approx([0.01 * min(k, 5) for k in range(30)])
    assert seen[:, 4] == pytest.approx(0.1 * np.arange(30))
    # The hands, as they will be after the arms' dead time: they go on at 0.1 m/s for five periods.
    ahead = [0.1 * 0.01 if 1 <= k <= 5 else 0.0 for k in range(30)]
    hands = [step.hand_height for step in steps]
    assert seen[:, 2] == pytest.approx(np.add(hands, ahead), abs=1e-12)
    # A sample of the age that was asked for, with the arms' dead time.
    frames = {round(s.time, 3): s for s in trial.log.samples}
    for observation, step in zip(seen[2:], steps[2:], strict=True):
        frame = frames[round(step.time - 0.14, 3)]
        assert observation[:2] == pytest.approx([frame.human_end, frame.robot_end], abs=1e-9)


def test_a_loop_that_is_held_up_skips_the_periods_and_never_catches_up(play):
    trial = play("copy", duration=3.0, faults={10: lambda lab: lab.wait_until(lab.now() + 0.37)})
    assert trial.log.late_steps == 2
    assert len(trial.log.steps) == 28
    assert np.diff(trial.lab.times("setAngles")).min() > 0.02
    late = [step.time - step.deadline for step in trial.log.steps]
    assert np.flatnonzero(np.array(late) > 0.005).tolist() == [10]


@pytest.mark.parametrize("bad", [fail, lambda: [math.nan], lambda: [0.0, 0.0], lambda: "up"])
def test_a_policy_that_fails_is_held_and_one_that_goes_on_failing_is_stopped(play, bad):
    once = play(Says([[0.01]] * 5 + [bad] + [[0.01]] * 5), duration=2.0)
    assert once.log.stop is None
    assert [step.hold for step in once.log.steps].count(HoldReason.POLICY_FAILED) == 1
    assert once.log.steps[-1].command == pytest.approx(0.1)
    always = play(Says([[0.01]] * 5 + [bad] * 50), duration=4.0)
    assert always.log.stop is Stop.POLICY
    assert len(always.log.steps) <= 5 + 13
    assert always.lab.times("setAngles")[-1] < always.log.start + 0.5


def test_a_policy_that_does_not_answer_is_not_waited_for(play):
    answer = threading.Event()
    hangs = Says([[0.01]] * 5 + [lambda: [0.01] if answer.wait(60) else None])
    trial = play(hangs, duration=4.0, decider=Patient)
    answer.set()
    assert [step.hold for step in trial.log.steps[5:8]] == [
        HoldReason.POLICY_LATE,
        HoldReason.POLICY_BUSY,
        HoldReason.POLICY_BUSY,
    ]
    assert trial.log.stop is Stop.POLICY
    assert trial.lab.times("setAngles")[-1] < trial.log.start + 0.5


WILD = st.one_of(
    st.floats(width=64).map(lambda value: [value]),
    st.floats(-0.2, 0.2).map(lambda value: [value]),
    st.sampled_from([fail, [], [[0.1]], None, [1e308], [-math.inf]]),
)


@pytest.mark.slow
@settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(st.lists(WILD, min_size=8, max_size=20))
def test_whatever_a_policy_returns_the_hands_stay_in_their_limits(play, actions):
    trial = play(Says(actions), duration=0.1 * len(actions))
    limits = trial.arm.limits
    for _, name, *arguments in trial.lab.sent:
        if name == "setAngles":
            for joint, angle in zip(*arguments[:2], strict=True):
                assert JOINTS[joint].lower < angle < JOINTS[joint].upper
    heights = trial.lab.set_points()
    assert limits.low - 1e-4 <= heights.min()
    assert heights.max() <= limits.high + 1e-4
    # Over a command's time the speed is held; within it, joint paths bend it by a tenth or so.
    assert np.abs(heights[10:] - heights[:-10]).max() <= limits.speed * 0.1 + 2e-3
    assert np.abs(np.diff(heights)).max() <= 1.25 * limits.speed * FRAME * 2


@pytest.mark.parametrize(("period", "latency"), [(0.01, 0.1), (0.6, 0.1), (0.1, 0.5), (0.1, -0.1)])
def test_times_out_of_range_are_refused(period, latency):
    with pytest.raises(InputError, match="must be"):
        LoopSettings(period=period, latency=latency)
