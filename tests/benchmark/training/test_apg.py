"""Analytic policy gradients; what needs JAX is in ``jax_apg.py``."""

from pathlib import Path

import pytest
from colift.base.errors import InputError
from colift.benchmark.training.apg_settings import ApgSettings

pytestmark = pytest.mark.slow


def test_training(in_own_process):
    modules = (
        "jax_apg.py",
        "jax_touch.py",
        "jax_pairs.py",
        "jax_conditioned_lesson.py",
        "jax_session_lesson.py",
    )
    in_own_process(*map(Path(__file__).with_name, modules))


def test_the_variation_of_the_arms_grows_to_what_was_asked_for():
    settings = ApgSettings(updates=10, varied=0.2)
    varied = [settings.varied_in(update) for update in range(10)]
    assert varied == pytest.approx([0.02 * many for many in range(1, 11)])


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"task": "tea"}, "unknown task 'tea'; known: .*level"),
        ({"task": "ball", "smoothness": 0.1}, "--smoothness has no effect on the task 'ball'"),
        (
            {"task": "ball", "wide": 0.1},
            "--wide has no effect on the task 'ball'",
        ),
        ({"task": "ball", "encoders": 0.0}, "--encoders has no effect on the task 'ball'"),
        (
            {"task": "ball", "unsettled": 0},
            "--unsettled has no effect on the task 'ball'",
        ),
        ({"unsettled": -1}, "--unsettled must be at least 0, got -1"),
        ({"encoders": -1e-4}, "--encoders must be at least 0, got -0.0001"),
        (
            {"task": "ball", "session": "remember"},
            "--session has no effect on the task 'ball'",
        ),
        (
            {"session": "remember", "wide": 0.1},
            "--wide has no effect on sessions",
        ),
        ({"alone": True}, "--alone has no effect on the task 'level'"),
        ({"session": "sometimes"}, "--session must be remember or forget, got 'sometimes'"),
        ({"lifts": 1}, "--lifts must be 2 to 90000, got 1"),
        ({"lifts": 90_001}, "--lifts must be 2 to 90000, got 90001"),
        (
            {"session": "forget", "lifts": 19},
            "--lifts must be 20 to 900000 in sessions, got 19",
        ),
        ({"updates": 0}, "--updates must be at least 1, got 0"),
        ({"batch": 5}, "--batch must be a multiple of 2, got 5"),
        ({"wide": 1.0}, r"--wide must be at least 0 and below 1, got 1\.0"),
        ({"smoothness": -1.0}, r"--smoothness must be at least 0, got -1\.0"),
        ({"varied": float("nan")}, "--varied must be at least 0, got nan"),
        ({"rate": 0.0}, r"--rate must be between 0 and 1, got 0\.0"),
    ],
)
def test_settings_out_of_range_are_refused(settings, message):
    with pytest.raises(InputError, match=message):
        ApgSettings(**settings)
