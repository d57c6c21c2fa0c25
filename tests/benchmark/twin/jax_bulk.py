"""Lifts that are drawn in bulk: the numbers of a host's draw first, then their distribution."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.humans.hand import KERNEL, drawn_noise
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import make_drawing
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.twin import bulk
from colift.benchmark.twin.drawing import draw_lift, draw_lifts, stack
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.twin import make
from scipy import stats

TASKS = ("level", "agree", "ball", "intent")
COUNT = 1200


@pytest.fixture(scope="module", params=TASKS)
def drawn(request):
    """Return the twin of a task, lifts of the host with their scenarios, and many from them."""
    drawing = make_drawing("any", "draw", "nao", CONTROL_PERIOD, LATENCY, request.param)
    chosen = [drawing.lift(seed) for seed in range(60)]
    lifts, twin = stack([draw_lift(*each) for each in chosen]), TaskTwin.of(drawing.scenarios)
    return twin, lifts, chosen, bulk.many_lifts(twin, lifts, COUNT, jax.random.key(3))


def test_the_hand_s_noise_of_the_same_draws_is_that_of_the_host(drawn):
    _, lifts, chosen, _ = drawn
    person, frames = chosen[0][0].subject, lifts.longest * lifts.frames
    gain, tremor = drawn_noise(person, 5, frames)
    rng = np.random.default_rng(5)
    phase = 2 * np.pi * rng.random()
    white = np.concatenate([rng.standard_normal(len(KERNEL) - 1), rng.standard_normal(frames)])
    ours = person.motor_noise * bulk.smoothed(jnp.asarray(white)[:, np.newaxis])[:, 0]
    np.testing.assert_allclose(ours, gain, atol=1e-5)
    time = 0.01 * np.arange(frames)
    sine = np.sin(2 * np.pi * person.tremor_frequency * time + phase)
    np.testing.assert_allclose(person.tremor_amplitude * sine, tremor, atol=1e-9)


def test_the_tremor_is_the_sine_of_the_host(drawn):
    _, lifts, _, _ = drawn
    key = jax.random.key(7)
    phase = 2 * np.pi * np.asarray(jax.random.uniform(key, (lifts.size,)), float)
    time = 0.01 * np.arange(lifts.longest * lifts.frames)[:, np.newaxis]
    sine = np.sin(2 * np.pi * np.asarray(lifts.hand.tremor_frequency, float) * time + phase)
    ours = np.asarray(bulk.tremor(key, lifts) / lifts.hand.tremor_amplitude)
    # In single precision, an angle of 1,000 radians is known to 6e-5.
    np.testing.assert_allclose(ours.reshape(sine.shape), sine, atol=3e-4)


def test_normal_numbers_are_normal_and_independent():
    found = np.asarray(bulk.normals(jax.random.key(1), (201, 500)), float)
    assert found.shape == (201, 500)
    assert stats.kstest(found.ravel(), "norm").pvalue > 0.01
    assert 3.9 < np.abs(found).max() < 4.33
    # The two halves of a word, and neighbours.
    for one, other in ((found[:100], found[101:]), (found[1:], found[:-1])):
        assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 0.02
        assert abs(np.corrcoef(one.ravel() ** 2, other.ravel() ** 2)[0, 1]) < 0.02


def test_plans_and_bodies_are_those_of_the_drawn_lifts_in_turn(drawn):
    _, lifts, _, many = drawn
    turn = np.arange(COUNT) % lifts.size
    for kept in ("ages", "stop", "steps", "body", "hand"):
        found = jax.tree.map(np.asarray, getattr(many, kept))
        expected = jax.tree.map(lambda each: np.asarray(each)[..., turn], getattr(lifts, kept))
        jax.tree.map(np.testing.assert_array_equal, found, expected)
    for kept in ("target", "series", "facts"):
        found = jax.tree.map(np.asarray, getattr(many.drawn, kept))
        expected = jax.tree.map(
            lambda each: np.asarray(each)[..., turn], getattr(lifts.drawn, kept)
        )
        jax.tree.map(np.testing.assert_array_equal, found, expected)


def spread(lifts):
    """Return the standard deviation of each sense's error, while all lifts last."""
    least = int(lifts.steps.min())
    return np.std(np.asarray(lifts.errors[:least], float), axis=(0, 2))


def test_errors_of_senses_are_as_large_as_the_host_s(drawn):
    _, lifts, _, many = drawn
    ours, host = spread(many), spread(lifts)
    assert ((ours > 0) == (host > 0)).all()
    # The host has a few thousand numbers of each.
    np.testing.assert_allclose(ours[host > 0], host[host > 0], rtol=0.08)
    noisy = np.asarray(many.errors, float)[5][host > 0]
    assert np.abs(np.corrcoef(noisy) - np.eye(len(noisy))).max() < 0.15  # No two have one role.


def test_the_hand_s_noise_is_as_large_and_as_slow_as_the_host_s(drawn):
    _, lifts, _, many = drawn

    least = int(lifts.steps.min())  # Shorter lifts go on with their last number.

    def described(some):
        noise = np.asarray(some.gain[:least] / some.hand.motor_noise, float)
        noise = noise.reshape(-1, some.size)
        slow = [np.mean(noise[lag:] * noise[: len(noise) - lag]) for lag in (0, 5, 10, 20)]
        shaking = np.asarray(some.tremor[:least] / some.hand.tremor_amplitude)
        return np.array([*slow, np.std(shaking)])

    np.testing.assert_allclose(described(many), described(lifts), atol=0.09)


def test_manners_fill_the_population_s_ranges(drawn):
    twin, _, _, many = drawn
    for name, trait in twin.person.traits.items():
        values = np.asarray(getattr(many.drawn.manner, name), float)
        share = (values - trait.low) / (trait.high - trait.low)
        assert -1e-5 <= share.min() < 0.01
        assert 0.99 < share.max() <= 1 + 1e-5
        assert abs(share.mean() - 0.5) < 0.03


def test_a_policy_has_the_error_that_it_has_with_the_host_s_lifts(drawn):
    twin, lifts, _, many = drawn

    def following(last, view):
        return view[0], view[0] + 2.0 * (view[0] - last) - view[3]

    errors = [
        np.asarray(rollout(twin, following, jnp.zeros(some.size), some).rmse_mm)
        for some in (lifts, many)
    ]
    # Each plan has many lifts in bulk: the host's one is a draw from them.
    by_plan = errors[1].reshape(-1, lifts.size)
    means, spreads = by_plan.mean(axis=0), by_plan.std(axis=0)
    off = (errors[0] - means) / np.maximum(spreads, 1e-3)
    assert abs(off.mean()) < 4 / np.sqrt(lifts.size)
    assert np.quantile(np.abs(off), 0.9) < 3


def test_lifts_with_drawn_conditions_are_refused():
    suite = make_suite("robust-v1")
    scenarios = suite.scenarios[:2]
    lifts = draw_lifts([(each, 1) for each in scenarios])
    with pytest.raises(InputError, match="drawn one by one"):
        bulk.many_lifts(TaskTwin.of(scenarios), lifts, 10, jax.random.key(0))


def test_an_environment_of_many_lifts_with_few_plans():
    env = make("level", lifts=50, plans=5)
    assert env.pool.size == 50
    again = make("level", lifts=50, plans=5)
    one, other = (each.reset(jax.random.key(2)) for each in (env, again))
    jax.tree.map(np.testing.assert_array_equal, one, other)
    with pytest.raises(InputError, match="plans must be 1 to 5, the number of lifts, got 6"):
        make("level", lifts=5, plans=6)
