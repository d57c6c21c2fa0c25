import pytest
from colift.benchmark.validity.report import validity_of
from colift.benchmark.validity.winner import best_shares

from .conftest import MEANS, scores


def judged(suite, means, **options):
    """Return the suite's verdict on people with these means."""
    people = scores(means, name="people", seed=2, **options)
    ((found,),) = (source.suites for source in validity_of([("made", people)], [suite]).sources)
    return found


def test_a_suite_whose_best_policy_is_beaten_is_misleading(suite):
    found = judged(suite, MEANS | {"c": 3.0})
    verdict = found.verdict
    assert verdict.judgement == "misleading"
    assert (verdict.policy, verdict.place) == ("a", 2)
    assert [rival.name for rival in verdict.beaten_by] == ["c"]
    assert verdict.rival.p <= 0.05
    assert verdict.behind_mm.low > 0.0
    assert found.text == (
        "suite is misleading on people: its best policy, a, is beaten by c, 3.00 against 4.00 mm "
        "(c better in 100% of resamples, p < 0.001)."
    )


def test_a_suite_whose_best_policy_wins_is_right(suite):
    found = judged(suite, MEANS)
    verdict = found.verdict
    assert verdict.judgement == "right"
    assert (verdict.place, verdict.beaten_by, verdict.rival.name) == (1, (), "b")
    assert found.text.startswith(
        "suite is right about the best policy on people: a, 4.00 mm; b is next, 5.00 mm (a better"
    )


def test_a_lead_or_a_lag_that_the_lifts_do_not_prove_is_said_to_be_one(suite):
    behind = judged(suite, MEANS | {"c": 3.9}, lifts=8)
    assert (behind.verdict.judgement, behind.verdict.place) == ("doubtful", 2)
    assert behind.verdict.beaten_by == ()
    assert "a, is behind c, 4.00 against 3.90 mm, though 8 lifts do not prove it" in behind.text
    ahead = judged(suite, MEANS | {"c": 4.1, "d": 4.2}, lifts=8)
    assert (ahead.verdict.judgement, ahead.verdict.place) == ("open", 1)
    assert "8 lifts do not separate it from c and 1 more, 4.10 mm (a better in" in ahead.text


def test_equals_do_not_cast_doubt_on_each_other():
    def twins(name, seed):
        made = scores(MEANS, name=name, seed=seed)
        object.__setattr__(made, "errors", {"z": made.errors["a"], **made.errors})
        return made

    people, suite = twins("people", 2), twins("suite", 1)
    object.__setattr__(suite, "errors", dict(reversed(suite.errors.items())))
    object.__setattr__(people, "errors", {name: people.errors[name] for name in suite.errors})
    ((found,),) = (source.suites for source in validity_of([("made", people)], [suite]).sources)
    assert found.verdict.judgement == "open"
    assert "40 lifts do not separate it from" in found.text


def test_two_lifts_prove_nothing(suite):
    assert judged(suite, MEANS | {"c": 1.0}, lifts=2).verdict.judgement == "doubtful"
    assert judged(suite, MEANS, lifts=2).verdict.judgement == "open"


def test_an_order_that_does_not_hold_is_part_of_the_verdict(suite):
    reverse = dict(zip(MEANS, reversed(MEANS.values()), strict=True))
    assert "The order of suite does not hold there" in judged(suite, reverse).text
    level = dict.fromkeys(MEANS, 5.0)
    assert "The order of suite is not shown to hold there" in judged(suite, level).text
    assert "order" not in judged(suite, MEANS).text


def test_policies_on_the_other_side_of_two_people_are_part_of_the_verdict(suite):
    text = judged(suite, MEANS | {"b": 12.0, "c": 13.0, "f": 6.0}).text
    assert text.endswith(
        "More level than two people on suite, less level on people: b and c. "
        "Less level than two people on suite, more level on people: f."
    )


def test_suites_of_the_same_best_policy_share_a_sentence(suite):
    other = scores(MEANS | {"b": 1.0}, name="other")
    same = scores(MEANS, name="same")
    people = scores(MEANS | {"c": 3.0}, name="people", seed=2)
    (source,) = validity_of([("made", people)], [suite, other, same]).sources
    first, second, *_ = source.texts
    assert first.startswith("suite and same are misleading on people: their best policy, a, is")
    assert second.startswith("other is misleading on people: its best policy, b, is")


def test_the_shares_of_the_best_add_up_and_equals_share():
    source = scores(MEANS, name="people", seed=2)
    errors = {"twin": source.errors["a"], **source.errors}
    object.__setattr__(source, "errors", errors)
    shares = best_shares(source)
    assert sum(shares.values()) == pytest.approx(1.0)
    assert shares["a"] == shares["twin"] == pytest.approx(0.5)
    near = best_shares(scores({"a": 4.0, "b": 4.05, "c": 9.0, "d": 9.5}, lifts=10))
    assert 0.5 < near["a"] < 0.8
    assert near["a"] + near["b"] == pytest.approx(1.0)
