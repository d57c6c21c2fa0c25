"""A person with practice: a claim about subject 1 (section IV.E)."""

from colift.benchmark.paper.exhibits import Claim
from colift.benchmark.paper.practice import PRACTICE, PracticeRuns
from colift.benchmark.paper.table_one import TableOne
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate, geometric_ratio


def practice_claims(reactive: PracticeRuns, blend: PracticeRuns, table: TableOne) -> list[Claim]:
    """Return the claim that practice lowers the error, with the same lifts.

    Parameters
    ----------
    reactive, blend
        Lifts without and with prediction.
    table
        Table I, whose subject 1 the paper says is practised.
    """
    ratios = {"without": _ratio(reactive), "with": _ratio(blend)}
    first, *others = (row.blend.paper for row in table.rows)
    gap = first / (sum(others) / len(others))
    measured = "; ".join(
        f"{name} prediction {each.mean:.3f} ({each.ends[0]:.3f} to {each.ends[1]:.3f})"
        for name, each in ratios.items()
    )
    return [
        Claim(
            claim="With the same lifts, a person with practice has a lower error.",
            figure="Table I",
            paper="subject 1, who had worked with the system for longer, does best: "
            f"{gap:.2f} times the others' mean with prediction",
            criterion=f"RMSE after {PRACTICE} lifts with the robot, over that of a stranger on the "
            "same lifts: below 1 beyond the 95 % interval, with prediction and without",
            measured=f"ratio {measured}",
            values={f"ratio_{name}": each.mean for name, each in ratios.items()},
            holds=all(each.ends[1] < 1.0 for each in ratios.values()),
            note="The person learns the robot's lag, and trusts and helps it (two-rate learning, "
            "Smith et al. 2006; how much people help is assumed). Table I's subject 1 also has "
            "the lowest lift.",
        )
    ]


def _ratio(runs: PracticeRuns) -> Estimate:
    """Return the error after practice over that before it, geometric mean over lifts."""
    practised, stranger = (ScoreTable.of(each) for each in (runs.practised, runs.stranger))
    return geometric_ratio(practised.rmse_mm, stranger.rmse_mm, stranger.units)
