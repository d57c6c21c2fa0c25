"""``colift train clone`` and ``colift train iql``; the tests are in ``jax_train_offline.py``."""

import importlib.util
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow


def test_trainings_from_data(in_own_process):
    if importlib.util.find_spec("minari") is None:
        pytest.skip("Minari is not installed")
    in_own_process(Path(__file__).with_name("jax_train_offline.py"))
