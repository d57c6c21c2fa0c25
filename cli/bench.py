"""``colift bench``: how fast the benchmark is, how fine its physics, how fast the policies."""

import json
from typing import Annotated, Final

import typer
from rich import box
from rich.console import Console
from rich.table import Table

from ..agents.errors import InputError
from ..agents.policies.loading import PolicySpec
from ..agents.registry import POLICIES, entries
from ..benchmark.convergence import REFERENCE, study
from ..benchmark.executors import process_pool
from ..benchmark.policy_speed import LIMIT_MS, StepTime, default_scenarios, step_time
from ..benchmark.speed import endurance, single_process, two_workers_ratio
from .bench_isolation import print_isolation
from .bench_scale import print_scale
from .progress import progress_bar

MEANING: Final = {
    "sim_speed": "simulated seconds per wall second, one process",
    "engine_ratio": "share of an episode's wall time inside the physics engine (at least 0.8)",
    "naive_nao_ratio": "speed over the whole NAO as loaded, stepped at 240 Hz (at least 20)",
    "reset_share": "share of an episode's wall time spent on its reset (at most 0.02)",
    "two_workers_ratio": "throughput of two workers over one (at least 1.7)",
    "memory_growth_mb": "growth of the process after the first hundred episodes",
    "late_over_early": "time of the last episodes over that of the first (1 = linear cost)",
}


def bench(
    episodes: Annotated[
        int, typer.Option(metavar="N", help="Episodes of the endurance run, at least 200.")
    ] = 1000,
    convergence: Annotated[
        bool, typer.Option("--convergence", help="Print the convergence study instead.")
    ] = False,
    policies: Annotated[
        bool, typer.Option("--policies", help="Time a step of every registered policy instead.")
    ] = False,
    isolation: Annotated[
        bool, typer.Option("--isolation", help="Time what each sandbox costs instead.")
    ] = False,
    scale: Annotated[
        bool, typer.Option("--scale", help="Time a Dask cluster and verification instead.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON alone.")] = False,
) -> None:
    """Measure the benchmark itself: speed as ratios within this run, memory, convergence."""
    studies = {
        "--convergence": convergence,
        "--policies": policies,
        "--isolation": isolation,
        "--scale": scale,
    }
    chosen = [name for name, wanted in studies.items() if wanted]
    if len(chosen) > 1:
        raise InputError(f"{' and '.join(chosen)} exclude each other: name one")
    if convergence:
        _convergence(as_json)
        return
    if policies:
        _policies(as_json)
        return
    if isolation:
        print_isolation(as_json)
        return
    if scale:
        print_scale(as_json)
        return
    if episodes < 200:
        raise InputError(f"--episodes must be at least 200, got {episodes}")
    figures = single_process() | two_workers_ratio(process_pool) | _endurance(episodes)
    if as_json:
        print(json.dumps(figures, indent=2))
        return
    table = Table(title="colift bench", title_justify="left", box=box.SIMPLE_HEAD)
    table.add_column("figure")
    table.add_column("value", justify="right")
    table.add_column("meaning")
    for name, value in figures.items():
        table.add_row(name, f"{value:.3g}", MEANING[name])
    Console().print(table)


def _endurance(episodes: int) -> dict[str, float]:
    rows = list(endurance(episodes))
    third = max(1, len(rows) // 3)
    early = sum(row["ms_per_episode"] for row in rows[:third])
    late = sum(row["ms_per_episode"] for row in rows[-third:])
    return {
        "memory_growth_mb": rows[-1]["memory_mb"] - rows[0]["memory_mb"],
        "late_over_early": late / early,
    }


def _policies(as_json: bool) -> None:
    """Print what a step of each policy takes, and which are over the limit."""
    scenarios, names = default_scenarios(), list(entries(POLICIES))
    found: dict[str, StepTime | None] = {}
    with progress_bar("bench", len(names)) as progress:
        for name in names:
            found[name] = step_time(PolicySpec(text=name), scenarios)
            progress(1)
    if as_json:
        content = {
            "limit_ms": LIMIT_MS,
            "policies": {
                name: None
                if taken is None
                else {
                    "steps": taken.steps,
                    "median_ms": taken.median_ms,
                    "p99_ms": taken.p99_ms,
                    "within_limit": taken.within_limit,
                }
                for name, taken in found.items()
            },
        }
        print(json.dumps(content, indent=2))
        return
    table = Table(
        title="time of a step",
        caption=f"limit: 99th percentile at most {LIMIT_MS:g} ms",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("policy")
    for heading in ("median ms", "p99 ms", "steps", "limit"):
        table.add_column(heading, justify="right", no_wrap=True)
    for name, taken in found.items():
        if taken is None:
            table.add_row(name, "none", "none", "0", "fails")
        else:
            kept = "kept" if taken.within_limit else "exceeded"
            cells = (f"{taken.median_ms:.3f}", f"{taken.p99_ms:.3f}", str(taken.steps), kept)
            table.add_row(name, *cells)
    Console().print(table)


def _convergence(as_json: bool) -> None:
    """Print the study, as a table that can be pasted into the docs."""
    rows = list(study())
    if as_json:
        content = [
            {
                "policy": row.policy,
                "step_s": row.physics.step,
                "iterations": row.physics.iterations,
                "mean_rmse_error": row.mean_error,
                "worst_rmse_error": row.rmse_error,
                "height_error_mm": row.height_error_mm,
            }
            for row in rows
        ]
        print(json.dumps(content, indent=2))
        return
    print(f"Against {1000 * REFERENCE.step} ms steps with {REFERENCE.iterations} iterations:\n")
    print("| policy | step ms | iterations | mean RMSE error | worst RMSE error | heights mm |")
    print("|---|---|---|---|---|---|")
    for row in rows:
        print(
            f"| {row.policy} | {1000 * row.physics.step:g} | {row.physics.iterations} "
            f"| {100 * row.mean_error:.2f} % | {100 * row.rmse_error:.2f} % "
            f"| {row.height_error_mm:.2f} |"
        )
