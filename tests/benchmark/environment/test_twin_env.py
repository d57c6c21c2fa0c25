"""The vector environment on the twin; its tests run in a process of their own."""

from pathlib import Path

import pytest


@pytest.mark.slow
def test_the_vector_environment(in_own_process):
    in_own_process(Path(__file__).with_name("jax_twin_env.py"))
