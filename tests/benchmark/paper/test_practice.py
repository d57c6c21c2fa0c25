"""People with practice on the lifts of Table I."""

import dataclasses

from colift.benchmark.paper.practice import PRACTICE, Practising
from colift.benchmark.paper.topics.practice import practice_claims


def people(run):
    return [each.human.known for each in run.suite.scenarios]


def test_practice_teaches_the_robots_lag_and_trust(made):
    for runs in made.evidence.practice.values():
        for known in people(runs.practised):
            assert 0.05 < known.lag < 0.3
            assert known.trust > 0.45
        assert {known.lag for known in people(runs.stranger)} == {0.0}


def test_both_lift_alike_and_neither_goes_on_learning(made):
    for runs in made.evidence.practice.values():
        pairs = zip(runs.stranger.episodes, runs.practised.episodes, strict=True)
        assert all(one.trace.target.max() == two.trace.target.max() > 0.05 for one, two in pairs)
        assert runs.stranger.suite.session == 0


def test_the_claim_is_that_practice_lowers_the_error(made):
    reactive, blend = made.evidence.practice.values()
    (claim,) = practice_claims(reactive, blend, made.report.table)
    assert 0.85 < claim.values["ratio_with"] < 1.0
    assert f"after {PRACTICE} lifts" in claim.criterion
    swapped = dataclasses.replace(blend, stranger=blend.practised, practised=blend.stranger)
    assert not practice_claims(reactive, swapped, made.report.table)[0].holds


def test_a_person_who_practises_begins_as_a_stranger():
    person = Practising()
    after = person.after([0.0, 0.01, 0.02, 0.03], [0.0, 0.0, 0.01, 0.02])
    assert (person.place, after.place) == (0, 1)
    assert person.known.lag == 0.0 < after.known.lag
    assert after.at(4) == dataclasses.replace(after, place=4)
