"""Players of the admission test: who plays, who acts alone, and with which other settings."""

import pytest
from colift.benchmark.admission.players import acts_alone, other_settings, players


@pytest.mark.parametrize("task", ["intent", "agree", "ball"])
def test_level_keepers_and_the_tasks_own_policies_play(task):
    names = players(task)
    assert names[:3] == ("copy", "extrapolate", "anticipate")
    assert all(acts_alone(name) for name in names[:3])
    assert len([name for name in names if name.endswith("learned")]) == 1


def test_of_a_task_without_its_own_policies_all_play_but_those_that_do_not_try():
    names = players("level")
    assert {"copy", "blend", "learned"} <= set(names)
    assert not {"hold", "random"} & set(names)


@pytest.mark.parametrize(
    ("name", "alone"),
    [("agree_leader", True), ("agree_follower", True), ("ball_steady", True), ("ball_calm", True)]
    + [("touch_level", True), ("agree_game", False), ("ball_game", False), ("pose_wrist", False)],
)
def test_a_policy_says_whether_it_is_blind_to_the_partner(name, alone):
    assert acts_alone(name) is alone


def test_a_policy_that_heeds_its_partner_also_plays_with_half_and_twice_its_first_parameter():
    half, twice = other_settings("ball_admittance")
    first, second = (float(each.partition("=")[2]) for each in (half, twice))
    assert half.startswith("ball_admittance,admittance=")
    assert second == pytest.approx(4 * first)
    assert other_settings("ball_steady") == other_settings("ball_learned") == ()
