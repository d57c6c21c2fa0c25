"""Admission of suites with conditions: the criteria, and the references that are told more."""

import dataclasses

import numpy as np
import pytest
from colift.agents.control.recurrent import INPUTS, GatedNetwork, read_gated, shipped_network
from colift.agents.control.recurrent_controller import RecurrentController
from colift.base.errors import InputError
from colift.benchmark.admission.inference import inference_of, needs_inference
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.references.told import ToldController, play_told, told_run
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.robust.suites import CONDITIONS
from colift.benchmark.tasks.robust.telling import Telling
from colift.benchmark.training.told_network import ToldNetwork, read_told, write_networks
from colift.benchmark.training.variants import TOLD_BOTH, UNTOLD, USUAL

BEHAVIOURS = ("dip", "wait")

PEOPLE = range(502, 507)

SUITE = people_suite("few", "level", BEHAVIOURS, PEOPLE, conditions=CONDITIONS)


def network(*, ahead=0.0, telling=None):
    """Return `learned`, which also goes ahead by the age of the sample if it is told that."""
    own, telling = shipped_network(), telling or Telling(behaviours=BEHAVIOURS)
    units = own.units
    more = np.zeros((1, telling.size))
    more[0, 0] = ahead
    wider = GatedNetwork(
        inputs=np.hstack((own.inputs, np.zeros((3 * units, telling.size)))),
        memory=own.memory,
        bias=own.bias,
        output=np.hstack((own.output, more)),
        output_bias=own.output_bias,
    )
    return ToldNetwork(network=wider, telling=telling, conditions=CONDITIONS)


def lift_numbers(telling, scenario, seed=0):
    lift = Lift(scenario)
    lift.reset(seed)
    return lift, telling.numbers(scenario, lift.conditions)


def test_what_is_not_told_is_zero():
    nothing = Telling(behaviours=BEHAVIOURS, sensor=False, person=False)
    _, numbers = lift_numbers(nothing, SUITE.scenarios[0])
    assert numbers.shape[1] == nothing.size
    assert not numbers.any()


def test_the_sensor_s_numbers_are_the_ages_and_the_person_s_do_not_change():
    telling = Telling(behaviours=BEHAVIOURS)
    lift, numbers = lift_numbers(telling, SUITE.scenarios[0])
    assert len(numbers) == len(lift.conditions.ages)
    assert np.corrcoef(numbers[:, 0], lift.conditions.ages)[0, 1] == pytest.approx(1.0)
    assert (numbers[:, 2:] == numbers[0, 2:]).all()
    assert np.abs(numbers).max() < 3.0


def test_people_differ_and_behaviours_outside_the_vocabulary_are_none():
    telling = Telling(behaviours=BEHAVIOURS)
    rows = {tuple(lift_numbers(telling, each)[1][0, 2:]) for each in SUITE.scenarios}
    assert len(rows) == len(SUITE.scenarios)
    strange = dataclasses.replace(SUITE.scenarios[0], behaviour="waltz")
    assert not lift_numbers(telling, strange)[1][:, -len(BEHAVIOURS) :].any()


def test_a_network_that_ignores_what_it_is_told_plays_as_the_policy():
    scenario = SUITE.scenarios[0]
    lift, numbers = lift_numbers(Telling(behaviours=BEHAVIOURS), scenario)
    told = run_episode(lift, ToldController(network().network, numbers), 0)
    plain = run_episode(lift, RecurrentController(shipped_network()), 0)
    assert np.abs(told.trace.robot_end - plain.trace.robot_end).max() < 1e-9


def test_files_come_back(tmp_path):
    nothing = Telling(behaviours=BEHAVIOURS, sensor=False, person=False)
    every = {TOLD_BOTH: network(ahead=0.3), UNTOLD: network(telling=nothing)}
    write_networks(every, tmp_path / "new")
    again = read_told(tmp_path / "new" / "told_both.npz")
    assert again.telling == every[TOLD_BOTH].telling
    assert again.conditions == CONDITIONS
    assert (again.network.output == every[TOLD_BOTH].network.output).all()
    policy = read_gated(tmp_path / "new" / "untold.npz")
    assert policy.inputs.shape[1] == INPUTS
    with pytest.raises(InputError, match="not a network that is told more"):
        read_told(tmp_path / "new" / "untold.npz")
    with pytest.raises(InputError, match="cannot write"):
        write_networks(every, tmp_path / "new")


@pytest.mark.slow
def test_the_criteria_pass_only_beyond_their_bars():
    """A network that is no better for what it is told shows nothing to infer."""
    same, worse = network(), network(ahead=8.0)
    found = inference_of(SUITE, {USUAL: worse, UNTOLD: same, TOLD_BOTH: same})
    one_delay, something = found.criteria
    assert one_delay.passed
    runs = (play_told(each, SUITE) for each in (worse, same))
    late, early = (np.log([each.scores["rmse_mm"] for each in run.episodes]) for run in runs)
    assert one_delay.figure == pytest.approx(np.exp((late - early).mean()))
    assert one_delay.ci95[0] < one_delay.figure < one_delay.ci95[1]
    assert something.figure == 1.0
    assert something.passed is False
    assert not found.passed
    turned = inference_of(SUITE, {USUAL: same, UNTOLD: worse, TOLD_BOTH: same})
    assert [each.passed for each in turned.criteria] == [False, True]


def test_only_suites_with_conditions_in_every_lift_claim_inference():
    assert needs_inference(make_suite("robust-v1"))
    assert needs_inference(SUITE)
    for name in ("standard-v1", "agree-v1"):
        assert not needs_inference(make_suite(name))
    mixed = dataclasses.replace(SUITE.scenarios[0], conditions=None)
    assert not needs_inference(dataclasses.replace(SUITE, scenarios=(mixed, *SUITE.scenarios[1:])))


def test_nobody_can_be_told_what_is_not_drawn():
    with pytest.raises(InputError, match="no conditions"):
        play_told(network(), make_suite("quick-v1"))
    narrow = people_suite("narrow", "level", ("dip",), PEOPLE, conditions=Conditions())
    assert "told" not in suite_references(narrow)
    with pytest.raises(InputError, match="no reference was told"):
        told_run(narrow)
