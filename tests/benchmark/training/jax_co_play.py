"""Co-play on the twin; run by test_ppo.py in a process of its own."""

import colift
import numpy as np
import pytest
from colift.benchmark.training import validation
from colift.benchmark.training.course import open_course
from colift.benchmark.training.ppo_settings import CoPlaySettings
from colift.benchmark.twin.libraries import require_jax

require_jax()

import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
from colift.benchmark.training import co_play, person_seat, self_play  # noqa: E402
from colift.benchmark.training.actor_critic import decide, output  # noqa: E402

TINY = CoPlaySettings(
    population=2,
    updates=8,
    pool=48,
    lifts=48,
    steps=3,
    hidden=8,
    epochs=4,
    batches=8,
    rate=5e-3,
)


@pytest.fixture(scope="module", autouse=True)
def one_lift_to_validate():
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:1])
        yield


@pytest.fixture(scope="module")
def pairs():
    """Return the pairs of two seeds, which have learned nothing."""
    return [self_play.new_pair(TINY, seed) for seed in range(2)]


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    course = open_course(tmp_path_factory.mktemp("trained"), "co-play", TINY, 0)
    co_play.train_co_play(TINY, course)
    return course


def test_each_person_of_a_population_acts_by_its_own_parameters(pairs):
    population = co_play.first_stage(TINY, 0).population
    for place, pair in enumerate(pairs):
        population = co_play.with_person(population, place, pair)
    chosen = jax.tree.map(lambda leaf: leaf[jnp.array([1, 0, 1])], population)
    inputs = jax.random.normal(jax.random.key(3), (3, len(person_seat.SCALES)))
    found = jax.vmap(decide)(chosen, inputs, jnp.zeros(3)).action
    for index, place in enumerate((1, 0, 1)):
        own = output(pairs[place].person.parameters["policy"], inputs[index])
        assert float(found[index]) == pytest.approx(float(own), abs=1e-6)


def test_the_population_has_the_beginning_the_half_and_the_end_of_each_training(trained):
    stage = co_play.first_stage(TINY, 0)
    leaves, structure = jax.tree.flatten(stage)
    state = trained.load()
    stage = jax.tree.unflatten(structure, [state[f"leaf{i}"] for i in range(len(leaves))])
    people = stage.population["policy"]["w1"]
    assert people.shape == (6, 8, 8)
    assert len(np.unique(people.reshape(6, -1), axis=0)) == 6
    second = self_play.new_pair(TINY, 1).person.parameters["policy"]["w1"]
    np.testing.assert_array_equal(people[3], second)


def test_the_result_is_a_submission(trained):
    assert colift.evaluate(trained.policy, isolation="none").rmse_mm < 40


def test_an_interrupted_training_resumes_to_the_same_weights(trained, tmp_path):
    points = []

    def stop(point):
        points.append(point)
        if len(points) == 19:
            raise KeyboardInterrupt

    parts = open_course(tmp_path, "co-play", TINY, 0, stop)
    with pytest.raises(KeyboardInterrupt):
        co_play.train_co_play(TINY, parts)
    parts = open_course(tmp_path, "co-play", TINY, 0)
    done = []
    co_play.train_co_play(TINY, parts, progress=done.append)
    assert done == [19] + [1] * 5
    one, other = ((course.policy / "weights.npz").read_bytes() for course in (trained, parts))
    assert one == other
