import dataclasses

import numpy as np
import pytest
from colift.agents.agent import RobotObservation
from colift.agents.control.adaptive_impedance import LearnedImpedance, certainty
from colift.agents.control.learned_task import LearnedTask, load_task, task_json
from colift.agents.estimators.gaussian_mixture import GaussianMixture
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.policies.task_model import TaskModel, TaskModelController, TaskModelParameters
from colift.base.errors import InputError


def persistent(stiffness=0.0, lead=0.0, offset=0.0, spread=1e-4):
    """Return a task in which velocities stay as they are, up to a spread [m/s]."""
    covariance = np.eye(6)
    covariance[1:, 1:] = 1.0 + spread**2 * np.eye(5)
    return LearnedTask(
        mixture=GaussianMixture(
            weights=np.ones(1), means=np.zeros((1, 6)), covariances=covariance[np.newaxis]
        ),
        past=2,
        interval=0.1,
        tolerance=0.012,
        impedance=LearnedImpedance(stiffness=np.full(1, stiffness), lead=lead, offset=offset),
    )


def view(human, command=0.0, time=0.0):
    return np.array([human, 0.3, -0.3, command, time])


def follow(task, path, *, period=0.1, steps=30, command=0.0, **parameters):
    """Let a controller see a path 0.1 s late; its command is carried out exactly.

    Returns
    -------
    The commands at the end of the steps, the movements and the internals.
    """
    controller = TaskModelController(task, TaskModelParameters(**parameters))
    controller.reset(0)
    commands, movements, internals = [], [], []
    for k in range(steps):
        time = period * k
        movements.append(controller.step(view(path(time - 0.1), command, time)))
        command += movements[-1].change
        commands.append(command)
        internals.append(controller.internals())
    return np.array(commands), movements, internals


@pytest.mark.parametrize("period", [0.02, 0.05, 0.1, 0.2])
def test_a_steady_motion_is_met_at_the_end_of_every_period(period):
    """With the latency and the period made up for, nothing lags."""
    commands, _, told = follow(persistent(), lambda t: 0.1 * t, period=period, steps=20)
    ends = 0.1 * period * np.arange(1, 21)
    settled = round(0.5 / period)
    assert commands[settled:] == pytest.approx(ends[settled:], abs=2e-4)
    assert [i["prediction"] for i in told[settled:]] == pytest.approx(ends[settled:], abs=2e-4)


def test_an_assumed_latency_shifts_the_plan():
    for latency in (0.0, 0.1, 0.2):
        commands, _, _ = follow(persistent(), lambda t: 0.1 * t, latency=latency)
        assert commands[-1] == pytest.approx(0.1 * (2.9 + latency), abs=2e-4)


def test_lead_and_offset_are_fed_forward():
    task = persistent(lead=0.05, offset=0.002)
    moving, _, _ = follow(task, lambda t: 0.1 * t)
    assert moving[-1] == pytest.approx(0.1 * (3.0 + 0.05) + 0.002, abs=2e-4)
    still, _, _ = follow(task, lambda t: 0.08)
    assert still[-1] == pytest.approx(0.082, abs=1e-6)


def test_stiffness_takes_a_deviation_up_in_shares_and_keeps_up_with_the_plan():
    """After a start 30 mm off, the deviation shrinks by K / (1 + K) a step; velocity is kept."""
    task = persistent(stiffness=3.0)
    commands, _, told = follow(task, lambda t: 0.1 * t, command=0.03)
    off = commands - 0.1 * 0.1 * np.arange(1, 31)
    roles = np.array([i["role"] for i in told])
    assert off[10:15] == pytest.approx(off[9:14] * roles[10:15], rel=1e-2)
    assert 0.7 < roles[-1] < 0.75
    assert off[-1] == pytest.approx(0.0, abs=2e-4)


def test_every_change_is_made_of_what_is_reported():
    task = persistent(stiffness=2.0, offset=0.001)
    rng = np.random.default_rng(6)
    noise = dict(enumerate(rng.normal(0.0, 0.003, 40)))
    _, movements, told = follow(task, lambda t: 0.05 * t + noise[round(10 * (t + 0.1))])
    for movement, internals in zip(movements, told, strict=True):
        stiffness, sure = internals["stiffness"], internals["confidence"]
        variance = internals["surprise"] * internals["predicted_deviation"] ** 2
        assert sure == pytest.approx(certainty(variance, task.tolerance))
        assert stiffness == pytest.approx(2.0 * sure)
        assert movement.correction == pytest.approx(1 / (1 + stiffness))
        assert internals["role"] == pytest.approx(stiffness / (1 + stiffness))
        assert movement.weights == pytest.approx([sure])
    plan = [m.change - m.correction * m.deviation for m in movements]
    assert plan == pytest.approx([0.1 * i["predicted_velocity"] for i in told], abs=1e-9)


