"""Policies for two hurdles, on made-up observations."""

import numpy as np
import pytest
from colift.agents.tasks.agree.agree_admittance import AgreeAdmittance, AgreeAdmittanceParameters
from colift.agents.tasks.agree.agree_follower import AgreeFollower, AgreeFollowerParameters
from colift.agents.tasks.agree.agree_game import AgreeGame, AgreeGameParameters
from colift.agents.tasks.agree.agree_leader import AgreeLeader, AgreeLeaderParameters
from colift.agents.tasks.agree.observation import AgreeObservation as Layout
from colift.base.errors import InputError

COMMON, VIA = 0.15, 0.19


def played(policy, *, human, given=1.0, opens=1.5, length=1.5, steps=32):
    """Return the commands of a robot that rests at the common height, beside a human's path.

    ``human`` is a function of the time and of the command.
    """
    policy.reset(0)
    command, commands, ends = COMMON, [], [COMMON] * 3
    for k in range(steps):
        time = 0.1 * k
        end = human(time, command)
        ends.append(end)
        view = np.zeros(len(Layout))
        view[Layout.HUMAN_END], view[Layout.ROBOT_END] = ends[-2], command
        view[Layout.HAND_HEIGHT] = view[Layout.HAND_COMMAND] = command
        view[Layout.TIME] = time
        view[Layout.FORCE] = 15.6 * (command - end)
        view[Layout.TORQUE] = (end - command) / 0.8
        if given:
            view[Layout.HURDLE_HEIGHT :] = VIA, opens - time, opens + length - time, 1.0
        command += min(max(float(policy.act(view)[0]), -0.04), 0.04)
        commands.append(command)
    return np.array(commands)


def still(time, command):
    return COMMON


def along(time, command):
    return command


def away(time, command):
    """Go to a hurdle of the own at 1.2 s, and rest there until 2.0 s."""
    return COMMON - 0.04 * min(max((time - 1.2) / 0.3, 0.0), 1.0) if time < 2.0 else COMMON


@pytest.mark.parametrize("policy", [AgreeLeader, AgreeFollower, AgreeAdmittance, AgreeGame])
def test_without_a_hurdle_nothing_leads_away_from_a_level_table(policy):
    assert played(policy(), human=still, given=0.0) == pytest.approx(COMMON, abs=0.004)


def test_the_leader_goes_as_the_window_opens_whatever_the_human_does():
    assert played(AgreeLeader(), human=away)[16:22] == pytest.approx(VIA, abs=0.008)


def test_the_follower_waits_for_the_last_moment():
    path = played(AgreeFollower(), human=still)
    assert path[:21] == pytest.approx(COMMON, abs=0.004)
    assert path[28] == pytest.approx(VIA, abs=0.008)


def test_admittance_arrives_with_a_human_who_comes_along_and_compromises_with_another():
    assert played(AgreeAdmittance(), human=along, length=0.9)[20] == pytest.approx(VIA, abs=0.007)
    assert COMMON + 0.01 < played(AgreeAdmittance(), human=still)[22] < VIA - 0.01


def test_the_negotiator_goes_first_where_nobody_is_on_the_way():
    assert played(AgreeGame(), human=still)[17:20] == pytest.approx(VIA, abs=0.01)


def test_the_negotiator_lets_a_human_go_first_and_then_goes():
    path = played(AgreeGame(), human=away)
    assert path[16:18] == pytest.approx(COMMON - 0.04, abs=0.012)
    assert path[26:29].max() == pytest.approx(VIA, abs=0.012)


@pytest.mark.parametrize(
    ("parameters", "name"),
    [
        (AgreeLeaderParameters, "pace"),
        (AgreeFollowerParameters, "needed"),
        (AgreeAdmittanceParameters, "compliance"),
        (AgreeGameParameters, "served"),
    ],
)
def test_parameters_must_be_positive(parameters, name):
    with pytest.raises(InputError, match=name):
        parameters(**{name: -1.0})
