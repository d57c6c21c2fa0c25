"""The twin with conditions: its lifts are those of the engine."""

import dataclasses
from contextlib import closing

import numpy as np
import pytest
from colift.agents.control.recurrent import shipped_network
from colift.agents.control.recurrent_controller import RecurrentController
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.robust.suites import BEHAVIOURS, CONDITIONS
from colift.benchmark.twin.drawing import draw_lifts
from colift.benchmark.twin.policy import recurrent
from colift.benchmark.twin.rollout import rollout
from colift.benchmark.twin.task_twin import TaskTwin

PEOPLE = (210_020, 210_021)
CLOSE = 0.015
"""Largest relative difference of a lift's RMSE, that of :data:`.WORST_LIMIT`."""

NETWORK = shipped_network()


def scenario(behaviour, person, conditions=CONDITIONS):
    return dataclasses.replace(make_scenario(behaviour, f"draw-{person}"), conditions=conditions)


def in_engine(scene, seed):
    with closing(Lift(scene)) as lift:
        return run_episode(lift, RecurrentController(NETWORK), seed).scores["rmse_mm"]


def in_twin(lifts):
    twin, drawn = TaskTwin.of([scene for scene, _ in lifts]), draw_lifts(lifts)
    policy, memory = recurrent(NETWORK, drawn.size)
    return np.asarray(rollout(twin, policy, memory, drawn).rmse_mm)


def test_each_lift_has_the_error_of_the_engine():
    lifts = [(scenario(each, person), person) for each in BEHAVIOURS for person in PEOPLE]
    engine = np.array([in_engine(*each) for each in lifts])
    assert in_twin(lifts) == pytest.approx(engine, rel=CLOSE)


@pytest.mark.parametrize(
    ("ranges", "least"),
    [
        ({"latency": (0.27, 0.27)}, 0.1),
        ({"table": (0.7, 0.7)}, 0.002),
        # The network measures the sag, and compensates it.
        ({"sag": (2.0, 2.0)}, 0.0001),
        ({"gain": (0.6, 0.6)}, 0.002),
        ({"loss": (0.3, 0.3), "burst": (15.0, 15.0)}, 0.01),
    ],
)
def test_each_condition_matters_and_has_the_effect_that_it_has_in_the_engine(ranges, least):
    lift = (scenario("dip", PEOPLE[0], Conditions(**ranges)), 3)
    plain = (scenario("dip", PEOPLE[0], Conditions()), 3)
    engine = in_engine(*lift)
    assert in_twin([lift]) == pytest.approx(engine, rel=0.01)
    assert abs(engine / in_engine(*plain) - 1) > least


def test_a_lift_without_conditions_is_the_same_beside_one_with_them():
    """Beside it, people may slow down, and arms vary: rounded otherwise, a hand is elsewhere."""
    lift = (make_scenario("pause", "draw-190001"), 190_001)
    both = in_twin([lift, (scenario("follow", PEOPLE[0]), 0)])
    assert in_twin([lift])[0] == pytest.approx(both[0], rel=1e-3)


def test_a_robot_that_never_moves_keeps_a_patient_person_waiting_here_too():
    lifts = [(scenario("follow", PEOPLE[0]), 0)]
    twin = TaskTwin.of([scene for scene, _ in lifts])
    held = rollout(twin, lambda memory, view: (memory, 0.0 * view[0]), None, draw_lifts(lifts))
    assert float(held.rmse_mm[0]) > 100
