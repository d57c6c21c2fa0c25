"""The lifts of a bundle: replayed, with observations, or refused by name."""

import dataclasses
from contextlib import closing

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.environment.parallel import ParallelLift
from colift.benchmark.export.proving import proved_lifts

from .conftest import LIFTS, SUITE


@pytest.fixture(scope="module")
def lifts(bundle):
    return list(proved_lifts(bundle, SUITE, both=True))


def test_each_lift_of_the_bundle_is_there_in_its_order(lifts, bundle):
    assert [lift.scenario for lift in lifts] == list(LIFTS)
    assert [lift.steps for lift in lifts] == [len(each.trace.action) for each in bundle.episodes]
    assert {(lift.policy, lift.seed) for lift in lifts} == {("uneven", 41)}
    whole = bundle.episodes[0].trace
    assert lifts[0].state == whole.state[-1].tobytes().hex()
    assert np.array_equal(lifts[0].robot.actions, whole.action)
    assert np.array_equal(lifts[0].human.actions, whole.human_action)


@pytest.mark.parametrize("place", [0, 3])
def test_observations_rewards_and_ends_are_the_environments(lifts, place):
    exported = lifts[place]
    with closing(ParallelLift(SUITE.scenarios[place])) as env:
        seen, _ = env.reset(seed=None)
        env.lift.reset(41)
        seen = {"human": env.lift.human_observation(), "robot": env.lift.partner_observation()}
        for step in range(exported.steps):
            assert np.array_equal(seen["robot"], exported.robot.observations[step])
            assert np.array_equal(seen["human"], exported.human.observations[step])
            seen, rewards, terminated, truncated, _ = env.step(
                {"human": exported.human.actions[step], "robot": exported.robot.actions[step]}
            )
            assert rewards["robot"] == exported.robot.rewards[step]
            assert rewards["human"] == exported.human.rewards[step]
            assert terminated["robot"] == exported.terminations[step]
            assert truncated["robot"] == exported.truncations[step]
        assert env.agents == []
        assert np.array_equal(seen["robot"], exported.robot.observations[-1])
        assert np.array_equal(seen["human"], exported.human.observations[-1])


def test_a_lift_ends_by_its_horizon_or_with_its_policy(lifts):
    whole, tired, empty, _ = lifts
    assert (whole.failure, whole.dropped) == (None, None)
    assert tired.failure == "step 20: too tired"
    assert (tired.steps, tired.dropped) == (20, None)
    for lift in (whole, tired):
        assert lift.truncations.tolist() == [False] * (lift.steps - 1) + [True]
        assert not lift.terminations.any()
    assert empty.steps == 0
    assert len(empty.robot.observations) == 1


def test_a_drop_terminates_it(dropped):
    assert "inclined" in dropped.dropped
    assert dropped.terminations.tolist() == [False] * (dropped.steps - 1) + [True]
    assert not dropped.truncations.any()


def forged(bundle, **series):
    """Return the bundle with other arrays in its first lift."""
    first, *rest = bundle.episodes
    trace = dataclasses.replace(first.trace, **series)
    return dataclasses.replace(bundle, episodes=(dataclasses.replace(first, trace=trace), *rest))


def changed(array, step):
    copy = array.copy()
    copy[step, 0] = np.nextafter(copy[step, 0], 1.0)
    return copy


@pytest.mark.parametrize("name", ["action", "human_action"])
def test_an_action_that_differs_in_its_last_bit_is_refused_by_name(bundle, name):
    series = {name: changed(getattr(bundle.episodes[0].trace, name), 7)}
    with pytest.raises(InputError, match=r"^smooth/S1 seed 41, step 7: ") as refused:
        list(proved_lifts(forged(bundle, **series), SUITE))
    assert "not proved is not exported" in str(refused.value)


def test_another_hash_is_refused_by_name(bundle):
    state = bundle.episodes[0].trace.state.copy()
    state[9, 3] ^= 1
    with pytest.raises(InputError, match=r"^smooth/S1 seed 41, step 9: the hash"):
        list(proved_lifts(forged(bundle, state=state), SUITE))


def test_missing_actions_are_refused_by_name(bundle):
    first, *rest = bundle.episodes
    short = dataclasses.replace(first, trace=first.trace.until(30))
    cut = dataclasses.replace(bundle, episodes=(short, *rest))
    with pytest.raises(InputError, match=r"^smooth/S1 seed 41, step 30: the actions end"):
        list(proved_lifts(cut, SUITE))


def test_another_failure_is_refused(bundle):
    first, *rest = bundle.episodes
    said = dataclasses.replace(first, failure="step 3: PolicyError: no")
    with pytest.raises(InputError, match="the replay gives None"):
        list(proved_lifts(dataclasses.replace(bundle, episodes=(said, *rest)), SUITE))


def test_a_bundle_of_another_suite_is_refused(bundle):
    with pytest.raises(InputError, match=r"suite_digest is .*: export the bundle with colift"):
        list(proved_lifts(bundle, SUITE.with_seeds(3, 4)))


def test_a_difference_on_another_platform_is_explained(bundle):
    series = {"action": changed(bundle.episodes[0].trace.action, 7)}
    there = dataclasses.replace(
        forged(bundle, **series), platform={**bundle.platform, "libc": "another"}
    )
    with pytest.raises(InputError, match=r"another platform \(libc\): export it there"):
        list(proved_lifts(there, SUITE))
