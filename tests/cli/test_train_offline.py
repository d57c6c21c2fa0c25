"""``colift train clone`` and ``colift train iql``, in a process of their own."""

from pathlib import Path

import pytest

pytest.importorskip("jax")
pytest.importorskip("optax")
pytest.importorskip("minari")


def test_trainings_from_data(in_own_process):
    in_own_process(Path(__file__).with_name("jax_train_offline.py"))
