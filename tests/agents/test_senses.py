"""The senses of the robot: index tables, bounds and inputs follow from them."""

import pytest
from colift.agents.agent import RobotObservation
from colift.agents.senses import layout
from colift.agents.tasks.agree.observation import AgreeObservation
from colift.agents.tasks.ball.observation import BallObservation
from colift.agents.tasks.touch.observation import HapticObservation
from colift.benchmark.suites.catalogue import make_task

TABLES = {
    "level": RobotObservation,
    "intent": HapticObservation,
    "agree": AgreeObservation,
    "ball": BallObservation,
}


@pytest.mark.parametrize("name", TABLES)
def test_an_index_table_names_the_senses_of_its_task_in_their_order(name):
    task = make_task(name)
    found = layout(task.senses, touch=task.touch)
    assert {each.name: each.value for each in found} == {
        each.name: each.value for each in TABLES[name]
    }
    assert all(len(bounds) == len(found) for bounds in task.robot_bounds())
