"""``colift references``, ``ablate`` and ``sweep``: the best policies on drawn subjects."""

from pathlib import Path
from typing import Annotated

import typer
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.comparison.compare import compare
from colift.benchmark.comparison.formatting import between
from colift.benchmark.comparison.playing import episodes_to_play, play_policies
from colift.benchmark.comparison.tables import behaviours_table, ranks_table
from colift.benchmark.execution.progress import workers
from colift.benchmark.references import ablation, sweep
from colift.benchmark.references.ablation import VARIANTS, Ablation, variants
from colift.benchmark.references.catalogue import suite_references
from colift.benchmark.references.claims import POLICY, RIVALS, PolicyClaim, claims
from colift.benchmark.references.held_out import FIRST_SEED, held_out_suite
from colift.benchmark.references.sweep import NAMES, Swept, human_human_rmse, lifts_to_play, timings
from colift.benchmark.rendering.layout import PAGE
from colift.benchmark.results.baselines import HUMAN_HUMAN_LABEL
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite, recorded_suite
from colift.benchmark.tables.printing import show, table
from colift.benchmark.training.anticipation import LIFTS, ROUNDS, learn_anticipation
from colift.cli.options import (
    Jobs,
    LayoutName,
    check_figure,
    check_new_file,
    chosen_layout,
    report_notes,
)
from colift.cli.remedies import naming
from colift.cli.tables.recordings import show_recordings
from rich.table import Table

People = Annotated[int, typer.Option(metavar="N", help="Number of drawn subjects.", min=1)]
LiftsEach = Annotated[
    int, typer.Option("--each", metavar="N", help="Lifts per subject and behaviour.", min=1)
]
LearningLifts = Annotated[
    int, typer.Option("--lifts", metavar="N", help="Lifts per round of learning.", min=1)
]
RecordedLifts = Annotated[
    Path | None,
    typer.Option(
        "--recordings",
        metavar="CSV",
        help="Recorded human motion (columns trial,t_s,z_m) instead of drawn subjects.",
    ),
]


def references(
    people: People = 20,
    each: LiftsEach = 5,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the first lift.")] = FIRST_SEED,
    recordings: RecordedLifts = None,
    jobs: Jobs = None,
) -> None:
    """Compare the best policies with the references on drawn subjects, and test their claims.

    Example: colift references --people 4 --each 1
    """
    suite = held_out_suite(people, each, seed) if recordings is None else _recorded(recordings)
    specs = {name: PolicySpec(text=name) for name in (POLICY, *RIVALS)}
    beside = suite_references(suite)
    total = episodes_to_play(len(specs), suite, references=len(beside))
    with workers("references", total, jobs) as (pool, progress):
        show_recordings(suite)
        results = play_policies(specs, suite, references=beside, executor=pool, progress=progress)
    comparison = compare(results)
    show(ranks_table(comparison))
    if recordings is None:
        show(behaviours_table(comparison))
    found = claims(results)
    show(_claims_table(found))
    if not all(claim.holds for claim in found):
        raise typer.Exit(1)


def _recorded(recordings: Path) -> Suite:
    report_notes(recordings)
    return recorded_suite(recordings)


def _claims_table(found: tuple[PolicyClaim, ...]) -> Table:
    return table(
        f"Claims of {POLICY}",
        ("what", "value", "95 %", "limit", "holds"),
        (
            (
                claim.text,
                f"{claim.value:.3f}",
                "" if claim.ci95 is None else f"{claim.ci95[0]:.3f} to {claim.ci95[1]:.3f}",
                f"{'at least' if claim.least else 'at most'} {claim.limit:g}"
                f"{', or chance' if claim.chance else ''}",
                "yes" if claim.holds else "NO",
            )
            for claim in found
        ),
    )


