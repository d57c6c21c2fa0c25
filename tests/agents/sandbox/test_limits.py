"""What an episode may use up."""

import dataclasses
import json
import math
from dataclasses import asdict, fields

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.sandbox.protocol import LIMITS, Limits
from colift.base.errors import InputError
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario


@pytest.mark.parametrize("name", [each.name for each in fields(Limits)])
@pytest.mark.parametrize("value", [0, -1, math.inf, math.nan])
def test_a_limit_is_a_positive_number(name, value):
    with pytest.raises(InputError, match=f"limit {name} must be a positive number, got {value}"):
        Limits(**{name: value})


def test_another_process_gets_equal_limits():
    assert Limits(**json.loads(json.dumps(asdict(LIMITS)))) == LIMITS


def test_the_time_of_a_step_and_of_a_lift_follows_from_the_control_period():
    assert LIMITS.period == CONTROL_PERIOD
    assert (LIMITS.step_seconds, LIMITS.pace_seconds) == (100 * 0.1, pytest.approx(3 * 0.1))
    twice = Limits(period=0.2)
    assert (twice.step_seconds, twice.pace_seconds) == (100 * 0.2, pytest.approx(3 * 0.2))


def test_a_lift_of_ten_seconds_may_take_one_minute():
    assert LIMITS.start_seconds + 100 * LIMITS.pace_seconds == pytest.approx(60)
    assert LIMITS.cpu_seconds == 60


@pytest.mark.slow
def test_the_sandbox_is_given_the_period_of_the_scenario(tmp_path):
    """Steps of 0.2 s are too long at 20 ms a step, and no trouble at 500 ms."""
    (tmp_path / "slow.py").write_text(
        "import time\n"
        "class Slow:\n"
        "    def reset(self, seed): pass\n"
        "    def act(self, observation): time.sleep(0.2); return [0.0]\n"
    )
    policy = SandboxedPolicy(
        name="slow",
        origin="slow.py:Slow",
        folder=tmp_path,
        isolation="limits",
        limits=Limits(step_periods=2.0, pace_periods=2.0),
    )
    for period, failure in ((0.02, "step 0: no answer within 0.04 s"), (0.5, None)):
        scenario = dataclasses.replace(make_scenario("smooth", "S1"), control_period=period)
        (episode,) = play(policy, scenario, (0,))
        assert episode.failure == failure
    close_sandboxes()
