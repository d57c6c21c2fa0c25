"""``colift pairs``: the coordination of recorded pairs, beside the simulated two people."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from colift.benchmark.execution.progress import workers
from colift.benchmark.pairs.files import check_pairs_folder, pairs_json, write_pairs
from colift.benchmark.pairs.recorded import RecordedPairs, recorded_pairs
from colift.benchmark.pairs.simulated import SimulatedPairs, movements, simulated_pairs
from colift.benchmark.pairs.summary import summarise_pairs
from colift.benchmark.tables.printing import counted, show
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import AsJson, Jobs, report_left_out, report_notes, try_folder
from colift.cli.remedies import naming
from colift.cli.tables.pairs import pairs_table


def pairs(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Recordings of both ends of a table: a CSV file with the columns trial,t_s,z_m "
            "and z_far_m, the height of the other end, or tilt_deg, the table's inclination; "
            "person names the pair.",
        ),
    ],
    length: Annotated[
        float | None,
        typer.Option(
            metavar="METRES",
            help="Distance between the ends: for the tilt in degrees, and for files with tilt_deg "
            "alone.",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder for pairs.json, .csv, .png, .svg and .pdf."),
    ] = None,
    jobs: Jobs = None,
    as_json: AsJson = False,
) -> None:
    """Measure how recorded pairs lift together: RMSE, lag, gain and tilt, with intervals.

    Beside them stand the simulated two people, measured alike on the same movements.

    Example: colift pairs pairs.csv --length 1.05 --out pairs
    """
    if out is not None:
        try_folder("--out", out)
        with naming("--out"):
            check_pairs_folder(out)
    found = recorded_pairs(file, length)
    report_notes(file)
    report_left_out(file.name, dict.fromkeys(found.without, "the other end was not recorded"))
    simulated = _simulated(found, file.name, jobs)
    summary = summarise_pairs(found, file.name, simulated)
    if out is not None:
        write_pairs(out, found, summary)
    if as_json:
        print_json(pairs_json(summary))
    else:
        show(pairs_table(summary))
        if out is not None:
            print(f"Picture: {out / 'pairs.png'}")


def _simulated(found: RecordedPairs, source: str, jobs: int | None) -> SimulatedPairs:
    """Return the measures of the simulated two people; report the lifts that they do not play."""
    real = movements(found.lifts, source)
    with (
        reported_interrupt("pairs are measured on all lifts or not at all"),
        workers("pairs", 0 if real is None else real.suite.size, jobs) as (pool, progress),
    ):
        simulated = simulated_pairs(found.lifts, real, executor=pool, progress=progress)
    if simulated.left_out:
        trial, reason = next(iter(simulated.left_out.items()))
        print(
            f"{source}: {len(simulated.left_out)} of {counted(len(found.lifts), 'lift')} not "
            f"simulated, such as {trial}: {reason}",
            file=sys.stderr,
        )
    return simulated
