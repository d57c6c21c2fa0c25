"""The twin; the tests are in ``jax_*.py``, which run in a process of their own."""

from pathlib import Path

import pytest
from colift.benchmark.twin import libraries

pytestmark = pytest.mark.slow

HERE = Path(__file__).parent


def test_the_twin(in_own_process):
    in_own_process(*sorted(HERE.glob("jax_*.py")))


def test_a_missing_library_names_the_extra(monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(libraries.importlib, "import_module", missing)
    with pytest.raises(libraries.InputError, match=r"the twin needs jax.*(\[train\]|all-extras)"):
        libraries.require_jax()
