"""``colift run``: evaluate a policy on a suite."""

import json
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from ..agents.errors import InputError
from ..agents.policies.loading import PolicySpec
from ..benchmark.bundle import check_target, results, write_bundle
from ..benchmark.references import SPECS, Reference, play_references, shipped_references
from ..benchmark.runner import Run, run_suite
from ..benchmark.suite import Suite, make_suite, recorded_suite
from .pool import default_jobs, local_pool
from .progress import progress_bar
from .seeds import seed_range
from .tables import results_table, standing


def run(
    policy: Annotated[
        str, typer.Argument(help="A name of 'colift list', module:Class or file.py:Class.")
    ],
    suite: Annotated[str, typer.Option(help="Scenario suite.")] = "standard-v1",
    seeds: Annotated[
        str | None, typer.Option(metavar="A:B", help="Seeds A to B-1 instead of the suite's.")
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option(metavar="CSV", help="Recorded lifts (trial,t_s,z_m) instead of a suite."),
    ] = None,
    latency: Annotated[
        float | None,
        typer.Option(metavar="S", help="Age of the robot's data, in seconds."),
    ] = None,
    control_period: Annotated[
        float | None, typer.Option(metavar="S", help="Time between two decisions, in seconds.")
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="N", help="Worker processes; default: all cores.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Where to write the result bundle.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print results.json alone, and nothing else.")
    ] = False,
) -> None:
    """Evaluate a policy on a scenario suite and print where it stands."""
    episodes = _suite(suite, seeds, recordings).with_timing(latency, control_period)
    spec = PolicySpec(text=policy)
    spec.load()
    if out is not None:
        check_target(out)
    done, references = _evaluate(spec, episodes, default_jobs() if jobs is None else jobs)
    if not done.episodes:
        print("interrupted before the first episode was finished", file=sys.stderr)
        raise typer.Exit(1)
    content = results(done, references)
    if out is not None:
        write_bundle(out, done, content)
    if as_json:
        print(json.dumps(content, indent=2, allow_nan=False))
    else:
        console = Console()
        console.print(results_table(content))
        console.print(standing(content), highlight=False)
        if out is not None:
            console.print(f"Result bundle: {out}", highlight=False, soft_wrap=True)
    if _complaints(done):
        raise typer.Exit(1)


def _suite(name: str, seeds: str | None, recordings: Path | None) -> Suite:
    """Return the episodes that the options ask for."""
    if recordings is not None:
        if seeds is not None:
            raise InputError("--seeds and --recordings exclude each other: a recording has no seed")
        return recorded_suite(recordings)
    suite = make_suite(name)
    if seeds is None:
        return suite
    return suite.with_seeds(*seed_range(seeds))


def _evaluate(spec: PolicySpec, suite: Suite, jobs: int) -> tuple[Run, dict[str, Reference]]:
    """Run the policy, then the references on the same episodes, unless they are shipped."""
    shipped = shipped_references(suite)
    total = suite.size * (1 if shipped else 1 + len(SPECS))
    with local_pool(jobs) as pool, progress_bar(spec.name, total) as progress:
        done = run_suite(spec, suite, executor=pool, progress=progress)
        if not done.complete:
            return done, {}
        if shipped is not None:
            return done, shipped
        return done, play_references(suite, executor=pool, progress=progress)


def _complaints(run: Run) -> bool:
    """Say on stderr what went wrong, if anything did."""
    failures = [episode for episode in run.episodes if episode.failure is not None]
    if failures:
        first = failures[0]
        print(
            f"{len(failures)} of {len(run.episodes)} episodes failed and count as worst; "
            f"the first, {first.behaviour}/{first.subject} seed {first.seed}: {first.failure}",
            file=sys.stderr,
        )
    if not run.complete:
        print(
            f"interrupted: partial results of {len(run.episodes)} of {run.suite.size} episodes",
            file=sys.stderr,
        )
    return bool(failures) or not run.complete
