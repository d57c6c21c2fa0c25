"""``colift inspect``: the reasons of a score, from the lifts of a result bundle."""

from pathlib import Path
from typing import Annotated, Final

import typer
from colift.base.errors import InputError
from colift.benchmark.execution.pool import local_pool
from colift.benchmark.execution.progress import progress_bar
from colift.benchmark.inspection import WORST
from colift.cli.bundles import mention_others
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import Jobs, check_output, write_output
from colift.cli.remedies import argument

HTML: Final = ".html"


def inspect_bundle(
    bundle: Annotated[
        Path, typer.Argument(metavar="BUNDLE", help="A result bundle of 'colift run --out'.")
    ],
    worst: Annotated[
        int, typer.Option(metavar="N", help="Number of lifts with the largest error to show.")
    ] = WORST,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Page with the same and pictures of these lifts (.html)."
        ),
    ] = None,
    jobs: Jobs = None,
) -> None:
    """Show where a policy is bad: its worst lifts and moments, its strengths and weaknesses.

    Everything is beside two people on the same lifts, who are simulated here: this takes about as
    long as the run itself. The policy is not run, and its numbers are those of the bundle.

    Example: colift inspect mine --out why.html
    """
    if worst < 1:
        raise InputError(f"--worst must be 1 or more, got {worst}")
    if out is not None:
        if out.suffix != HTML:
            raise InputError(f"cannot write {out}: its suffix must be {HTML}")
        check_output(out)
    with reported_interrupt("nothing is shown"):
        _inspect(bundle, worst, out, jobs)


# The engine takes a second to import: not for a help text or a completion.
def _inspect(folder: Path, worst: int, out: Path | None, jobs: int | None) -> None:
    from colift.benchmark.bundle.present import read_results
    from colift.benchmark.inspection.inspection import inspect_run
    from colift.benchmark.inspection.page import inspection_page
    from colift.benchmark.inspection.text import inspection_text
    from colift.benchmark.tables.printing import show

    with local_pool(jobs) as pool:
        with progress_bar("baselines", None) as progress:
            run, results = read_results(folder, executor=pool, progress=progress)
        mention_others(folder)
        with progress_bar("two people", len(run.episodes)) as progress:
            found = inspect_run(
                run, results, worst=worst, folder=folder, executor=pool, progress=progress
            )
    show(*inspection_text(found))
    name, shown = argument(folder), len(found.worst)
    if out is None:
        more = "" if worst == WORST else f" --worst {worst}"
        print(f"Next: colift inspect {name}{more} --out why.html")
    else:
        with progress_bar("drawing", shown) as progress:
            page = inspection_page(found, progress)
        write_output(out, page)
    if any(each.moment is not None for each in found.worst):
        print(f"Next: colift render {name} --worst {shown} --out worst.html")
