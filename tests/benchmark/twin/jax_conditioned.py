"""The twin with conditions: its lifts are those of the engine."""

import dataclasses
from contextlib import closing

import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.control.recurrent import shipped_network
from colift.agents.control.recurrent_controller import RecurrentController
from colift.base.errors import InputError
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.tasks.robust.suites import BEHAVIOURS, CONDITIONS
from colift.benchmark.twin.conditioned_lifts import draw_conditioned, stack_conditioned
from colift.benchmark.twin.conditioned_twin import conditioned_rmse_mm
from colift.benchmark.twin.lifts import check_modelled, draw_lifts
from colift.benchmark.twin.rollout import recurrent, rollout

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
    drawn = stack_conditioned([draw_conditioned(*each) for each in lifts])
    policy, memory = recurrent(NETWORK, drawn.size)
    return np.asarray(conditioned_rmse_mm(policy, memory, drawn))


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


def test_without_conditions_a_lift_is_that_of_the_usual_twin():
    lift = (make_scenario("pause", "draw-190001"), 190_001)
    policy, memory = recurrent(NETWORK, 1)
    usual = rollout(policy, memory, draw_lifts([lift])).rmse_mm
    # Arms that may vary are rounded otherwise, and a hand takes another row of its path.
    assert in_twin([lift]) == pytest.approx(np.asarray(usual), rel=1e-3)


def test_a_robot_that_never_moves_keeps_a_patient_person_waiting_here_too():
    drawn = stack_conditioned([draw_conditioned(scenario("follow", PEOPLE[0]), 0)])
    held = conditioned_rmse_mm(lambda memory, view: (memory, 0.0 * view[0]), jnp.zeros(1), drawn)
    assert float(held[0]) > 100


def test_the_usual_twin_refuses_what_it_does_not_model():
    for scene in (scenario("dip", 1), make_scenario("follow")):
        with pytest.raises(InputError, match="the twin with conditions"):
            check_modelled(scene)
