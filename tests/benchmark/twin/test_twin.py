"""The twin; the tests are in ``jax_*.py``, which run in a process of their own."""

import os
import subprocess
import sys
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


@pytest.mark.parametrize("command", [("train", "apg", "--out", "made"), ("bench", "--twin")])
def test_a_gpu_that_is_not_there_is_refused_in_one_line(tmp_path, compiling, command):
    order = [sys.executable, "-m", "colift", *command, "--device", "gpu"]
    environment = {**os.environ, **compiling, "CUDA_VISIBLE_DEVICES": ""}
    done = subprocess.run(order, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 2
    error, *more = done.stderr.splitlines()
    assert error.startswith("error: there is no gpu for JAX here; for a GPU of NVIDIA: ")
    assert not more
    assert [*tmp_path.iterdir()] == []
