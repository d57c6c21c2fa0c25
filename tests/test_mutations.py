"""Damaged files of every kind that people edit are read, or refused in a line: no traceback."""

import math
import warnings

import pytest
from colift.agents.agent import FRAME
from colift.agents.hardware.ports import HandLimits, Sample
from colift.agents.hardware.rerun import logged_commands, rerun_trial
from colift.agents.hardware.trial_log import (
    LoggedTrial,
    Step,
    TrialLog,
    read_trial,
    write_trial,
)
from colift.agents.policies.copy import Copy
from colift.agents.submissions.manifest import read_manifest
from colift.base.errors import InputError
from colift.benchmark.channels.reading import read_channel
from colift.benchmark.hardware.estimates import estimate_setup
from colift.benchmark.suites.suite import recorded_suite
from colift.benchmark.suites.treatments import plain_treatments

from .mutations import mutations

CHANNEL = b"""[down]
delay = 0.08
jitter = "lognormal"
jitter_mean = 0.02
jitter_deviation = 0.03

[up]
delay = 0.08
loss = 0.05
burst = 2
"""

MANIFEST = b"""name = "mine"
authors = ["Ada Lovelace"]
description = "Follows the human's end."
licence = "MIT"
trained_on = "nothing"
link = "https://example.org"
entry_point = "policy:Policy"
parameters = "gain=1.2,lead=0.25"
packages = ["numpy"]
preload = false
"""


def rise(s):
    s = min(max(s, 0.0), 1.0)
    return 10 * s**3 - 15 * s**4 + 6 * s**5


def recordings():
    rows = [
        f"{name},{k / 50:.2f},{0.9 + top * (rise(k / 50 - 0.5) - rise(k / 50 - bent)):.5f}"
        for name, top, bent in (("a", 0.3, 2.0), ("b", 0.5, 1.4))
        for k in range(180)
    ]
    return "\n".join(["trial,t_s,z_m", *rows, ""]).encode()


def trial(path):
    """Return the file of a trial of 4 s."""
    log = TrialLog(period=0.1, latency=0.1)
    for k in range(40):
        log.events += [
            Sample(t, 0.2 * rise(t - 1), 0.2 * rise(t - 1.1))
            for t in (k * 0.1 + i * FRAME for i in range(10))
        ]
        at = 0.1 + 0.1 * k
        height, before = (0.2 * rise(each - 1.1) for each in (at, at - 0.1))
        log.events.append(
            Step(
                time=at, deadline=at, hand_height=before, set_point=before + 1e-3, stiffness=1.0,
                astray=0.0, hand_command=before, action=height - before, command=height, hold="",
                sensing_age=0.02, rate=math.inf if k < 10 else 100.0, state_time=1e-3,
                policy_time=2e-3, command_time=1e-3,
            )
        )  # fmt: skip
    limits = HandLimits(low=-0.05, high=0.3, speed=0.4, tilt=0.1)
    write_trial(path, LoggedTrial(policy="copy", limits=limits, weight_offset=0.0, log=log))
    return path.read_bytes()


def use_recordings(path):
    suite = recorded_suite(path)
    plain_treatments(suite)
    for scenario in suite.scenarios:
        scenario.human.plan(scenario.subject, 0)


def use_trial(path):
    read = read_trial(path)
    policy = Copy()
    policy.reset(1)
    logged_commands(rerun_trial(read, policy))
    estimate_setup([read])


USES = {
    "a recording": use_recordings,
    "a channel": lambda path: read_channel(path),
    "a manifest": lambda path: read_manifest(path.read_bytes()),
    "a trial": use_trial,
}


def outcome(use, path, data, name):
    """Return the message with which a file is refused; empty if it is read."""
    path.write_bytes(data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            use(path)
    except InputError as error:
        return str(error)
    except Exception as error:
        raise AssertionError(f"{name}: {error!r}") from error
    return ""


@pytest.mark.parametrize("kind", USES)
def test_a_damaged_file_is_read_or_refused_in_a_line(tmp_path, kind):
    path = tmp_path / "damaged"
    files = {
        "a recording": recordings,
        "a channel": lambda: CHANNEL,
        "a manifest": lambda: MANIFEST,
        "a trial": lambda: trial(path),
    }
    data = files[kind]()
    path.write_bytes(data)
    USES[kind](path)
    told = [
        message
        for number, damaged in enumerate(mutations(data, seed=1))
        if (message := outcome(USES[kind], path, damaged, f"mutation {number} of {kind}"))
    ]
    assert told
    assert [message for message in told if not message.isprintable()] == []
    assert max(map(len, told)) < 1000
