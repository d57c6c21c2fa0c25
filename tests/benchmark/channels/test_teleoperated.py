"""Policies behind a channel, in the engine."""

import dataclasses
import math

import colift
import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.agents.policies.copy import Copy
from colift.agents.rules import SCALARS
from colift.base.errors import InputError, PolicyError
from colift.benchmark.channels import Channel, Link
from colift.benchmark.channels.teleoperated import ANSWERED, Teleoperated
from colift.benchmark.episode.seat import limited_command
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.robots.nao.kinematics import STROKE

from ...four import FOUR

SUITE = FOUR.with_seeds(3, 4)
ONE = dataclasses.replace(SUITE, scenarios=SUITE.scenarios[:1])
LATE = Link(delay=0.1)
LOSSY = Channel(
    down=Link(delay=0.05, jitter_mean=0.05, jitter_deviation=0.08, loss=0.2, burst=2.0),
    up=Link(delay=0.05, jitter="lognormal", jitter_mean=0.05, jitter_deviation=0.1, loss=0.1),
)


class Waiting(Copy):
    """Copies from its second step on, as one whose first answer is late."""

    def act(self, observation):
        moves = observation[RobotObservation.TIME] > 0
        return super().act(observation) if moves else np.zeros(1)


class Failing(Copy):
    """Fails at the observation of 0.5 s, and says which came before."""

    printed = "some words"

    def act(self, observation):
        if observation[RobotObservation.TIME] > 0.45:
            raise PolicyError("enough")
        return super().act(observation)


def run(policy, suite=SUITE, **options):
    spec = PolicySpec(text=policy) if isinstance(policy, str) else policy
    return run_suite(spec, suite, **options)


def of(policy):
    return InMemorySpec(name=policy.__name__, factory=policy, source=policy)


def commands(episode):
    """Return the command before each step, and after the last."""
    found = [0.0]
    for [action] in episode.trace.action.tolist():
        found.append(limited_command(SCALARS, found[-1], action, 0.04, STROKE))
    return found


@pytest.mark.parametrize("policy", ["copy", "extrapolate", "anticipate", "random"])
def test_a_channel_without_delay_changes_no_bit(policy):
    for one, other in zip(
        run(policy).episodes, run(policy, channel=Channel()).episodes, strict=True
    ):
        bits = dataclasses.replace(other.trace, internals=one.trace.internals)
        assert bits.digest() == one.trace.digest()
        assert other.scores == one.scores
        assert other.failure is None
        assert other.trace.internals[ANSWERED].tolist() == list(range(len(one.trace.action)))


def test_an_answer_one_step_late_is_a_change_of_the_command_that_was_seen():
    """Which of the two directions is late makes no difference to a policy without memory."""
    [late] = run("copy", ONE, channel=Channel(down=LATE)).episodes
    [up] = run("copy", ONE, channel=Channel(up=LATE)).episodes
    assert late.trace.digest() == up.trace.digest()
    assert late.trace.action[0, 0] == 0.0
    assert math.isnan(late.trace.internals[ANSWERED][0])
    assert late.trace.internals[ANSWERED][1:].tolist() == list(range(len(late.trace.action) - 1))


def test_a_late_observation_is_like_an_older_sample():
    """One period on the way, or 100 ms more of latency: copy goes to the same heights."""
    [late] = run("copy", ONE, channel=Channel(down=LATE)).episodes
    [older] = run(of(Waiting), ONE.with_timing(0.2, None)).episodes
    assert commands(late) == pytest.approx(commands(older), abs=1e-12)
    assert late.trace.human_end == pytest.approx(older.trace.human_end, abs=1e-9)
    assert late.scores["rmse_mm"] == pytest.approx(older.scores["rmse_mm"], abs=1e-6)
    [without] = run("copy", ONE).episodes
    assert late.scores["rmse_mm"] > without.scores["rmse_mm"] + 2


def test_without_any_message_the_robot_holds():
    for name in ("down", "up"):
        [lost] = run("copy", ONE, channel=Channel(**{name: Link(loss=1.0)})).episodes
        [held] = run("hold", ONE).episodes
        assert lost.trace.state.tobytes() == held.trace.state.tobytes()
        assert lost.scores == held.scores


def test_the_robot_holds_exactly_when_no_new_answer_has_come():
    for episode in run("copy", channel=LOSSY).episodes:
        answered, action = episode.trace.internals[ANSWERED], episode.trace.action[:, 0]
        silent = np.isnan(answered)
        assert 0.05 < silent.mean() < 0.9
        assert (action[silent] == 0.0).all()
        assert (action[~silent] != 0.0).all()
        taken = answered[~silent]
        assert (np.diff(taken) > 0).all()


def test_processes_agree_to_the_bit():
    with local_pool(2) as pool:
        there = run("extrapolate", channel=LOSSY, executor=pool)
    here = run("extrapolate", channel=LOSSY)
    pairs = zip(here.episodes, there.episodes, strict=True)
    assert all(one.trace.digest() == other.trace.digest() for one, other in pairs)
    assert here.channel == LOSSY


def test_evaluate_takes_a_channel_by_name_file_or_object(tmp_path):
    path = tmp_path / "late.toml"
    path.write_text("[up]\ndelay = 0.1\n")
    late = Channel(up=LATE)
    [wanted] = run("copy", ONE, channel=late).episodes
    found = [colift.evaluate("copy", ONE, channel=each) for each in (path, str(path), late)]
    assert {each.rmse_mm for each in found} == {wanted.scores["rmse_mm"]}
    told = " ".join(str(found[0]).split())
    assert "over the channel to the policy 0 ms; to the robot 100 ms" in told


def test_each_lift_has_its_own_losses():
    suite = dataclasses.replace(ONE, seeds=(3, 4))
    one, other = (e.trace.internals[ANSWERED] for e in run("hold", suite, channel=LOSSY).episodes)
    size = min(len(one), len(other))
    assert not np.array_equal(one[:size], other[:size], equal_nan=True)


def test_a_failing_policy_fails_when_the_observation_arrives():
    [episode] = run(of(Failing), ONE, channel=Channel(down=Link(delay=0.2))).episodes
    assert episode.failure == "step 7: enough"
    assert episode.log == "some words"
    assert len(episode.trace.action) == 7


def test_the_policys_own_copy_of_an_observation_cannot_change_the_robots():
    class Scribbling(Copy):
        def act(self, observation):
            action = super().act(observation)
            observation[:] = 7.0
            return action

    agents = [
        Teleoperated(each(), Channel(up=LATE), frames=10, seed=1) for each in (Copy, Scribbling)
    ]
    seen = [np.array([0.01 * k, 0.0, 0.0, 0.005 * k, 0.1 * k]) for k in range(5)]
    for agent in agents:
        agent.reset(0)
    clean, scribbled = ([agent.act(each.copy()) for each in seen] for agent in agents)
    assert np.array_equal(clean, scribbled)


def test_a_second_person_has_no_channel():
    with pytest.raises(InputError, match="a channel leads to a robot, not to the partner 'human'"):
        run(SECOND_PERSON_SPEC, ONE.with_partner("human"), channel=Channel())