def ablate_policies(
    lifts: LearningLifts = LIFTS,
    people: People = 20,
    each: LiftsEach = 3,
    recordings: Annotated[
        Path | None,
        typer.Option(
            metavar="CSV",
            help="Recorded human motion (columns trial,t_s,z_m) to measure as well.",
        ),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Measure the error of anticipate without each of its parts, on drawn subjects.

    Example: colift ablate --people 4 --each 1
    """
    suites = [held_out_suite(people, each)]
    if recordings is not None:
        suites.append(_recorded(recordings))
    total = ROUNDS * lifts + (1 + len(VARIANTS)) * sum(suite.size for suite in suites)
    with workers("ablation", total, jobs) as (pool, progress):
        for suite in suites:
            show_recordings(suite)
        first, *_, last = learn_anticipation(lifts=lifts, executor=pool, progress=progress)
        robots = tuple(variants(first, last))
        found = [
            ablation.ablate(robots, suite, executor=pool, progress=progress) for suite in suites
        ]
    for suite, rows in zip(suites, found, strict=True):
        show(_ablation_table(rows, suite.name))


def _ablation_table(found: list[Ablation], suite: str) -> Table:
    return table(
        f"Without each part, on {suite}",
        ("without", "RMSE mm", "more by, 95 %", "SPARC", "rougher by, 95 %"),
        (
            (
                each.name,
                f"{each.rmse_mm:.2f}",
                _difference(each.worse_mm),
                f"{each.sparc:.3f}",
                _difference(each.rougher, 3),
            )
            for each in found
        ),
        caption="SPARC: closer to 0 is smoother. In brackets the 95 % interval of the paired "
        "difference to the complete policy.",
    )


def _difference(difference: Estimate | None, digits: int = 2) -> str:
    if difference is None:
        return ""
    interval = between(difference.ci95, f"+.{digits}f")
    return f"{difference.mean:+.{digits}f}" + (f" ({interval})" if interval else "")


def sweep_rates(
    lifts: LearningLifts = 400,
    people: People = 8,
    each: LiftsEach = 2,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Figure (.png, .svg, .pdf); its numbers go to a .json file beside it.",
        ),
    ] = None,
    layout: LayoutName = PAGE.name,
    jobs: Jobs = None,
) -> None:
    """Measure the best policies at other latencies and control periods, on drawn subjects.

    Example: colift sweep --people 4 --each 1 --out sweep.png
    """
    check_figure(out)
    size = chosen_layout(layout)
    if out is not None:
        with naming("--out", hint="the numbers go to a .json file beside the picture"):
            check_new_file(out.with_suffix(".json"))
    suite = held_out_suite(people, each)
    with workers("sweep", lifts_to_play(suite, lifts), jobs) as (pool, progress):
        human_human = human_human_rmse(suite, executor=pool, progress=progress)
        swept = list(sweep.sweep(suite, lifts=lifts, executor=pool, progress=progress))
    show(_sweep_table(swept, human_human, suite.name))
    if out is not None:
        # matplotlib is slow to load.
        from colift.benchmark.references.sweep_figure import sweep_figure, sweep_json
        from colift.benchmark.rendering.figures import drawn_for, write_figure

        with drawn_for(size):
            figure = sweep_figure(swept, human_human, size)
        write_figure(out, figure, "What a fresher or a faster robot gains")
        out.with_suffix(".json").write_text(sweep_json(swept, human_human))
        print(f"written: {out}")


def _sweep_table(swept: list[Swept], human_human: float, suite: str) -> Table:
    rows = []
    for timing in timings():
        latency, period = timing.latency, timing.control_period
        found = {
            each.policy: each.rmse_mm
            for each in swept
            if (each.latency, each.control_period) == (latency, period)
        }
        row = (f"{1000 * latency:.0f}", f"{1000 * period:.0f}")
        rows.append((*row, *(f"{found[name]:.2f}" for name in NAMES)))
    return table(
        f"RMSE mm on {suite}",
        ("latency ms", "period ms", *NAMES),
        rows,
        caption=f"{HUMAN_HUMAN_LABEL}: {human_human:.2f} mm",
    )
