"""The claims of scores of which the answer is known."""

import numpy as np
import pytest
from colift.benchmark.comparison.paired_results import PairedResults, PolicyResults
from colift.benchmark.references.claims import PolicyClaim, claims
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import StepTimes
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import BEHAVIOURS, LEVEL

CELLS = tuple(
    (behaviour, subject) for behaviour in BEHAVIOURS for subject in "AB" for _ in range(4)
)


def policy_results(name, rmse, sparc=-2.0, force=0.1, strata=CELLS):
    errors = np.broadcast_to(rmse, len(strata))
    given = {"rmse_mm": errors, "sparc": sparc, "human_force_n": force}
    values = {
        metric: tuple(np.broadcast_to(given.get(metric, 0.0), len(strata)).tolist())
        for metric in LEVEL.metrics
    }
    return PolicyResults(
        name=name,
        digest="",
        scores=ScoreTable(strata=strata, values=values, failures=(None,) * len(strata)),
        step_ms=StepTimes(),
    )


def baseline(rmse, strata):
    return ScoreTable(
        strata=strata,
        values={"rmse_mm": (rmse,) * len(strata)},
        means={"sparc": -2.5, "human_force_n": 0.4},
    )


def paired(
    mine,
    *,
    reference=4.0,
    anticipate=5.0,
    blend=16.0,
    human_human=8.0,
    sparc=-2.0,
    force=0.1,
    strata=CELLS,
    references=("best_known",),
):
    return PairedResults(
        suite=make_suite("quick-v1"),
        policies=(
            policy_results("learned", mine, sparc, force, strata),
            policy_results("anticipate", anticipate, sparc, 0.2, strata),
            policy_results("blend", blend, -2.3, 0.2, strata),
            policy_results("reactive", 20.0, -2.9, 0.3, strata),
        ),
        references={name: baseline(reference, strata) for name in references},
        human_human=baseline(human_human, strata),
    )


def told(found):
    return {claim.text: claim for claim in found}


def test_ratios_are_geometric_means_on_each_behaviour():
    mine = np.where([behaviour == "jerky" for behaviour, _ in CELLS], 9.6, 4.16)
    found = told(claims(paired(mine)))
    human_human = found["RMSE over that of two people, jerky"]
    assert (human_human.value, human_human.holds) == (pytest.approx(1.2), False)
    assert found["RMSE over that of two people, smooth"].value == pytest.approx(0.52)
    mean = (4.16**3 * 9.6) ** 0.25
    assert found["RMSE over that of two people, over all"].value == pytest.approx(mean / 8)
    reference = found["RMSE over that of the best known policy, pause"]
    assert (reference.value, reference.holds) == (pytest.approx(1.04), True)
    assert not found["RMSE over that of the best known policy, jerky"].holds
    over_all = found["RMSE over that of the best known policy, over all"]
    assert (over_all.value, over_all.holds) == (pytest.approx(mean / 4), False)
    assert found["RMSE over that of blend, smooth"].value == pytest.approx(4.16 / 16)
    assert "RMSE over that of blend, pause" not in found
    anticipate = found["RMSE over that of anticipate, over all"]
    assert (anticipate.value, anticipate.holds) == (pytest.approx(mean / 5), mean <= 5)


def test_smoother_and_gentler_are_paired_differences():
    found = told(claims(paired(4.0, sparc=-2.5, force=0.25)))
    smooth = found["SPARC minus that of blend, paired"]
    assert (smooth.value, smooth.holds) == (pytest.approx(-0.2), False)
    assert found["SPARC minus that of reactive, paired"].holds
    force = found["rms force at the human's hands minus that with blend [N], paired"]
    assert (force.value, force.holds) == (pytest.approx(0.05), False)
    assert "rms force at the human's hands minus that with anticipate [N], paired" in found


def test_recorded_lifts_are_set_against_blend_alone():
    strata = tuple(("recorded", subject) for subject in "AB" for _ in range(25))
    mine = np.full(50, 4.0)
    mine[:2] = 17.0
    found = told(claims(paired(mine, strata=strata, references=())))
    assert found["RMSE over that of blend, recorded"].value == pytest.approx(
        np.exp(np.log(mine).mean()) / 16
    )
    wins = found["share of the recorded lifts more level than with blend"]
    assert (wins.value, wins.holds) == (pytest.approx(0.96), False)
    assert not any("two people" in text or "best known" in text for text in found)


@pytest.mark.parametrize(
    ("ends", "least", "holds"),
    [
        ((-0.10, 0.09), True, True),
        ((-0.10, -0.01), True, False),
        ((-0.02, 0.04), False, True),
        ((0.01, 0.04), False, False),
    ],
)
def test_a_difference_that_may_be_chance_is_no_objection(ends, least, holds):
    claim = PolicyClaim(
        text="it", value=sum(ends) / 2, ci95=ends, limit=0.0, least=least, chance=True
    )
    assert claim.holds == holds
