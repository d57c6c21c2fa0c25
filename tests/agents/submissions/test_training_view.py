"""A network in the training view: it sees and does what it saw and did in ``training_env``."""

import numpy as np
import pytest

pytest.importorskip("onnx", reason="needs onnx: uv sync --all-extras")
pytest.importorskip("onnxruntime", reason="needs onnxruntime: uv sync --all-extras")

from colift.agents.onnx.policy import OnnxPolicy
from colift.agents.sandbox.host.policy import close_sandboxes
from colift.agents.submissions.submission import open_submission, read_submission
from colift.agents.submissions.training_view import VIEWS, TrainingView
from colift.base.errors import InputError
from colift.benchmark.environment import RobotEnv, training_env

from ..onnx.networks import FLOAT, model, proportional, value, weights, write_network

UNIT = 8


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    yield
    close_sandboxes()


def trained(size, gain=8.0):
    """Return a network with a memory, some of whose actions are beyond -1 and 1."""
    rng = np.random.default_rng(size)
    return model(
        [
            ("MatMul", "obs w", "a"),
            ("MatMul", "h u", "b"),
            ("Add", "a b", "sum"),
            ("Tanh", "sum", "hn"),
            ("MatMul", "hn v", "act"),
        ],
        [value("obs", ["batch", size], FLOAT), value("h", ["batch", UNIT], FLOAT)],
        [value("act", ["batch", 1], FLOAT), value("hn", ["batch", UNIT], FLOAT)],
        [
            weights("w", rng.normal(0, 1 / size, (size, UNIT)), np.float32),
            weights("u", rng.normal(0, 0.3, (UNIT, UNIT)), np.float32),
            weights("v", gain * rng.normal(0, 1, (UNIT, 1)), np.float32),
        ],
    )


def lifted(env, act):
    """Return the rewards of a lift, with the wrapped environment's own."""
    observation, _ = env.reset(seed=3)
    rewards, ended = [], False
    while not ended:
        observation, reward, terminated, truncated, _ = env.step(act(observation))
        rewards.append(reward)
        ended = terminated or truncated
    env.close()
    return rewards


@pytest.mark.parametrize(("view", "pace"), VIEWS.items())
@pytest.mark.parametrize("steps", [20, 1])
def test_it_lifts_as_it_did_in_training_bit_for_bit(tmp_path, view, pace, steps):
    folder = write_network(tmp_path / "net", trained(7 + steps), view=f'"{view}"')
    alone = OnnxPolicy(str(folder / "policy.onnx"))
    alone.reset(0)
    actions = []

    def learner(observation):
        actions.append(alone.act(observation))
        return np.array([actions[-1]], np.float32)

    wanted = lifted(training_env("pause", "S2", steps=steps, pace=pace), learner)
    assert max(actions) > 1 or min(actions) < -1
    with open_submission(folder).trusted().agent() as policy:
        policy.reset(0)
        plain = RobotEnv(behaviour="pause", subject="S2", reward="score")
        assert lifted(plain, policy.act) == wanted


def test_it_acts_in_every_sandbox_as_without_one(tmp_path, each_level):
    folder = write_network(tmp_path / "net", trained(27), view='"training"')
    observations = np.random.default_rng(2).normal(0.0, 0.1, (20, 5))

    def played(policy):
        with policy.agent() as agent:
            agent.reset(0)
            return [float(np.squeeze(agent.act(seen))) for seen in observations]

    submission = open_submission(folder)
    assert played(submission.sandboxed(each_level)) == played(submission.trusted())


def test_a_new_lift_begins_without_a_past(tmp_path):
    view = TrainingView(10)
    observations = np.random.default_rng(2).normal(0.0, 0.1, (5, 5))
    lifts = []
    for _ in range(2):
        view.reset()
        lifts.append([(view.seen(each).tobytes(), view.change(0.5)) for each in observations])
    assert lifts[0] == lifts[1]


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"view": '"trainin"'}, 'view must be "training" or "training-without-pace", or empty'),
        ({"view": "3"}, "view must be .*; got a number"),
    ],
)
def test_a_view_that_is_none_is_refused(tmp_path, keys, told):
    folder = write_network(tmp_path / "net", trained(27), **keys)
    with pytest.raises(InputError, match=told):
        read_submission(folder)


def test_a_view_is_for_networks(tmp_path):
    folder = write_network(tmp_path / "net", trained(27), view='"training"')
    manifest = folder / "policy.toml"
    manifest.write_text(manifest.read_text().replace("model", "entry_point"))
    with pytest.raises(InputError, match="view is for a network, which model names"):
        read_submission(folder)


def test_a_network_that_does_not_fit_its_view_is_refused(tmp_path):
    folder = write_network(tmp_path / "net", proportional(), view='"training"')
    told = r"policy.onnx does not fit view = 'training': .* at least 8; got 5"
    with pytest.raises(InputError, match=told):
        open_submission(folder).sandboxed().check()


def test_without_its_view_it_is_told_of_it(tmp_path):
    folder = write_network(tmp_path / "net", trained(27))
    policy = OnnxPolicy(str(folder / "policy.onnx"))
    with pytest.raises(InputError, match=r"in training_env, policy\.toml needs view = 'training'"):
        policy.act(np.zeros(5))


def test_the_view_is_part_of_the_digest(tmp_path):
    folder = write_network(tmp_path / "net", trained(27))
    before = read_submission(folder).sandboxed().digest()
    with (folder / "policy.toml").open("a") as file:
        file.write('view = "training"\n')
    assert read_submission(folder).sandboxed().digest() != before
