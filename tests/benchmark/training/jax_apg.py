"""A small training: reproducible, resumable, and a submission at its end."""

from dataclasses import replace

import colift
import jax
import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.control.portable import PORTABLE
from colift.agents.control.recurrent import GatedNetwork, act, memory_at_rest
from colift.agents.senses import MOCAP_NOISE
from colift.base.errors import InputError
from colift.benchmark.training import apg, apg_course, level_lesson
from colift.benchmark.training.apg_settings import NAME, ApgSettings
from colift.benchmark.training.course import open_course
from colift.benchmark.training.lesson import BatchDraw
from colift.benchmark.training.pool import draw_batch, draw_pool
from colift.benchmark.training.sensing import OWN, SEEN
from colift.benchmark.training.validation import VALIDATION_SEEDS
from colift.benchmark.twin.policy import recurrent

TINY = ApgSettings(updates=4, lifts=10, batch=4, units=3, wide=0.4)


@pytest.fixture(scope="module")
def pool():
    return draw_pool(TINY.lifts, TINY.wide)


@pytest.fixture(scope="module")
def whole(pool):
    return list(apg.updates(TINY, 0, pool=pool))


@pytest.fixture(autouse=True)
def _short(monkeypatch, pool):
    """Draw the lifts once; two points on the curve, of few lifts."""
    monkeypatch.setattr(level_lesson, "draw_pool", lambda lifts, wide, unsettled: pool)
    monkeypatch.setattr(apg_course, "EVERY", 2)
    monkeypatch.setattr(level_lesson, "VALIDATION_SEEDS", VALIDATION_SEEDS[:2])


def same(one, other):
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_the_pool_has_as_many_wide_lifts_as_asked_for(pool):
    assert pool.lifts.size == 10
    assert pool.common == 6
    ages = np.asarray(pool.lifts.ages)
    assert (ages[:, : pool.common] == 10).all()
    assert (ages[:, pool.common :] != 10).any()


def test_every_update_changes_the_weights(whole):
    networks = [update.learner.network for update in whole]
    assert [update.learner.update for update in whole] == [1, 2, 3, 4]
    assert not same(networks[0], networks[1])


def test_the_same_seed_gives_the_same_weights_and_another_others(whole, pool):
    again = next(apg.updates(TINY, 0, pool=pool))
    assert same(again.learner.network, whole[0].learner.network)
    other = next(apg.updates(TINY, 1, pool=pool))
    assert not same(other.learner.network, whole[0].learner.network)


def test_a_batch_has_arms_as_varied_as_asked_for_and_noise_of_its_own(pool):
    def batch(varied, seed=0):
        draw = BatchDraw(8, jax.random.key(seed), varied)
        return draw_batch(pool, replace(TINY, wide=0.0), draw)

    first, half, last = (batch(varied) for varied in (0.0, 0.1, 0.2))
    for part in range(2):
        assert np.allclose(first.lifts.arms[part], 1.0)
        assert np.allclose(half.lifts.arms[part] ** 2, last.lifts.arms[part], rtol=1e-6)
        assert float(np.log(last.lifts.arms[part]).std()) > 0.1
    assert np.array_equal(first.lifts.errors, last.lifts.errors)
    seen = [each.lifts.errors[:, SEEN] for each in (last, batch(0.2, seed=1))]
    of_lifts = [set(map(bytes, np.asarray(each).T.copy())) for each in seen]
    assert of_lifts[0].isdisjoint(of_lifts[1])
    assert float(seen[1].std()) == pytest.approx(MOCAP_NOISE, rel=0.05)
    assert float(last.lifts.errors[:, OWN].std()) == pytest.approx(TINY.encoders, rel=0.05)


class Telling(level_lesson.LevelLesson):
    """Tells how the arms vary, as its RMSE."""

    def loss(self, network, pool, settings, draw):
        return sum(array.sum() for array in network), draw.varied


def test_the_arms_vary_more_in_every_update(pool):
    found = [update.rmse_mm for update in apg.updates(TINY, 0, pool=pool, lesson=Telling())]
    assert found == pytest.approx([TINY.varied_in(update) for update in range(TINY.updates)])


def test_the_network_acts_the_same_in_numpy(whole):
    network = whole[-1].learner.network
    rng = np.random.default_rng(0)
    plain = GatedNetwork(*(np.asarray(array, np.float64) for array in network))
    policy, many = recurrent(network, 1)
    memory = memory_at_rest(plain)
    for _ in range(5):
        view = 0.1 + 0.01 * rng.standard_normal(len(RobotObservation))
        memory, action = act(plain, memory, view, PORTABLE)
        many, actions = policy(many, view[:, np.newaxis].astype(np.float32))
        assert float(actions[0]) == pytest.approx(action, abs=1e-6)


def test_an_interrupted_training_ends_with_the_same_policy(tmp_path, whole):
    first = open_course(tmp_path, NAME, TINY, 0)

    def killed(many):
        if (first.checkpoint).exists():
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        apg_course.train_apg(TINY, first, killed)
    second = open_course(tmp_path, NAME, TINY, 0)
    apg_course.train_apg(TINY, second)
    with np.load(second.policy / "weights.npz") as stored:
        for name, array in whole[-1].learner.network._asdict().items():
            assert np.array_equal(stored[name], np.asarray(array)), name
    assert len(second.curve) == 2
    assert colift.evaluate(second.policy, isolation="none").rmse_mm < 30


def test_a_training_that_diverges_stops_with_a_message(tmp_path, monkeypatch, whole):
    broken = whole[0]._replace(rmse_mm=float("nan"))
    monkeypatch.setattr(apg_course, "updates", lambda *arguments: iter([broken]))
    course = open_course(tmp_path, NAME, TINY, 0)
    with pytest.raises(InputError, match="RMSE of update 1 has numbers that are not finite"):
        apg_course.train_apg(TINY, course)
    assert not course.policy.exists()
