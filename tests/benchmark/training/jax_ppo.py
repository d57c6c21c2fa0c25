"""Proximal policy optimisation on the twin; run by test_ppo.py in a process of its own."""

from functools import partial

import numpy as np
import pytest
from colift.agents.submissions.network import policy as shipped
from colift.agents.submissions.network.policy import Network, Policy
from colift.benchmark.training import validation
from colift.benchmark.training.course import open_course
from colift.benchmark.training.ppo_settings import PpoSettings
from colift.benchmark.training.validation import lift_together, validation_error
from colift.benchmark.twin.libraries import require_jax

require_jax()

import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
from colift.benchmark.training import actor_critic, ppo, robot_seat  # noqa: E402

TINY = PpoSettings(updates=8, pool=32, lifts=32, steps=3, hidden=8, epochs=4, batches=8, rate=5e-3)
SEEDS = [100_000, 100_001, 100_002, 100_003]


@pytest.fixture(scope="module", autouse=True)
def two_lifts_to_validate():
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])
        yield


@pytest.fixture(scope="module")
def parameters():
    """Return parameters whose policy corrects much, with little noise."""
    rng = np.random.default_rng(0)
    drawn = jax.tree.map(
        lambda each: jnp.asarray(rng.normal(0, 0.15, each.shape), jnp.float32),
        ppo.start(TINY, 0).parameters,
    )
    return {**drawn, "log_noise": jnp.asarray(-6.0)}


@pytest.fixture(scope="module")
def lifts():
    return ppo.twin_lifts.stack([ppo.drawn_lift(seed) for seed in SEEDS])


@pytest.fixture(scope="module")
def played(parameters, lifts):
    return ppo.collect(TINY, parameters, lifts, jax.random.key(0))


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    course = open_course(tmp_path_factory.mktemp("trained"), "ppo", TINY, 0)
    ppo.train_ppo(TINY, course)
    return course


def test_the_inputs_and_the_network_are_those_of_the_shipped_policy(parameters):
    network = Network(actor_critic.weights(parameters))
    senses, past = shipped.Senses(3), robot_seat.nothing_sensed(3, 1)
    for number, view in enumerate(np.random.default_rng(1).normal(0, 0.05, (6, 5))):
        past, inputs = robot_seat.sense(past, jnp.asarray(view)[:, None], jnp.asarray(number == 0))
        wanted = senses(view)
        np.testing.assert_allclose(inputs[0], wanted, atol=1e-7)
        output = actor_critic.output(parameters["policy"], robot_seat.scaled(inputs)[0])
        correction = shipped.CORRECTION * np.tanh(output)
        assert correction == pytest.approx(network.correction(wanted), abs=1e-6)


def test_the_rewards_are_those_of_the_engine(parameters, lifts, played):
    """The twin's deviation from the engine is below 2 % of an error, the noise below that."""
    squares = -(played.reward * played.valid).sum(axis=0) / lifts.steps
    network = Network(actor_critic.weights(parameters))
    errors = [lift_together([partial(Policy, network)], seed)[0][0] for seed in SEEDS]
    np.testing.assert_allclose(10 * np.sqrt(squares), errors, rtol=0.02)


def test_an_advantage_is_the_discounted_sum_of_surprises_until_the_horizon():
    settings = PpoSettings(discount=0.5, trace=0.8)
    reward, value = np.array([-1.0, -2.0, -4.0, -8.0]), np.array([0.5, -1.0, 2.0, 9.0])
    valid = np.array([1.0, 1.0, 1.0, 0.0])
    zero = jnp.zeros((4, 1))
    played = actor_critic.Experience(
        inputs=zero,
        action=zero,
        log_density=zero,
        value=jnp.asarray(value)[:, None],
        reward=jnp.asarray(reward)[:, None],
        valid=jnp.asarray(valid)[:, None],
    )
    third = -4.0 - 2.0
    second = -2.0 + 0.5 * 2.0 + 1.0 + 0.4 * third
    first = -1.0 + 0.5 * -1.0 - 0.5 + 0.4 * second
    found = actor_critic.advantages(settings, played)[:, 0]
    np.testing.assert_allclose(found, [first, second, third, 0.0], rtol=1e-6)


def test_the_objective_ignores_gains_beyond_the_clip(parameters, played):
    one = jnp.ones_like(played.value)
    here = actor_critic.objective(TINY, parameters, played, one, played.value)
    assert here == pytest.approx(-1.0, abs=1e-2)
    likelier = played._replace(log_density=played.log_density - 1.0)
    there = actor_critic.objective(TINY, parameters, likelier, one, played.value)
    assert there == pytest.approx(-(1 + TINY.clip), abs=1e-2)


@pytest.mark.slow
def test_it_learns(trained):
    before = validation_error(
        partial(Policy, Network(actor_critic.weights(ppo.start(TINY, 0).parameters)))
    )
    assert trained.curve[-1].rmse_mm < 0.95 * before
    with np.load(trained.policy / "weights.npz") as stored:
        last = validation_error(partial(Policy, Network(stored)))
    assert last == trained.curve[-1].rmse_mm


def test_an_interrupted_training_resumes_to_the_same_weights(trained, tmp_path):
    def stop(point):
        raise KeyboardInterrupt

    parts = open_course(tmp_path, "ppo", TINY, 0, stop)
    with pytest.raises(KeyboardInterrupt):
        ppo.train_ppo(TINY, parts)
    parts = open_course(tmp_path, "ppo", TINY, 0)
    done = []
    ppo.train_ppo(TINY, parts, progress=done.append)
    assert done == [1] * TINY.updates
    one, other = ((course.policy / "weights.npz").read_bytes() for course in (trained, parts))
    assert one == other
