"""The score table and the means of strata against plain sums over the lifts."""

import math

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.episode.metric import LEADING, on_boards
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.strata import (
    StratumScore,
    human_human_mean,
    mean_of_strata,
    spread_over_people,
    stratum_scores,
)
from colift.benchmark.statistics import (
    geometric_ratio,
    mean_of,
    paired_difference,
    probability_better,
)
from colift.benchmark.suites.suite import make_suite


@pytest.fixture(scope="module")
def suite():
    return make_suite("quick-v1")


@pytest.fixture(scope="module")
def copy(suite):
    return run_suite(PolicySpec(text="copy"), suite)


@pytest.fixture(scope="module")
def scores(copy):
    return ScoreTable.of(copy)


@pytest.fixture(scope="module")
def hold(suite):
    return ScoreTable.of(run_suite(PolicySpec(text="hold"), suite))


def test_it_has_every_metric_of_every_lift(suite, copy, scores):
    assert list(scores.values) == list(suite.metrics)
    for name, values in scores.values.items():
        assert values == pytest.approx([e.scores[name] for e in copy.episodes], nan_ok=True)
    assert scores.means == {
        metric.name: scores.metric(metric.name).mean for metric in on_boards(suite.metrics)
    }


def test_a_lift_without_a_value_counts_as_missing_and_not_in_the_mean(suite, hold):
    assert math.isnan(hold.values["sparc"][0])
    assert hold.metric("sparc").missing == suite.size
    assert hold.metric("sparc").mean is None
    assert hold.estimate("sparc") is None
    half = ScoreTable(
        strata=(("smooth", "S1"),) * 4, values={"sparc": (-1.0, math.nan, -3.0, math.nan)}
    )
    assert half.metric("sparc").missing == 2
    assert half.estimate("sparc").mean == half.metric("sparc").mean == -2.0


def same(one, other):
    """Return whether two tables have the same lifts and numbers, missing ones too."""
    return (
        one.strata == other.strata
        and one.failures == other.failures
        and list(one.values) == list(other.values)
        and all(
            np.array_equal(one.values[name], other.values[name], equal_nan=True)
            for name in one.values
        )
    )


def test_parts_have_their_own_lifts_in_order(copy, scores):
    (behaviour, subject), *_ = scores.strata
    mine = [e for e in copy.episodes if (e.behaviour, e.subject) == (behaviour, subject)]
    part = scores.part(behaviour, subject)
    assert list(part.rmse_mm) == [e.scores[LEADING] for e in mine]
    assert same(part, scores.by_stratum[behaviour, subject])
    assert sum(len(each.strata) for each in scores.by_stratum.values()) == len(copy.episodes)
    assert same(scores.part(), scores)


def test_against_another_agent_lifts_are_paired(scores, hold):
    mine, other = np.array(scores.rmse_mm), np.array(hold.rmse_mm)
    found = scores.against(hold)
    assert found.ratio == geometric_ratio(mine, other, scores.units)
    assert found.difference == paired_difference(mine, other, scores.units)
    assert found.tested(0.25).p == 0.25
    assert found.probability == probability_better(np.log(mine), np.log(other), scores.units)
    assert scores.error == scores.estimate(LEADING) == mean_of(mine, scores.units)


def test_the_probability_agrees_with_the_interval_of_the_ratio(scores, hold):
    found = hold.against(scores)
    assert found.ratio.ci95[0] > 1.0
    assert found.probability < 0.025


def test_a_recording_is_a_unit_of_its_own_and_not_its_body():
    """Two named people with three lifts each, in the bodies of S1 to S5 in turn."""
    from colift.agents.humans import Recorded, Recording
    from colift.benchmark.episode.scenario import Scenario
    from colift.benchmark.suites.catalogue import make_subject, make_task

    def scenario(trial, person, body):
        recording = Recording(
            name=trial, times=(0.0, 1.0, 2.0), heights=(0.0, 0.2, 0.0), person=person
        )
        return Scenario(
            behaviour="recorded",
            human=Recorded(recording=recording),
            trial=trial,
            subject=make_subject(body),
            task=make_task("level"),
        )

    assert scenario("one", "Ada", "S1").person == scenario("two", "Ada", "S2").person == "Ada"
    assert scenario("one", "", "S1").person == "one"


def test_people_are_stored_where_they_are_not_the_subjects():
    table = ScoreTable(
        strata=(("recorded", "S1"), ("recorded", "S2"), ("recorded", "S3")),
        people=("Ada", "Ada", "Grace"),
        values={LEADING: (1.0, 2.0, 4.0)},
    )
    stored = ScoreTable.read(table.plain())
    assert stored.people == table.people
    assert stored.units.count == table.select([0, 1, 2]).units.count == 2
    with pytest.raises(ValueError, match="2 people for 3 lifts"):
        ScoreTable.read({**table.plain(), "people": ["Ada", "Grace"]})


def test_a_stored_table_has_the_errors_and_the_means(scores, suite):
    stored = ScoreTable.read(scores.plain())
    assert stored.rmse_mm == scores.rmse_mm
    assert (stored.strata, stored.means, stored.error) == (
        scores.strata,
        scores.means,
        scores.error,
    )
    assert stored.plain() == scores.plain()
    assert same(stored, scores.stored())
    assert stored.means == scores.stored().means


def test_failed_lifts_are_counted(scores):
    failures = tuple("step 3: oops" if i % 2 else None for i in range(len(scores.strata)))
    failing = ScoreTable(strata=scores.strata, values=scores.values, failures=failures)
    assert failing.failed == len(failures) // 2
    assert failing.select([1, 2]).failures == ("step 3: oops", None)


def test_the_spread_is_over_the_means_of_each_person(scores, hold):
    strata = stratum_scores(scores, hold)
    means = {name: scores.part(subject=name).mean for _, name in scores.strata}
    spread = spread_over_people(strata)
    assert spread.people == len(means) == 3
    assert (spread.best, spread.median, spread.worst) == pytest.approx(sorted(means.values()))
    assert spread.lower == pytest.approx((spread.best + spread.median) / 2)
    assert means[spread.worst_person] == pytest.approx(spread.worst)
    assert spread.better == 3  # Holding still is worse with everyone.
    assert spread_over_people(stratum_scores(scores, None)).better is None


def test_means_over_strata_are_those_over_their_lifts(scores, hold):
    strata = stratum_scores(scores, hold)
    assert mean_of_strata(strata).mean == pytest.approx(scores.mean)
    assert human_human_mean(strata) == pytest.approx(hold.mean)
    for name in scores.values:
        assert mean_of_strata(strata, name).missing == scores.metric(name).missing
        assert mean_of_strata(strata, name).mean == pytest.approx(scores.metric(name).mean)
    jerky = [each for each in strata if each.behaviour == "jerky"]
    assert mean_of_strata(jerky).mean == pytest.approx(scores.part("jerky").mean)
    assert mean_of_strata(()).mean is human_human_mean(()) is None
    assert human_human_mean((*strata, *stratum_scores(scores, None))) is None


def test_a_group_of_a_bundle_is_read_as_it_was_written(scores, hold):
    for each in stratum_scores(scores, hold):
        assert StratumScore.read(each.plain(), each.metrics) == each
