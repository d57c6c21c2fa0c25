"""Cloning and implicit Q-learning; the tests are in ``jax_offline.py``, a process of its own."""

from pathlib import Path

import pytest


@pytest.mark.slow
def test_learning_from_data(in_own_process):
    in_own_process(Path(__file__).with_name("jax_offline.py"))
