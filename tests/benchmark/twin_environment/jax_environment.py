"""The twin as an environment: the score as reward, batches, ends, gradients, conventions."""

from contextlib import closing

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift import twin as public
from colift.base.errors import InputError
from colift.benchmark.environment.state import true_state
from colift.benchmark.episode.lift import Lift
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin
from colift.benchmark.twin_environment.environment import HUMAN, ROBOT, TwinEnv
from colift.benchmark.twin_environment.pool import LiftPool

SUITES = ("standard-v1", "robust-v1", "agree-v1", "ball-v1", "intent-v1")
COUNT = 6


@pytest.fixture(autouse=True)
def _forgotten():
    """Free what was compiled for the environments of a test."""
    yield
    jax.clear_caches()


def following(seen):
    """Return the action of a robot that follows its person's end, from observations (k, ...)."""
    return 0.8 * (seen[0] - seen[3])


def environment(suite, count=COUNT, **settings):
    """Return lifts of a suite, one with each of some people, and their environment."""
    every = make_suite(suite).scenarios
    scenarios = every[:: max(len(every) // count, 1)][:count]
    lifts = draw_lifts([(each, 0) for each in scenarios])
    return lifts, TwinEnv(TaskTwin.of(scenarios), LiftPool(lifts), **settings)


def single(tree):
    return jax.tree.map(lambda each: jnp.moveaxis(each, -1, 0), tree)


def played(env, count):
    """Return sums of rewards, scores, and numbers of steps of each lift of the pool, played once.

    The rewards are summed in double precision.
    """
    state = env.begun(jnp.arange(count))
    lifts, share = env.pool.lifts(state.lane), env.share(state)
    seen, state = (single(each) for each in (env.views(state, lifts, share), state))
    step = jax.jit(jax.vmap(env.step))
    total, score, steps = np.zeros(count), np.zeros(count), np.zeros(count, int)
    begun = np.ones(count, bool)
    for number in range(env.max_steps):
        actions = {ROBOT: following(seen[ROBOT].T)[:, jnp.newaxis]}
        if env.learns:
            actions[HUMAN] = jnp.zeros((count, 2))
        keys = jax.random.split(jax.random.key(number), count)
        seen, state, rewards, dones, infos = step(keys, state, actions)
        done = np.asarray(dones["__all__"])
        total += np.where(begun, rewards[ROBOT], 0.0)
        score = np.where(begun & done, infos["score_mm"][:, 0], score)
        steps += begun
        begun &= ~done
    assert not begun.any()
    return total, score, steps


@pytest.mark.parametrize("suite", SUITES)
def test_the_sum_of_the_rewards_is_the_score_and_the_score_that_of_the_whole_lift(suite):
    lifts, env = environment(suite)
    whole = rollout(env.twin, lambda memory, seen: (memory, following(seen)), None, lifts).rmse_mm
    total, score, steps = played(env, COUNT)
    assert score == pytest.approx(np.asarray(whole), rel=1e-5)
    planned = np.asarray(lifts.steps)
    assert 10 * np.sqrt(-total / planned) == pytest.approx(score, rel=1e-5)
    assert (steps <= planned).all()
    assert (steps == planned).any()


def test_a_person_who_adds_nothing_is_the_person_of_the_task():
    _, alone = environment("intent-v1")
    _, both = environment("intent-v1", learns=True)
    assert both.agents == ["robot", "human"]
    assert played(both, COUNT)[1] == pytest.approx(played(alone, COUNT)[1], rel=1e-5)


def test_many_lifts_are_what_each_is_alone():
    _, env = environment("standard-v1")
    _, plain = environment("standard-v1", single=True)
    keys = jax.random.split(jax.random.key(3), COUNT)
    _, state = jax.vmap(env.reset)(keys)
    actions = {"robot": jnp.linspace(-0.02, 0.02, COUNT)[:, jnp.newaxis]}
    many = jax.vmap(env.step)(keys, state, actions)
    one = jax.tree.map(lambda each: each[2], (keys, state, actions))
    for env_of_one in (env, plain):
        found = env_of_one.step(*one)
        for mine, theirs in zip(jax.tree.leaves(found), jax.tree.leaves(many), strict=True):
            assert np.asarray(mine) == pytest.approx(np.asarray(theirs[2]), abs=1e-6)


def test_a_lift_that_has_ended_begins_anew_in_the_same_step():
    _, env = environment("standard-v1", count=2)
    key = jax.random.key(0)
    _, state = env.reset(key)
    step = jax.jit(env.step)
    for number in range(env.max_steps):
        seen, state, _, dones, infos = step(
            jax.random.fold_in(key, number), state, {"robot": jnp.zeros(1)}
        )
        if dones["__all__"]:
            break
    assert dones["robot"]
    assert infos["score_mm"][0] > 20
    assert seen["robot"][4] == 0
    assert int(state.lift.step) == 0
    assert float(jnp.abs(state.lift.plant.heights).max()) == 0


def test_a_ball_that_falls_ends_the_lift_and_what_is_left_counts():
    lifts, env = environment("ball-v1", count=2)
    advance = jax.jit(env.advance)
    state, number = env.begun(jnp.arange(2)), 0
    while not (played := advance(state, jnp.zeros(2), jnp.zeros((2, 2)))).terminated[0]:
        state, number = played.state, number + 1
    assert not played.truncated[0]
    left = int(lifts.steps[0]) - number - 1
    assert left > 20
    assert played.score_mm[0] > 250 * np.sqrt(left / int(lifts.steps[0]))
    assert played.reward[0] < -600 * left


def test_gradients_of_a_batch_and_of_single_steps_are_slopes():
    _, env = environment("standard-v1", single=True)

    def total(gain, run=env):
        keys = jax.random.split(jax.random.key(1), COUNT)
        seen, state = jax.vmap(run.reset)(keys)

        def step(held, key):
            seen, state = held
            actions = {"robot": gain * following(seen["robot"].T)[:, jnp.newaxis]}
            seen, state, rewards, *_ = jax.vmap(run.step)(
                jax.random.split(key, COUNT), state, actions
            )
            return (seen, state), rewards["robot"].mean()

        return jax.lax.scan(step, (seen, state), jax.random.split(jax.random.key(2), 20))[1].sum()

    slope = float(jax.jit(jax.grad(total))(1.0))
    assert slope == pytest.approx(float((total(1.02) - total(0.98)) / 0.04), rel=0.02)
    _, quick = environment("standard-v1")
    assert float(jax.jit(jax.grad(lambda gain: total(gain, quick)))(1.0)) == pytest.approx(slope)

    key = jax.random.key(0)
    _, state = env.reset(key)
    for _ in range(30):
        _, state, *_ = env.step(key, state, {"robot": jnp.zeros(1)})
    reward = jax.grad(lambda action: env.step(key, state, {"robot": action})[2]["robot"].sum())
    assert float(reward(jnp.zeros(1))[0]) > 0


@pytest.mark.parametrize("suite", SUITES)
def test_a_step_is_compiled_once(suite):
    _, env = environment(suite, count=2)
    state = env.begun(jnp.arange(2))
    after = jax.eval_shape(env.advance, state, jnp.zeros(2), jnp.zeros((2, 2))).state
    for one, other in zip(jax.tree.leaves(state), jax.tree.leaves(after), strict=True):
        assert (one.shape, one.dtype, one.weak_type) == (other.shape, other.dtype, other.weak_type)


def test_the_public_environment_has_the_conventions_of_others():
    env = public.make("agree", agents="both", lifts=8)
    key = jax.random.key(0)
    seen, state = env.reset(key)
    assert {*seen} == {*env.agents} == {"robot", "human"}
    for agent in env.agents:
        space = env.observation_space(agent)
        assert seen[agent].shape == space.shape
        assert space.contains(seen[agent])
        assert env.action_space(agent).contains(env.action_space(agent).sample(key))
    actions = {agent: env.action_space(agent).sample(key) for agent in env.agents}
    _, _, rewards, dones, infos = env.step(key, state, actions)
    assert rewards["robot"] == rewards["human"]
    assert {*dones} == {"robot", "human", "__all__"}
    assert infos["score_mm"].shape == (env.num_agents,)


def test_the_robot_alone_is_as_in_gymnax():
    env = public.make(lifts=8)
    key = jax.random.key(0)
    for ends, values in ((1, 5), (2, 6)):
        robot = public.Single(env, ends=ends)
        seen, state = robot.reset(key, robot.default_params)
        found = robot.step(key, state, jnp.zeros(1), robot.default_params)
        assert len(found) == values
        assert seen.shape == robot.observation_space().shape == (5,)
        assert robot.action_space(None).shape == (1,)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"task": "nothing"}, "nothing"),
        ({"agents": "human"}, "agents must be 'robot' or 'both', got 'human'"),
        ({"lifts": 0}, "lifts must be at least 1, got 0"),
        ({"behaviour": "smooth", "subject": "S1"}, "behaviour 'any', subject 'draw', or both"),
    ],
)
def test_settings_out_of_range_are_refused(settings, message):
    with pytest.raises(InputError, match=message):
        public.make(**settings)


@pytest.mark.parametrize("suite", ["standard-v1", "intent-v1"])
def test_the_true_state_is_that_of_the_engine(suite):
    scenario = make_suite(suite).scenarios[0]
    env = TwinEnv(TaskTwin.of([scenario]), LiftPool(draw_lifts([(scenario, 0)])))
    seen, state = env.reset(jax.random.key(0))
    with closing(Lift(scenario)) as lift:
        lift.reset(0)
        human = lift.scripted_human()
        for _ in range(25):
            action = following(np.asarray(seen[ROBOT]))
            lift.step(human.act(lift.human_observation()), np.array([float(action)]))
            seen, state, *_ = env.step(jax.random.key(1), state, {ROBOT: jnp.array([action])})
        wanted = true_state(lift)
    found = np.asarray(env.true_state(state))
    size = np.array([1e-3] * 2 + [5e-3] * 2 + [1e-3] * 2 + [0.1] * 2 + [1e-6])
    assert (np.abs(found - wanted) < size).all(), (found, wanted)
