"""The twin as an environment; ``jax_*.py`` has the tests, which run in a process of their own."""

from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.mark.slow
def test_the_environments(in_own_process):
    in_own_process(*sorted(HERE.glob("jax_*.py")))
