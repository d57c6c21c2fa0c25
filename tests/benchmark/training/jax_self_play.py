"""Self-play on the twin; run by test_ppo.py in a process of its own."""

from functools import partial

import numpy as np
import pytest
from colift.benchmark.training import validation
from colift.benchmark.training.course import open_course
from colift.benchmark.training.ppo_settings import SelfPlaySettings
from colift.benchmark.twin.libraries import require_jax

require_jax()

import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
from colift.benchmark.training import person_seat, self_play  # noqa: E402
from colift.benchmark.training.actor_critic import decide  # noqa: E402

TINY = SelfPlaySettings(
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
def arms():
    return self_play.drawn_people(TINY, 0)


@pytest.fixture(scope="module")
def play(arms):
    """Return what plays the same lifts with a pair, without noise, and the lifts."""
    lifts = person_seat.draw_goals(arms, jax.random.key(1))

    @jax.jit
    def played(pair):
        quiet = [{**each.parameters, "log_noise": jnp.asarray(-20.0)} for each in pair]
        agents = (partial(decide, parameters) for parameters in quiet)
        return self_play.collect(TINY, *agents, lifts, jax.random.key(2))

    return played, lifts


@pytest.fixture(scope="module")
def pairs(arms):
    """Return a pair that has learned nothing, and the same after so many updates."""
    pair = new = self_play.new_pair(TINY, 0)
    for number in range(TINY.updates):
        pair = self_play.compiled_update(TINY)(pair, arms, jax.random.key(number))
    return new, pair


def test_goals_begin_at_rest_and_are_heights_of_the_lift(play):
    goal = np.asarray(play[1].goal)
    changes = (np.diff(goal, axis=0) != 0).mean()
    assert (goal[0] == 0).mean() > 0.8
    assert goal.min() >= 0
    assert goal.max() > 0.2
    assert changes == pytest.approx(person_seat.CHANGES, abs=0.01)


def test_a_person_who_has_learned_nothing_goes_to_the_goal_at_an_even_pace(arms):
    past = person_seat.nothing_sensed(48)
    goal, action = jnp.full(48, 0.1), jnp.zeros(48)
    hands = []
    for _ in range(6):
        past, references = person_seat.moved(past, goal, action)
        hands.append(float(past.hand[0]))
        assert references.shape == (10, 48)
        assert float(references[-1, 0]) == hands[-1]
    assert hands == pytest.approx([0.02, 0.04, 0.06, 0.08, 0.1, 0.1])


def test_the_reward_of_the_person_is_that_of_the_robot_less_the_distance(play, pairs):
    mine, theirs = play[0](pairs[0])
    assert np.isfinite(np.asarray(mine.reward)).all()
    distance = (mine.reward - theirs.reward) / TINY.haste
    # While the goal is the rest height, the table hardly moves.
    resting = np.asarray(play[1].goal).cumsum(axis=0) == 0
    assert np.asarray(distance)[resting].max() < 1.0
    assert distance.max() > 5.0


def test_a_pair_learns_for_both_seats(play, pairs):
    before, after = (np.array([each.reward.mean() for each in play[0](pair)]) for pair in pairs)
    assert (after > before).all()
    changed = jax.tree.map(lambda one, other: bool((one != other).any()), *pairs)
    assert changed.robot.parameters["policy"]["w1"]
    assert changed.person.parameters["policy"]["w1"]


def test_self_play_writes_the_robot_of_the_pair(tmp_path):
    course = open_course(tmp_path, "self-play", TINY, 0)
    self_play.train_self_play(TINY, course)
    assert course.curve[-1].steps == TINY.updates * TINY.lifts * person_seat.STEPS
    assert "no data of people" in (course.policy / "policy.toml").read_text()
    assert course.curve[-1].rmse_mm < 40
