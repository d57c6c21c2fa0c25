"""Curves of sessions: errors in order, the lift of a change, and trust."""

import dataclasses

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, human_human_run
from colift.benchmark.results.curve import SessionCurve, session_curve
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.results_table import results_text
from colift.benchmark.tasks.session.usual import CHANGES, usual_change, usual_lift

WHOLE = make_suite("session-v1")
CHANGED = [each for each in WHOLE.scenarios if usual_change(each.subject)][:2]
STEADY = [each for each in WHOLE.scenarios if not usual_change(each.subject)][:2]
SUITE = dataclasses.replace(WHOLE, name="four", scenarios=(*CHANGED, *STEADY))


@pytest.fixture(scope="module")
def run():
    return run_suite(PolicySpec(text="recall"), SUITE)


@pytest.fixture(scope="module")
def played(run):
    return results(run, {HUMAN_HUMAN: ScoreTable.of(human_human_run(SUITE))})


def errors(content):
    return np.reshape([each.rmse_mm for each in content], (-1, 10))


def test_the_place_of_a_change_is_where_the_habits_differ():
    for scenario in WHOLE.scenarios:
        place = usual_change(scenario.subject)
        habits = [usual_lift(scenario.subject, each) for each in range(10)]
        if place is None:
            assert len({*habits}) == 1
            continue
        assert place in CHANGES
        assert {*habits[:place]} == {habits[0]}
        assert {*habits[place:]} == {habits[-1]}
        assert habits[0] != habits[-1]
    some = sum(usual_change(each.subject) is not None for each in WHOLE.scenarios)
    assert 15 <= some <= 33


def test_a_curve_has_the_errors_in_order_and_what_a_change_costs(run):
    scores = ScoreTable.of(run)
    curve = session_curve(run, scores, None)
    table = np.reshape(scores.lifts_mm, (4, 10))
    assert [each.mean for each in curve.rmse_mm] == pytest.approx(table.mean(0).tolist())
    assert curve.whole == pytest.approx(table.mean())
    rises = [
        row[usual_change(each.subject)] - row[usual_change(each.subject) - 1]
        for each, row in zip(CHANGED, table[:2], strict=True)
    ]
    assert curve.change_mm.mean == pytest.approx(np.mean(rises))
    assert all(0 < each.mean < 1 for each in curve.trust)
    assert SessionCurve.read(curve.plain()) == curve


def test_a_curve_without_a_change_or_with_a_lift_missing():
    steady = dataclasses.replace(SUITE, scenarios=tuple(STEADY))
    run = run_suite(PolicySpec(text="copy"), steady)
    curve = session_curve(run, ScoreTable.of(run), None)
    assert curve.change_mm is None
    part = dataclasses.replace(run, episodes=run.episodes[1:])
    assert session_curve(part, ScoreTable.of(part), None) is None


def test_the_rate_is_that_of_the_logarithm():
    curve = SessionCurve(
        counted=1,
        rmse_mm=tuple(_exact(8.0 * 0.9**i) for i in range(6)),
        human_human_rmse_mm=None,
        change_mm=None,
        trust=(),
    )
    assert np.exp(curve.rate) == pytest.approx(0.9)
    assert curve.learned == f"-10 % from lift to lift; {curve.whole:.1f} mm over all"


def test_the_curve_of_one_lift_has_no_rate():
    suite = dataclasses.replace(SUITE, seeds=(0,))
    run = run_suite(PolicySpec(text="copy"), suite)
    curve = session_curve(run, ScoreTable.of(run), None)
    assert len(curve.rmse_mm) == 1
    assert curve.learned.startswith(f"{curve.whole:.1f} mm over all")


def test_results_tell_the_curve_and_keep_it(played):
    told = results_text(played, SUITE.metrics)
    assert "RMSE mm, lift by lift: " in told
    assert "two people: " in told
    assert "when a habit changes; people's trust at the end 0." in told
    assert played.plain()["session"] == played.session.plain()


def _exact(mean):
    return SessionCurve.read(
        {
            "counted": 1,
            "rmse_mm": [{"mean": mean, "ci95": None}],
            "human_human_rmse_mm": None,
            "change_mm": None,
            "trust": [],
        }
    ).rmse_mm[0]
