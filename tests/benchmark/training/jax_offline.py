"""Cloning and implicit Q-learning; run in a process of their own by test_offline_training.py."""

import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.submissions.offline.policy import INPUTS, Network
from colift.agents.submissions.submission import read_submission
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.training import cloning, iql, validation
from colift.benchmark.training.course import open_course
from colift.benchmark.training.offline_data import OfflineData
from colift.benchmark.training.offline_run import train_offline
from colift.benchmark.training.offline_settings import BLOCK, CloneSettings, IqlSettings
from colift.benchmark.training.perceptron import forward

SMALL = {"updates": 2 * BLOCK, "batch": 64, "rate": 5e-3, "hidden": (8,)}
TRAINERS = {"clone": (cloning, CloneSettings), "iql": (iql, IqlSettings)}


@pytest.fixture(autouse=True)
def two_lifts_to_validate(monkeypatch):
    monkeypatch.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])


def data(actions, rewards, inputs):
    """Return steps that have nothing to do with each other."""
    return OfflineData(
        name="made",
        digest="0" * 16,
        lifts=1,
        inputs=inputs.astype(np.float32),
        actions=actions.astype(np.float32)[:, np.newaxis],
        rewards=rewards.astype(np.float32),
        coming=inputs[::-1].astype(np.float32),
        ended=np.ones(len(inputs), np.float32),
        centre=np.full(INPUTS, 0.01),
        deviation=np.full(INPUTS, 0.02),
    )


@pytest.fixture(scope="module")
def linear():
    """Actions that follow from the inputs by a line, all equally good."""
    rng = np.random.default_rng(1)
    inputs = rng.normal(0.0, 1.0, (2000, INPUTS))
    return data(0.3 * inputs[:, 0] - 0.2 * inputs[:, 5], -np.ones(2000), inputs)


def trained(trainer, settings, steps, folder, seed=0, report=lambda point: None):
    module, _ = TRAINERS[trainer]
    course = open_course(folder, trainer, settings, seed, report)
    learning = module.learning(settings, steps, seed)
    train_offline(learning, steps, course, updates=settings.updates, batch=settings.batch)
    return course


def weights(course):
    with np.load(course.policy / "weights.npz") as stored:
        return {name: stored[name] for name in stored.files}


def same(one, other):
    return one.keys() == other.keys() and all((one[k] == other[k]).all() for k in one)


@pytest.fixture(scope="module")
def whole(linear, tmp_path_factory):
    """Return a finished course of each trainer."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(validation, "VALIDATION_SEEDS", validation.VALIDATION_SEEDS[:2])
        return {
            name: trained(name, kind(**SMALL), linear, tmp_path_factory.mktemp(name) / "out")
            for name, (_, kind) in TRAINERS.items()
        }


@pytest.mark.parametrize("trainer", TRAINERS)
def test_the_same_seed_gives_the_same_weights_interrupted_or_not(trainer, whole, linear, tmp_path):
    def stop(point):
        raise KeyboardInterrupt

    settings = TRAINERS[trainer][1](**SMALL)
    with pytest.raises(KeyboardInterrupt):
        trained(trainer, settings, linear, tmp_path, report=stop)
    assert not (tmp_path / "seed-0").exists()
    resumed = trained(trainer, settings, linear, tmp_path)
    assert same(weights(whole[trainer]), weights(resumed))
    assert [point.steps for point in resumed.curve] == [BLOCK * 64, 2 * BLOCK * 64]
    assert [p.rmse_mm for p in resumed.curve] == [p.rmse_mm for p in whole[trainer].curve]


def test_another_seed_gives_other_weights(whole, linear, tmp_path):
    other = trained("clone", CloneSettings(**SMALL), linear, tmp_path, seed=1)
    assert not same(weights(whole["clone"]), weights(other))


@pytest.mark.parametrize("trainer", TRAINERS)
def test_actions_of_equal_worth_are_cloned(trainer, whole, linear):
    network = Network(weights(whole[trainer]))
    found = [network(each * linear.deviation + linear.centre) / 0.04 for each in linear.inputs]
    miss = np.array(found) - linear.actions[:, 0]
    assert np.sqrt(np.mean(miss**2)) < 0.4 * linear.actions.std()


def test_better_actions_weigh_more_in_iql(tmp_path):
    """Half of the actions are 0.4, and good; the others are -0.4: a clone does 0."""
    rng = np.random.default_rng(2)
    inputs = rng.normal(0.0, 1.0, (2000, INPUTS))
    good = rng.random(2000) < 0.5
    steps = data(np.where(good, 0.4, -0.4), np.where(good, -0.01, -0.03), inputs)
    mean = {}
    for trainer, (_, kind) in TRAINERS.items():
        settings = kind(**SMALL)
        network = Network(weights(trained(trainer, settings, steps, tmp_path / trainer)))
        chosen = [network(each * steps.deviation + steps.centre) for each in steps.inputs[:100]]
        mean[trainer] = np.mean(chosen) / 0.04
    assert abs(mean["clone"]) < 0.15
    assert mean["iql"] > 0.3


def test_the_policy_in_numpy_is_the_one_that_was_trained(whole, linear):
    found = weights(whole["clone"])
    layers = [(jnp.asarray(found[f"w{i}"]), jnp.asarray(found[f"b{i}"])) for i in range(2)]
    wanted = jnp.tanh(forward(layers, jnp.asarray(linear.inputs[:20])))[:, 0]
    network = Network(found)
    for inputs, action in zip(linear.inputs[:20], wanted.tolist(), strict=True):
        here = network(inputs * linear.deviation + linear.centre)
        assert here / 0.04 == pytest.approx(action, abs=1e-5)


def test_the_result_is_a_submission_that_lifts(whole):
    submission = read_submission(whole["iql"].policy)
    assert submission.manifest.name == "iql seed 0"
    assert "SHA-256 0000000000000000" in submission.manifest.trained_on
    lift = Lift(make_scenario("smooth"))
    assert run_episode(lift, submission.trusted().make(), 190_000).failure is None
    lift.close()


def test_a_training_that_diverges_is_named(linear, tmp_path):
    settings = CloneSettings(**{**SMALL, "rate": 1e38})
    with pytest.raises(InputError, match=r"must be finite|not finite"):
        trained("clone", settings, linear, tmp_path)
    assert not (tmp_path / "seed-0").exists()


def test_a_folder_of_other_data_is_refused(whole):
    settings = CloneSettings(**SMALL, data="b" * 16)
    with pytest.raises(InputError, match=r"of another training: data is , not b{16}"):
        open_course(whole["clone"].folder, "clone", settings, 0)


@pytest.mark.parametrize(
    ("kind", "change", "told"),
    [
        (CloneSettings, {"updates": 700}, "updates must be a multiple of 500, got 700"),
        (IqlSettings, {"updates": 0}, "updates must be a multiple of 500, got 0"),
        (IqlSettings, {"gamma": 1.0}, "gamma must be in"),
        (IqlSettings, {"expectile": 0.4}, "expectile must be in"),
        (IqlSettings, {"beta": -1.0}, "beta must be in"),
    ],
)
def test_settings_out_of_range_are_refused_by_name(kind, change, told):
    with pytest.raises(InputError) as refused:
        kind(**change)
    assert told in str(refused.value)
