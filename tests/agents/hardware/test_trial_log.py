"""A recorded trial plays again to the same commands, bit for bit."""

import threading

import numpy as np
import pytest
from colift.agents.hardware.rerun import logged_commands, rerun_trial
from colift.agents.hardware.trial_log import read_trial, write_trial
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError

from .conftest import Patient


def played_again(trial, path, policy):
    """Return the trial as it comes from a file, and what comes of playing it."""
    write_trial(path, trial)
    back = read_trial(path)
    policy.reset(1)
    return back, rerun_trial(back, policy)


@pytest.mark.slow
@pytest.mark.parametrize(
    "fault",
    [
        None,
        "dropout@0:0.5",
        "dropout@0",
        "nan@0:0.4",
        "swap@0:0.6",
        "jitter@0:99:0.3",
        "disconnect@0",
        "stream-end@0",
        "motor-off@0",
        "freeze@0:0.4",
        "future-stamps@0:0.4",
        "nan-stamps@0",
        "slow@0",
        "foreign-setpoint@0:0.3",
        "hang@0",
        lambda lab: lab.button.press("SIGINT"),
        lambda lab: lab.wait_until(lab.now() + 0.37),
    ],
)
def test_the_file_is_exact_and_gives_the_same_commands(play, tmp_path, fault):
    trial = play("blend", faults={15: fault} if fault else None, duration=4.0)
    back, again = played_again(trial.trial, tmp_path / "trial.csv", PolicySpec(text="blend").make())
    for there, here in zip(trial.log.steps, back.log.steps, strict=True):
        np.testing.assert_array_equal(there[:8], here[:8])
    np.testing.assert_array_equal(np.array(trial.log.samples), np.array(back.log.samples))
    assert logged_commands(again) == logged_commands(trial.log)
    assert (again.stop, len(again.steps)) == (trial.log.stop, len(trial.log.steps))


def test_another_policy_gives_other_commands(play, tmp_path):
    trial = play("copy", duration=3.0)
    _, again = played_again(trial.trial, tmp_path / "t.csv", PolicySpec(text="hold").make())
    assert [step.action for step in again.steps] == [0.0] * 30
    assert logged_commands(again) != logged_commands(trial.log)


def test_a_policy_that_was_late_is_late_again(play, tmp_path):
    go_on = threading.Event()

    class Late:
        def __init__(self, waits):
            self.waits = waits

        def reset(self, seed):
            self.step = 0

        @property
        def sticks(self):
            return self.step == 4

        def act(self, observation):
            self.step += 1
            if self.waits and self.step == 5:
                go_on.wait(60)
            return np.array([0.002 * self.step])

    def answer(lab):
        go_on.set()
        asked[0].await_answer()

    def decider(policy):
        asked.append(Patient(policy))
        return asked[0]

    asked = []
    trial = play(Late(waits=True), faults={8: answer}, duration=2.0, decider=decider)
    held = [step.hold for step in trial.log.steps]
    assert held[4:8] == ["the policy was late", *["the policy is still at an earlier step"] * 3]
    assert not any(held[:4] + held[8:])
    _, again = played_again(trial.trial, tmp_path / "t.csv", Late(waits=False))
    assert logged_commands(again) == logged_commands(trial.log)
    assert [step.hold for step in again.steps] == held


def test_a_dry_run_moves_nothing_and_replays_too(play, tmp_path):
    trial = play("copy", duration=3.0, dry=True)
    assert max(logged_commands(trial.log)) > 0.1
    assert trial.lab.times("setAngles") == []
    assert np.ptp(trial.lab.set_points()) == 0.0
    back, again = played_again(trial.trial, tmp_path / "t.csv", PolicySpec(text="copy").make())
    assert back.dry
    assert logged_commands(again) == logged_commands(trial.log)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "not a trial log"),
        ("a,b\n1,2\n", "not a trial log: it has no column 'event'"),
        ("event,policy\nsample,\n", "the first row is 'sample'"),
        (None, "cannot be read"),
    ],
)
def test_a_file_that_is_not_a_trial_log_is_refused_by_name(tmp_path, text, told):
    path = tmp_path / "mine.csv"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError, match=told) as refused:
        read_trial(path)
    assert "mine.csv" in str(refused.value)
