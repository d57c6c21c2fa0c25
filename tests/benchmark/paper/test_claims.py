"""Claims: what they hold, and that `holds` follows the numbers."""

import dataclasses
import types

import numpy as np
import pytest
from colift.agents.control.q_learning import ACTIONS
from colift.benchmark.paper.exhibits import Claim
from colift.benchmark.paper.report import median_lift
from colift.benchmark.paper.table_one import single_lifts
from colift.benchmark.paper.topics.learning import learning_claims, levels
from colift.benchmark.paper.topics.table import FEWEST, SURE, table_claims
from colift.benchmark.paper.topics.timing import timing_claims
from colift.benchmark.statistics.permutation import paired_permutation_p
from colift.benchmark.training.q_learning import LearningTrial

RIGHT = np.eye(5)[::-1]
"""The five right actions: the lowest state wants the last action."""


def trial(converged_at, table=RIGHT):
    return LearningTrial(table=table, rewards=np.zeros(100), converged_at=converged_at)


def test_a_claim_that_does_not_hold_always_has_a_note():
    words = {"claim": "a", "figure": "b", "paper": "c", "criterion": "d", "measured": "e"}
    assert Claim(**words, holds=True).note == ""
    assert "outside the criterion" in Claim(**words, holds=False).note


def test_learning_as_in_the_paper_holds():
    assert all(claim.holds for claim in learning_claims([trial(n) for n in (30, 36, 40, 62)] * 5))


def test_learning_that_is_slow_or_never_done_does_not_hold():
    assert not learning_claims([trial(60)] * 20)[0].holds
    median, *_ = learning_claims([trial(36)] * 8 + [trial(None)] * 12)
    assert not median.holds
    assert median.values["median"] is None
    assert "12 trials had not converged" in median.note


def test_the_right_actions_level_any_inclination_and_the_opposite_ones_none():
    assert levels(RIGHT, 0.08)
    assert levels(RIGHT, -0.035)
    assert not levels(RIGHT[::-1], 0.05)
    assert ACTIONS[RIGHT.argmax(axis=1)[0]] == -2


def test_one_cell_too_far_off_breaks_the_table(made):
    table = made.report.table
    row = table.rows[0]
    far = dataclasses.replace(row, blend=dataclasses.replace(row.blend, mean=1.2 * row.blend.paper))
    claim = table_claims(dataclasses.replace(table, rows=(far, *table.rows[1:])))[1]
    assert not claim.holds
    assert f"{row.subject} with 1.200" in claim.note


def test_one_subject_without_a_difference_breaks_the_improvement(made):
    table = made.report.table
    rows = [dataclasses.replace(row, p=0.001) for row in table.rows]
    assert table_claims(dataclasses.replace(table, rows=tuple(rows)))[0].holds
    rows[1] = dataclasses.replace(rows[1], p=0.02)
    assert not table_claims(dataclasses.replace(table, rows=tuple(rows)))[0].holds


@pytest.mark.parametrize("lifts", [2, FEWEST - 1, FEWEST])
def test_lifts_that_are_too_few_for_any_small_p_are_told(made, lifts):
    table = made.report.table
    rows = tuple(dataclasses.replace(row, p=0.02) for row in table.rows)
    note = table_claims(dataclasses.replace(table, rows=rows, lifts=lifts))[0].note
    apart = np.arange(1.0, lifts + 1)
    assert ("can give no p below" in note) == (
        paired_permutation_p(apart, 0 * apart, single_lifts(apart)) >= SURE
    )


def test_timing_claims_tell_one_value_a_period(made):
    for claim in timing_claims(made.evidence):
        assert "50 ms: " in claim.measured
        assert "100 ms: " in claim.measured


@pytest.mark.parametrize(("errors", "index"), [([3.0, 1.0, 2.0], 2), ([4.0, 1.0, 2.0, 3.0], 2)])
def test_the_lift_that_is_shown_has_the_median_error(errors, index):
    episodes = [types.SimpleNamespace(scores={"rmse_mm": e}) for e in errors]
    assert median_lift(episodes) == index