def test_a_model_that_is_sure_is_stiff_and_one_that_is_not_yields():
    roles = [
        follow(persistent(stiffness=2.0, spread=spread), lambda t: 0.0)[2][0]["role"]
        for spread in (1e-5, 0.03, 0.1, 1.0)
    ]
    assert roles == sorted(roles, reverse=True)
    assert roles[0] == pytest.approx(2 / 3, abs=1e-3)
    assert roles[-1] < 0.05


def test_a_surprise_makes_it_yield_until_it_is_forgotten():
    """The human stops all at once; the model had expected the motion to go on."""
    task = persistent(stiffness=2.0, spread=0.02)
    _, _, told = follow(task, lambda t: 0.1 * min(t, 1.0), steps=60)
    role = np.array([i["role"] for i in told])
    surprise = np.array([i["surprise"] for i in told])
    # What happened at 1.0 s is first seen at 1.2 s.
    assert surprise[12] > 3 > 1 > surprise[11]
    assert role[12:14].max() < role[11] - 0.05
    assert (np.diff(role[14:]) > 0).all()
    assert role[-1] == pytest.approx(2 / 3, abs=1e-3)


def test_a_longer_memory_forgets_a_surprise_later():
    def after(memory):
        told = follow(persistent(), lambda t: 0.1 * min(t, 1.0), steps=30, memory=memory)[2]
        return told[20]["surprise"]

    assert after(1.0) > 1.5 * after(0.2)


def test_what_the_sensor_is_known_to_add_is_no_surprise():
    rng = np.random.default_rng(9)
    noise = dict(enumerate(rng.normal(0.0, 0.002, 50)))
    told = [
        follow(persistent(), lambda t: noise[round(10 * t + 1)], measurement_noise=known)[2][-1]
        for known in (0.0005, 0.002, 0.1)
    ]
    assert told[0]["surprise"] > 3 * told[1]["surprise"] > 9 * told[2]["surprise"]


def test_between_samples_the_past_is_interpolated():
    """Samples at odd times of a steady motion give the same plan as samples at whole intervals."""
    seen = []
    for times in ((0.0, 0.1, 0.2), (0.0, 0.07, 0.13, 0.2), (0.0, 0.03, 0.2)):
        controller = TaskModelController(persistent(), TaskModelParameters())
        controller.reset(0)
        for time in times:
            movement = controller.step(view(0.3 * time, time=time))
        seen.append(controller.internals()["predicted_velocity"])
        assert movement.velocity == seen[-1]
    assert seen == pytest.approx([0.3] * 3, abs=1e-4)


def test_only_what_a_robot_needs_is_looked_at():
    one, other = TaskModel(), TaskModel()
    one.reset(0)
    other.reset(1)
    rng = np.random.default_rng(3)
    for k in range(20):
        seen = view(0.01 * k, 0.01 * k, 0.1 * k)
        changed = seen.copy()
        changed[[RobotObservation.ROBOT_END, RobotObservation.HAND_HEIGHT]] = rng.normal(size=2)
        assert one.act(seen) == other.act(changed)


def test_the_policy_is_the_controller_of_its_model(tmp_path):
    path = tmp_path / "model.json"
    path.write_text(task_json(persistent(stiffness=1.0)))
    policy = PolicySpec(
        text=f"colift.agents.policies.task_model:TaskModel,model={path},memory=0.3"
    ).make()
    policy.reset(0)
    controller = TaskModelController(persistent(stiffness=1.0), TaskModelParameters(memory=0.3))
    controller.reset(0)
    for k in range(15):
        seen = view(0.01 * np.sin(k), 0.0, 0.1 * k)
        assert policy.act(seen).tolist() == [controller.step(seen).change]
        assert policy.internals() == controller.internals()


def test_practice_replaces_the_impedance_of_the_controller_alone():
    task = load_task()
    controller = TaskModelController(task, TaskModelParameters())
    controller.impedance = dataclasses.replace(task.impedance, offset=0.05)
    assert TaskModelController(task, TaskModelParameters()).impedance is task.impedance


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"latency": -0.1}, "latency must be a number of at least 0, got -0.1"),
        ({"latency": np.nan}, "latency"),
        ({"memory": 0.0}, "memory must be a positive number, got 0.0"),
        ({"limit": np.inf}, "limit must be a positive number, got inf"),
        ({"measurement_noise": -1.0}, "measurement_noise must be a positive number"),
    ],
)
def test_impossible_parameters_are_refused(change, told):
    with pytest.raises(InputError, match=told):
        TaskModelParameters(**change)


def test_a_model_that_is_not_there_is_refused_at_once():
    with pytest.raises(InputError, match=r"nowhere.json: cannot be read"):
        TaskModel(parameters=TaskModelParameters(model="nowhere.json"))
