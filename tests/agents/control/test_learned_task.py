import dataclasses
import json

import numpy as np
import pytest
from colift.agents.control.adaptive_impedance import LearnedImpedance
from colift.agents.control.learned_task import (
    LearnedTask,
    TaskForecast,
    load_task,
    read_task,
    task_json,
    velocity_inputs,
)
from colift.agents.estimators.gaussian_mixture import Conditional, GaussianMixture
from colift.base.errors import InputError

VELOCITIES = Conditional(
    mean=np.array([0.1, 0.2, -0.1]),
    covariance=np.array([[4.0, 2.0, 1.0], [2.0, 5.0, 3.0], [1.0, 3.0, 6.0]]) * 1e-4,
    responsibilities=np.ones(1),
)
FORECAST = TaskForecast(0.05, VELOCITIES, 0.1)


def persistent(interval=0.1, past=2, spread=1e-3):
    """Return a task in which velocities stay as they are, up to a little."""
    size = 1 + past + 2
    covariance = np.eye(size)
    covariance[1:, 1:] = 0.04
    covariance[1:, 1:] += spread**2 * np.eye(size - 1)
    return LearnedTask(
        mixture=GaussianMixture(
            weights=np.ones(1), means=np.zeros((1, size)), covariances=covariance[np.newaxis]
        ),
        past=past,
        interval=interval,
        tolerance=0.01,
        impedance=LearnedImpedance(stiffness=np.ones(1), lead=0.0, offset=0.0),
    )


def test_inputs_are_the_height_and_the_velocities_newest_first():
    assert velocity_inputs([0.0, 0.01, 0.03, 0.02], 0.1) == pytest.approx([0.02, -0.1, 0.2, 0.1])
    several = velocity_inputs([[0.0, 0.1], [0.5, 0.3]], 0.5)
    assert several == pytest.approx(np.array([[0.1, 0.2], [0.3, -0.4]]))


def test_heights_ahead_are_the_integral_of_the_velocities():
    assert FORECAST.ahead(0.0) == (0.05, 0.0)
    assert FORECAST.ahead(0.1)[0] == pytest.approx(0.06)
    assert FORECAST.ahead(0.15)[0] == pytest.approx(0.07)
    assert FORECAST.ahead(0.3)[0] == pytest.approx(0.07)
    assert FORECAST.ahead(0.5)[0] == pytest.approx(0.05), "the last velocity goes on"
    for time in (0.03, 0.17, 0.26, 0.4):
        slope = (FORECAST.ahead(time + 1e-6)[0] - FORECAST.ahead(time - 1e-6)[0]) / 2e-6
        assert FORECAST.velocity(time) == pytest.approx(slope)


def test_the_variance_ahead_is_that_of_the_integral():
    """By samples: velocities drawn from the covariance, integrated one by one."""
    rng = np.random.default_rng(1)
    drawn = rng.multivariate_normal(VELOCITIES.mean, VELOCITIES.covariance, 200_000)
    for time, spent in ((0.1, (0.1, 0, 0)), (0.15, (0.1, 0.05, 0)), (0.4, (0.1, 0.1, 0.2))):
        assert FORECAST.ahead(time)[1] == pytest.approx((drawn @ spent).var(), rel=0.02)


def test_a_persistent_task_goes_on_as_seen():
    forecast = persistent().forecast([0.02, 0.03, 0.04])
    assert forecast.height == 0.04
    assert forecast.velocities.mean == pytest.approx([0.1, 0.1], abs=1e-4)
    assert forecast.ahead(0.2)[0] == pytest.approx(0.06, abs=1e-4)


def test_what_is_written_is_read_back_to_the_bit():
    task = dataclasses.replace(load_task(), provenance={"command": "colift learn task_model"})
    again = read_task(task_json(task))
    assert task_json(again) == task_json(task)
    assert again.mixture.covariances.tobytes() == task.mixture.covariances.tobytes()
    assert again.impedance.stiffness.tobytes() == task.impedance.stiffness.tobytes()
    assert again.provenance == {"command": "colift learn task_model"}


def test_the_shipped_task_says_where_it_comes_from():
    task = load_task()
    told = task.provenance
    assert told["command"].startswith("colift learn task_model")
    assert told["fit"]["converged"]
    assert told["demonstrations"]["lifts"] == 400
    assert told["practice"]["lifts"] == 200
    assert len(task_json(task)) < 30_000
    assert load_task() is task


def test_the_shipped_task_knows_rest_and_motion():
    """At rest nothing is expected; a lift under way goes on, a fast one not for ever."""
    task = load_task()
    still = task.forecast(np.zeros(task.past + 1))
    assert still.ahead(0.2)[0] == pytest.approx(0.0, abs=0.003)
    rising = task.forecast(0.12 + 0.012 * np.arange(-task.past, 1))
    assert 0.12 + 0.014 < rising.ahead(0.2)[0] < 0.12 + 0.028
    assert rising.ahead(0.2)[1] > rising.ahead(0.1)[1] > 0.0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"past": 0}, "past must be 1 to 3, to leave a coming velocity, got 0"),
        ({"past": 4}, "past must be 1 to 3, to leave a coming velocity, got 4"),
        ({"interval": 0.0}, "interval must be a positive number, got 0.0"),
        ({"tolerance": np.nan}, "tolerance must be a positive number"),
        (
            {"impedance": LearnedImpedance(stiffness=np.ones(2), lead=0.0, offset=0.0)},
            "mixture of 1 components needs as many stiffnesses, got 2",
        ),
    ],
)
def test_parts_that_do_not_fit_are_refused(change, told):
    with pytest.raises(InputError, match=told):
        dataclasses.replace(persistent(), **change)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "not a task model: JSONDecodeError"),
        ("[]", "not a task model: TypeError"),
        ("{}", "not a task model: KeyError: 'mixture'"),
        (task_json(persistent()).replace('"weights"', '"shares"'), "not a task model: TypeError"),
        (task_json(persistent()).replace('"weights": [1.0]', '"weights": [0.5]'), "weights must"),
    ],
)
def test_a_file_that_is_no_model_is_named(tmp_path, text, told):
    path = tmp_path / "model.json"
    path.write_text(text)
    with pytest.raises(InputError, match=f"model.json: {told}"):
        load_task(str(path))
    with pytest.raises(InputError, match=r"gone.json: cannot be read"):
        load_task(str(tmp_path / "gone.json"))


def test_the_file_has_one_part_a_line():
    lines = task_json(persistent()).splitlines()
    assert (lines[0], lines[-1]) == ("{", "}")
    for line in lines[1:-1]:
        json.loads("{" + line.rstrip(",") + "}")
