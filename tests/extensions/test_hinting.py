"""Another package's task with people of its own does what ours do, without an edit of ours."""

from pathlib import Path

import colift as library
import pytest
from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.suites.suite import make_suite
from colift.testing import check_suite, check_task

from . import hinting

pytestmark = pytest.mark.slow


def test_it_plays_scores_and_verifies(install, colift):
    install(hinting.__file__, hinting.ENTRY_POINTS)
    check_task(make_task("hint"))
    check_suite(make_suite("hint-v1"))
    done = colift("run", "copy", "--suite", "hint-v1", "--out", "mine")
    assert done.returncode == 0, done.stderr
    verified = colift("verify", "mine")
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_people_and_behaviours_are_drawn_for_it(install):
    install(hinting.__file__, hinting.ENTRY_POINTS)
    env = library.parallel_env(behaviour="any", subject="draw", task="hint")
    try:
        names = {env.reset(seed=seed)[1]["human"]["scenario"] for seed in range(6)}
        assert len(names) == 6
        observation = env.reset(seed=0)[0]["robot"]
        assert observation.shape == (8,)
    finally:
        env.close()


@pytest.mark.parametrize("module", ["jax_hinting.py"])
def test_it_trains_on_the_twin(in_own_process, module):
    in_own_process(Path(__file__).with_name(module))
