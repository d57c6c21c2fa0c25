"""The audit: sampled episodes again, in fresh processes; every action must have equal bits."""

import dataclasses
import itertools

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import InProcess
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.hidden import hidden_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.audit import (
    RULE,
    audit,
    audited,
    first_differing_step,
    sampled,
)

SECRET = bytes(range(32))
QUICK = make_suite("quick-v1")
counter = itertools.count()


class Follower:
    """Follows the human's end; ``twist`` changes its twelfth action."""

    def __init__(self, twist=None):
        self.twist, self.step = twist, -1

    def reset(self, seed):
        self.step = -1

    def act(self, observation):
        self.step += 1
        change = observation[0] - observation[3]
        if self.twist and self.step == 11:
            change += self.twist()
        return np.array([change])


@dataclasses.dataclass(frozen=True, kw_only=True)
class Made(InProcess):
    """Makes followers."""

    twist: object = None
    name: str = "made"

    def check(self):
        pass

    def digest(self):
        return "0"

    def make(self):
        return Follower(self.twist)


@pytest.fixture(scope="module")
def run():
    return run_suite(Made(), QUICK)


def test_a_policy_that_answers_alike_passes(run):
    assert audit(Made(), run, SECRET) is None


def test_ten_episodes_are_played_again_and_counted(run):
    counted = []
    audit(Made(), run, SECRET, progress=counted.append)
    assert sum(counted) == audited(QUICK.size) == 10
    assert audited(3) == 3


def test_the_secret_and_the_policy_choose_the_episodes(run):
    places = sampled(run, SECRET)
    assert len(set(places)) == 10
    assert places == sampled(run, SECRET)
    assert places not in (sorted(places), sorted(places, reverse=True))
    long = dataclasses.replace(run, episodes=run.episodes * 20)
    assert sampled(long, SECRET) != sampled(long, SECRET[::-1])
    other = dataclasses.replace(long, policy_digest="1")
    assert sampled(long, SECRET) != sampled(other, SECRET)


def test_a_policy_left_to_chance_is_told_with_episode_and_step():
    policy = Made(twist=lambda: 1e-9 * next(counter))
    run = run_suite(policy, QUICK)
    finding = audit(policy, run, SECRET)
    assert (finding.index, finding.step) == (min(sampled(run, SECRET)), 11)
    episode = run.episodes[finding.index]
    for told in (episode.behaviour, episode.subject, f"seed {episode.seed}", "step 11", RULE):
        assert told in finding.describe(run)


def test_state_kept_between_episodes_is_found():
    """In the run the episodes count; afresh each is the first."""
    run = run_suite(Made(twist=lambda: 1e-9 * next(counter)), QUICK)
    finding = audit(Made(twist=lambda: 0.0), run, SECRET)
    assert finding.step == 11


def test_the_smallest_change_of_one_action_in_one_audited_episode_is_found(run):
    place = sampled(run, SECRET)[4]
    episode = run.episodes[place]
    action = episode.trace.action.copy()
    action[7] = np.nextafter(action[7], 1.0)
    changed = dataclasses.replace(episode, trace=dataclasses.replace(episode.trace, action=action))
    episodes = [changed if i == place else each for i, each in enumerate(run.episodes)]
    finding = audit(Made(), dataclasses.replace(run, episodes=tuple(episodes)), SECRET)
    assert (finding.index, finding.step) == (place, 7)


def test_an_episode_that_ends_earlier_differs_from_there_on(run):
    episode = run.episodes[0]
    trace = dataclasses.replace(episode.trace, action=episode.trace.action[:5])
    shorter = dataclasses.replace(episode, trace=trace)
    assert first_differing_step(episode, shorter) == first_differing_step(shorter, episode) == 5
    assert first_differing_step(episode, episode) is None


def test_of_an_episode_that_failed_the_steps_before_are_compared(run):
    episode = run.episodes[0]
    trace = dataclasses.replace(episode.trace, action=episode.trace.action[:5])
    failed = dataclasses.replace(episode, trace=trace, failure="step 5: no answer within 5 s")
    assert first_differing_step(failed, episode) is None
    assert first_differing_step(episode, failed) == 5
    assert first_differing_step(failed, run.episodes[1]) is not None


def test_a_zero_of_the_other_sign_differs(run):
    episode = run.episodes[0]
    zeros = np.zeros_like(episode.trace.action)
    plus, minus = (
        dataclasses.replace(episode, trace=dataclasses.replace(episode.trace, action=action))
        for action in (zeros, -zeros)
    )
    assert first_differing_step(plus, minus) == 0


def test_a_policy_that_uses_its_seed_passes():
    run = run_suite(PolicySpec(text="random"), hidden_suite(QUICK, SECRET), secret=SECRET)
    assert audit(PolicySpec(text="random"), run, SECRET) is None
