"""The training view on the twin: the numbers of the engine's, corrections, and submissions."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from colift import twin
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.environment.drawing import make_drawing
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.robots.robot import DEFAULT_ROBOT
from colift.benchmark.suites.suite import Suite

STEPS = 4


def network(inputs, seed=0):
    rng = np.random.default_rng(seed)
    return {
        "w0": rng.normal(0, 0.2, (3, inputs)),
        "b0": rng.normal(0, 0.1, 3),
        "w1": rng.normal(0, 0.2, (1, 3)),
        "b1": np.zeros(1),
    }


def acting(weights, inputs):
    hidden = jnp.tanh(weights["w0"] @ inputs + weights["b0"])
    return jnp.tanh(weights["w1"] @ hidden + weights["b1"])


@pytest.mark.parametrize("task", ["level", "ball"])
def test_a_submission_does_in_the_engine_what_the_network_did_on_the_twin(task, tmp_path):
    view = twin.TrainingView(twin.make(task, lifts=3), STEPS)
    (size,) = view.observation_space("robot").shape
    weights = network(size)
    folder = view.write(tmp_path / "made", weights, name="made", trained_on="nothing")

    def one(key):
        def step(now, key):
            seen, state, score = now
            actions = {"robot": acting(weights, seen["robot"])}
            seen, state, _, _, infos = view.step(key, state, actions)
            ended = jnp.where(score > 0, score, infos["score_mm"][0])
            return (seen, state, ended), None

        seen, state = view.reset(key)
        lane = state.inner.lane
        keys = jax.random.split(key, view.max_steps)
        (_, _, score), _ = jax.lax.scan(step, (seen, state, 0.0), keys)
        return lane, score

    lanes, scores = jax.jit(jax.vmap(one))(jax.random.split(jax.random.key(1), 8))
    drawing = make_drawing("any", "draw", DEFAULT_ROBOT, 0.1, 0.1, task)
    for lane, score in dict(zip(lanes.tolist(), scores.tolist(), strict=True)).items():
        scenario, seed = drawing.lift(derive_seed(0, f"lift {lane}"))
        suite = Suite(name="one", scenarios=(scenario,), seeds=(seed,))
        run = run_suite(PolicySpec(text=f"{folder / 'policy.py'}:Policy"), suite)
        (episode,) = run.episodes
        assert score == pytest.approx(episode.scores["rmse_mm"], rel=0.02)


def test_a_lift_that_begins_anew_has_no_past():
    view = twin.TrainingView(twin.make("level", lifts=2), STEPS)
    seen, state = view.reset(jax.random.key(0))
    step = jax.jit(view.step)
    for number in range(view.max_steps):
        actions = {"robot": jnp.zeros(1)}
        seen, state, _, dones, _ = step(jax.random.key(number), state, actions)
        if dones["__all__"]:
            break
    inputs = np.asarray(seen["robot"])
    assert (inputs[4:] == 0).all()
    assert (np.asarray(state.past.seen) == inputs[0] * 0.1).all()


def test_a_folder_with_something_in_it_stays_as_it_is(tmp_path):
    view = twin.TrainingView(twin.make("level", lifts=1), STEPS)
    (tmp_path / "note").write_text("mine")
    weights = network(*view.observation_space("robot").shape)
    with pytest.raises(InputError, match="is not empty; name a new folder"):
        view.write(tmp_path, weights, name="a", trained_on="b")
    assert [each.name for each in tmp_path.iterdir()] == ["note"]
    with pytest.raises(InputError, match="trained weights cannot be used: weights must be w0, b0"):
        view.write(tmp_path / "new", {"w0": weights["w0"]}, name="a", trained_on="b")
    assert [each.name for each in tmp_path.iterdir()] == ["note"]


def test_a_folder_may_be_a_text_and_is_checked_before(tmp_path):
    view = twin.TrainingView(twin.make("level", lifts=1), STEPS)
    weights = network(*view.observation_space("robot").shape)
    folder = str(tmp_path / "a" / "made")
    view.check_folder(folder)
    assert view.write(folder, weights, name="a", trained_on="b") == tmp_path / "a" / "made"
    for place, told in (
        (folder, "made is not empty; name a new folder"),
        (f"{folder}/policy.py", "policy.py is there already; name a new folder"),
        ("/dev/null/made", "cannot write to /dev/null: File exists"),
        (".", "cannot be replaced; name a new folder"),
    ):
        with pytest.raises(InputError, match=told):
            view.check_folder(place)
