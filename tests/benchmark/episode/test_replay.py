"""A replay: the same episode, from the actions alone."""

import dataclasses

import numpy as np
import pytest
from colift.agents.policies.copy import Copy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.replay import ReplayError, replay
from colift.benchmark.suites.catalogue import make_scenario
from hypothesis import given, settings
from hypothesis import strategies as st


class Acting:
    """Does what it is given, then raises."""

    def __init__(self, actions):
        self.actions = iter(actions)

    def reset(self, seed):
        pass

    def act(self, observation):
        return [next(self.actions)]


class Broken:
    def reset(self, seed):
        raise RuntimeError("no model file")

    def act(self, observation):
        raise AssertionError


class Throwing:
    """A person at the robot's end who throws the table up and down."""

    def __init__(self):
        self.step = 0

    def reset(self, seed):
        pass

    def act(self, observation):
        self.step += 1
        return np.full(2, 0.5 if self.step // 5 % 2 else -0.2)


@pytest.fixture(scope="module")
def lift():
    made = Lift(make_scenario("pause", "S2"))
    yield made
    made.close()


@pytest.fixture(scope="module")
def rough():
    made = Lift(make_scenario("smooth", "S3", partner="human", control_period=0.02))
    yield made
    made.close()


def same(episode, found):
    """Assert that a replay is the episode, in every bit."""
    bare = dataclasses.replace(episode.trace, internals={})
    assert found.trace.digest() == bare.digest()
    assert found.failure == episode.failure
    assert repr(found.scores) == repr(episode.scores)
    assert found.scripted.tobytes() == episode.trace.human_action.tobytes()


def again(lift, episode):
    trace = episode.trace
    return replay(lift, episode.seed, trace.human_action, trace.action, episode.failure)


def test_it_is_the_episode_to_the_bit_on_a_used_or_a_new_lift(lift):
    episode = run_episode(lift, Copy(), 4)
    same(episode, again(lift, episode))
    new = Lift(lift.scenario)
    same(episode, again(new, episode))
    new.close()


@settings(max_examples=15, deadline=None)
@given(
    seed=st.integers(0, 2**128 - 1),
    actions=st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=40),
)
def test_any_actions_that_then_fail_replay_to_the_same_end(lift, seed, actions):
    episode = run_episode(lift, Acting(actions), seed)
    assert episode.failure is not None
    same(episode, again(lift, episode))


def test_a_policy_that_fails_at_once_replays_to_nothing(lift):
    episode = run_episode(lift, Broken(), 4)
    found = again(lift, episode)
    same(episode, found)
    assert found.failure == "start: RuntimeError: no model file"


def test_a_drop_follows_from_the_actions_whatever_is_claimed(rough):
    torn = run_episode(rough, Throwing(), 4)
    assert "N pull" in torn.failure
    same(torn, again(rough, torn))
    trace = torn.trace
    for claimed in (None, "step 3: ValueError: no", "another reason"):
        found = replay(rough, 4, trace.human_action, trace.action, claimed)
        assert found.failure == torn.failure
        assert repr(found.scores) == repr(torn.scores)


def test_a_failure_of_a_whole_episode_is_not_believed(lift):
    episode = run_episode(lift, Copy(), 4)
    trace = episode.trace
    found = replay(lift, 4, trace.human_action, trace.action, "step 97: ValueError: no")
    assert found.failure is None
    assert repr(found.scores) == repr(episode.scores)


@pytest.mark.parametrize(
    "claimed", [None, "step 6: ValueError: no", "step 8: ValueError: no", "start: no", "dropped"]
)
def test_actions_that_end_early_need_a_failure_at_that_step(lift, claimed):
    trace = run_episode(lift, Copy(), 4).trace
    with pytest.raises(ReplayError, match="the actions end") as caught:
        replay(lift, 4, trace.human_action[:7], trace.action[:7], claimed)
    assert caught.value.step == 7


def test_actions_after_the_end_are_refused(lift):
    trace = run_episode(lift, Copy(), 4).trace
    human, robot = (np.concatenate((a, a[-1:])) for a in (trace.human_action, trace.action))
    with pytest.raises(ReplayError, match=f"the episode has {len(trace.action)} steps") as caught:
        replay(lift, 4, human, robot, None)
    assert caught.value.step == len(trace.action)
    assert caught.value.found.trace.digest() == trace.digest()
    assert caught.value.found.scripted.tobytes() == trace.human_action.tobytes()


def test_another_human_is_obeyed_and_told_apart(lift):
    trace = run_episode(lift, Copy(), 4).trace
    helpful = trace.human_action.copy()
    helpful[30:] *= 0.5
    found = replay(lift, 4, helpful, trace.action, None)
    assert found.trace.human_end.max() < trace.human_end.max() - 0.02
    unequal = (found.scripted != helpful).any(axis=1)
    assert unequal.argmax() == 30


@pytest.mark.parametrize("end", ["human", "robot"])
def test_an_action_that_is_none_is_refused_with_its_step(lift, end):
    trace = run_episode(lift, Copy(), 4).trace
    actions = {"human": trace.human_action.copy(), "robot": trace.action.copy()}
    actions[end][12, 0] = np.nan
    with pytest.raises(ReplayError, match=f"{end}'s action must be finite") as caught:
        replay(lift, 4, actions["human"], actions["robot"], None)
    assert caught.value.step == 12
    assert caught.value.found.trace.digest() == trace.until(12).digest()
    assert len(caught.value.found.scripted) == 12
    with pytest.raises(ReplayError, match="must be 10 number"):
        replay(lift, 4, actions["human"][:, :9], actions["robot"], None)
