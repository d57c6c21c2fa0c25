"""Tests of admission as tables for a terminal."""

from colift.benchmark.admission.assessment import Admission
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.tables.printing import left, table
from rich.table import Column, Table


def means_table(found: Admission) -> Table:
    """Return the mean errors of everybody, the best first."""
    means = sorted(found.means.items(), key=lambda each: each[1])
    rows = ((name, f"{mean:.2f}") for name, mean in means)
    title = f"Mean RMSE on {found.suite}, mm"
    # With an error of two digits beside it, the column is as wide as the title, which would fold.
    return table(title, (Column("who", min_width=len(title) - 8), "all"), rows)


def criteria_table(found: Admission) -> Table:
    """Return the criteria, with the control beside them."""
    control = found.control
    columns: list[str | Column] = [
        "",
        Column("criterion", min_width=24),
        left("figure [95 %]"),
        left("must be"),
        left("result"),
    ]
    if control is not None:
        columns += [left(control.suite), left("its result")]
    rows = (
        (
            *_row(each),
            *(() if control is None else (_figure(beside), _verdict(beside))),
        )
        for each, beside in zip(found.criteria, (control or found).criteria, strict=True)
    )
    return table(f"Admission of {found.suite}", tuple(columns), rows)


def _row(each: Criterion) -> tuple[str, ...]:
    return each.letter, each.what, _figure(each), each.bar, _verdict(each)


def _verdict(each: Criterion) -> str:
    return each.verdict.upper() if each.verdict == "failed" else each.verdict


def _figure(each: Criterion) -> str:
    if each.figure is None or each.ci95 is None:
        return "none"
    return f"{each.figure:.2f} [{each.ci95[0]:.2f}, {each.ci95[1]:.2f}]"


def admission_words(found: Admission) -> str:
    """Return what is behind the figures, and what a verdict hangs on."""
    lines = [f"{each.letter}: {each.detail}" for each in found.criteria]
    lines += [f"{e.letter} is undecided: {e.doubt}" for e in found.criteria if e.doubt]
    if found.control is not None:
        fate = "passes, so that the test rejects nothing" if found.control.passed else "fails"
        lines.append(f"control: {found.control.suite} {fate}")
    claims = found.claims.items()
    lines += [f"{claim}: {'holds' if holds else 'NOT SHOWN'}" for claim, holds in claims]
    return "\n".join(lines)
