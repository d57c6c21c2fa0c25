"""Players of the admission test: which policies a suite is tested with, and which are trained."""

import pytest
from colift.benchmark.admission.assessment import players, trained


@pytest.mark.parametrize(
    ("task", "learned"),
    [("intent", "pose_learned"), ("agree", "agree_learned"), ("ball", "ball_learned")],
)
def test_one_player_of_each_task_is_trained(task, learned):
    names = players(task)
    assert names[:3] == ("copy", "extrapolate", "anticipate")
    assert [name for name in names if trained(name)] == [learned]
