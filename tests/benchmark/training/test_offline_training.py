"""Cloning and implicit Q-learning, in a process of their own: JAX and forks do not mix."""

from pathlib import Path

import pytest

pytest.importorskip("jax")
pytest.importorskip("optax")


def test_learning_from_data(in_own_process):
    in_own_process(Path(__file__).with_name("jax_offline.py"))
