"""Frozen in 0.2.0: the suites by digest, and what is in them."""

import itertools

import pytest
from colift.agents.humans import SUBJECTS, Subject
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.environment.drawing import TRAINING_SEEDS
from colift.benchmark.export.fixed_sets import FIRST_SEED as EXPORTED
from colift.benchmark.export.fixed_sets import MOST_LIFTS
from colift.benchmark.references.held_out import held_out_suite
from colift.benchmark.suites import ranges
from colift.benchmark.suites.people import people_suite
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.training.demonstrations import FIRST_SEED as DEMONSTRATED
from colift.benchmark.training.demonstrations import LIFTS
from colift.benchmark.training.task_model import TUNING_LIFTS, TUNING_SEED

FROZEN = {
    "agree-v1": "8be3f3907d590b85",
    "ball-v1": "d8910584b13585aa",
    "intent-v1": "a0aeec6659923fee",
    "paper-v1": "8ea792f9a1017b20",
    "quick-v1": "4f2c15b4ce4d1f34",
    "robust-v1": "150443b2ae8b4b61",
    "session-v1": "4a4ef7445f44c76b",
    "standard-v1": "ffc0dd46fab2d9c8",
}

DRAWN = {
    "agree-v1": 25,
    "ball-v1": 25,
    "intent-v1": 25,
    "quick-v1": 3,
    "robust-v1": 40,
    "session-v1": 40,
    "standard-v1": 75,
}
"""Number of people of each suite of drawn people."""


def people(name):
    """Return the people of a suite, by scenario."""
    return [scenario.subject for scenario in make_suite(name).scenarios]


def test_every_suite_is_frozen():
    assert {name: make_suite(name).digest for name in own_entries(SUITES)} == FROZEN


@pytest.mark.parametrize(("name", "count"), DRAWN.items())
def test_each_of_many_distinct_people_plays_every_behaviour_once_or_a_session(name, count):
    suite = make_suite(name)
    behaviours = {each.behaviour for each in suite.scenarios}
    assert suite.seeds == tuple(range(suite.session or 1))
    assert suite.size == count * len(behaviours) * len(suite.seeds)
    assert len({*people(name)}) == count
    played = {(each.behaviour, each.subject.name) for each in suite.scenarios}
    names = {each.name for each in people(name)}
    assert played == {*itertools.product(behaviours, names)}


@pytest.mark.parametrize("name", DRAWN)
def test_people_are_drawn_by_their_names_and_none_is_placed_by_hand(name):
    for each in people(name):
        assert each == Subject.draw(int(each.name.removeprefix("draw-")))
    assert {*people(name)}.isdisjoint(SUBJECTS.values())


def test_no_two_suites_share_a_person():
    shared = [{*people(one)} & {*people(other)} for one, other in itertools.combinations(DRAWN, 2)]
    assert not any(shared)


def test_nobody_learns_from_a_person_of_a_suite():
    learned = {
        *TRAINING_SEEDS,
        *range(EXPORTED, EXPORTED + MOST_LIFTS),
        *range(DEMONSTRATED, DEMONSTRATED + LIFTS),
        *range(TUNING_SEED, TUNING_SEED + TUNING_LIFTS),
    }
    assert learned <= {*ranges.LEARNING_PEOPLE}
    new = {scenario.subject.name for scenario in held_out_suite(3, 1).scenarios}
    for suite in DRAWN:
        names = {each.name for each in people(suite)}
        assert names.isdisjoint(f"draw-{seed}" for seed in learned)
        assert names.isdisjoint(new)


def test_a_suite_of_people_to_learn_from_is_refused():
    with pytest.raises(InputError, match="'mine' has draw-60000: numbers 60000 to 199999 are"):
        people_suite("mine", "level", ("smooth",), range(59_999, 60_002))


def test_no_two_ranges_overlap_but_the_parts_of_those_who_are_learned_from():
    known = {name: people for name, people in vars(ranges).items() if isinstance(people, range)}
    parts = {"DEMONSTRATING_PEOPLE", "PRACTISING_PEOPLE", "TRAINING_PEOPLE"}
    assert {*known.pop("LEARNING_PEOPLE")} == {each for name in parts for each in known[name]}
    for one, other in itertools.combinations(known.values(), 2):
        assert {*one}.isdisjoint(other)
    assert max(map(max, known.values())) < ranges.FIRST_NEW_PERSON
