"""The learned law of control by touch: what it does without a network, and its file."""

import numpy as np
import pytest
from colift.agents.control.recurrent import GatedNetwork
from colift.agents.tasks.ball.observation import BALL_SENSES
from colift.agents.tasks.touch.observation import HapticObservation as Seen
from colift.agents.tasks.touch.touch_controller import TouchController, read_touch, touch_network
from colift.agents.tasks.touch.touch_law import AHEAD, REACH, TouchNetwork, inputs_of
from colift.agents.tasks.touch.touched import TABLE_LENGTH
from colift.base.errors import InputError
from colift.benchmark.suites.catalogue import make_task
from colift.testing import check_policy


def weights(task="intent", units=2, bias=0.0):
    senses = make_task(task).senses
    entering = inputs_of(senses)
    return {
        "task": np.array(task),
        "scales": np.array([(each.scale, each.rate) for each in senses]).reshape(-1, 2),
        "inputs": np.zeros((3 * units, entering)),
        "memory": np.zeros((3 * units, units)),
        "bias": np.zeros(3 * units),
        "output": np.zeros((1, units + entering)),
        "output_bias": np.array([bias]),
    }


def test_without_correction_the_hand_goes_where_the_table_will_be_level():
    policy = TouchController(touch_network(weights(), "made up"))
    policy.reset(0)
    seen = np.zeros(len(Seen))
    seen[Seen.HAND_HEIGHT], seen[Seen.HAND_COMMAND] = 0.1, 0.1
    assert policy.act(seen) == pytest.approx([0.0])
    pitch = -0.05
    seen[Seen.TORQUE] = -pitch
    near = 0.1 - TABLE_LENGTH * pitch * (1 - pitch**2 / 6)
    assert policy.act(seen) == pytest.approx([near + AHEAD * (near - 0.1) - 0.1])


def test_an_output_is_a_departure_from_level():
    policy = TouchController(touch_network(weights(bias=0.5), "made up"))
    policy.reset(0)
    assert policy.act(np.zeros(len(Seen))) == pytest.approx([0.5 * REACH])


@pytest.mark.parametrize("task", ["intent", "agree", "ball"])
def test_the_file_names_the_task(tmp_path, task):
    np.savez(tmp_path / "weights.npz", **weights(task))
    learned = read_touch(tmp_path / "weights.npz")
    assert isinstance(learned, TouchNetwork)
    assert learned.task == task
    assert isinstance(learned.network, GatedNetwork)
    check_policy(lambda: TouchController(learned), make_task(task))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"scales": np.zeros(3)}, r"scales must have the shape \(k, 2\), got \(3,\)"),
        ({"scales": np.full((1, 2), np.nan)}, "scales has numbers that are not finite"),
        ({"memory": np.zeros((6, 0))}, "1 to 4096 units"),
        ({"bias": np.zeros(5)}, r"bias must have the shape \(6,\), got \(5,\)"),
        ({"output_bias": np.array([np.nan])}, "output_bias has numbers that are not finite"),
        ({"inputs": np.array("text")}, "not the weights of a recurrent policy"),
    ],
)
def test_weights_that_cannot_be_used_are_refused(change, message):
    with pytest.raises(InputError, match=message):
        touch_network({**weights(), **change}, "made up")


def test_a_file_that_is_none_is_refused(tmp_path):
    (tmp_path / "weights.npz").write_bytes(b"nothing")
    with pytest.raises(InputError, match=r"weights.npz: not an .npz file"):
        read_touch(tmp_path / "weights.npz")


def test_the_observation_of_another_task_is_refused():
    policy = TouchController(touch_network(weights("ball"), "made up"))
    policy.reset(0)
    with pytest.raises(InputError, match="task 'ball', whose observation has 10 numbers"):
        policy.act(np.zeros(len(Seen)))


@pytest.mark.parametrize("name", ["task", "scales"])
def test_weights_that_do_not_state_their_task_and_its_senses_are_refused(name):
    arrays = weights()
    del arrays[name]
    with pytest.raises(InputError, match=f"{name} is missing"):
        touch_network(arrays, "made up")


def test_the_task_may_be_one_of_another_package():
    learned = touch_network({**weights("ball"), "task": np.array("hint")}, "made up")
    assert (learned.task, learned.expected) == ("hint", 10)
    assert [(each.scale, each.rate) for each in learned.senses] == [
        (each.scale, each.rate) for each in BALL_SENSES
    ]
