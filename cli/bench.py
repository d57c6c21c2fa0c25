"""``colift bench``: speed of the benchmark and the policies, and convergence of the physics."""

import dataclasses
import sys
from collections.abc import Callable, Sequence
from functools import partial
from typing import Annotated, Any, Final

import typer
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.base.registry import playing
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.progress import job_bar, progress_bar
from colift.benchmark.profiling.bars import FIGURES, missed
from colift.benchmark.profiling.cluster import scale as measure_scale
from colift.benchmark.profiling.convergence import USUAL, solver_error, study
from colift.benchmark.profiling.engine import endurance, single_process, two_workers_ratio
from colift.benchmark.profiling.policies import LIMIT_MS, StepTime, default_scenarios, step_time
from colift.benchmark.profiling.remembering import bits_of_time
from colift.benchmark.profiling.sandbox import (
    EPISODE_MS,
    ROUNDS,
    STEP_US,
    IsolationCost,
    isolated,
    isolation_cost,
)
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tables.printing import Cell, left, show, table
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.twin.libraries import device_in_use, require_jax
from colift.benchmark.world.physics import Physics
from colift.cli.completion import suites
from colift.cli.document import print_json
from colift.cli.options import AsJson, Device, check_exclusive
from rich.table import Table

SCALE_POLICY: Final = "blend"
SCALE_SUITE: Final = "standard-v1"
SCALE_ROUNDS: Final = 5

Report = tuple[Any, tuple[Table, ...], list[str]]
"""Figures as JSON and as tables, and the bars that are missed."""


def bench(
    episodes: Annotated[
        int, typer.Option(metavar="N", help="Episodes of the endurance run, at least 200.")
    ] = 1000,
    convergence: Annotated[
        bool, typer.Option("--convergence", help="Print the convergence study instead.")
    ] = False,
    suite: Annotated[
        str,
        typer.Option(metavar="SUITE", help="The suite of --convergence.", autocompletion=suites),
    ] = USUAL,
    policies: Annotated[
        bool, typer.Option("--policies", help="Time a step of every registered policy instead.")
    ] = False,
    isolation: Annotated[
        bool, typer.Option("--isolation", help="Time the cost of each sandbox instead.")
    ] = False,
    scale: Annotated[
        bool, typer.Option("--scale", help="Time a Dask cluster and verification instead.")
    ] = False,
    twin: Annotated[
        bool, typer.Option("--twin", help="Compare the twin with the engine instead.")
    ] = False,
    device: Device = None,
    as_json: AsJson = False,
) -> None:
    """Measure the benchmark itself: speed (as ratios within this run), memory, convergence.

    Exit code 1 if a figure misses its bar, or a policy or the twin its limit.

    Example: colift bench --episodes 200
    """
    check_exclusive(
        convergence=convergence, policies=policies, isolation=isolation, scale=scale, twin=twin
    )
    if suite != USUAL and not convergence:
        raise InputError("--suite belongs to --convergence")
    if device is not None and not twin:
        raise InputError("--device belongs to --twin")
    if episodes < 200:
        raise InputError(f"--episodes must be at least 200, got {episodes}")
    studies: dict[Callable[[], Report], bool] = {
        partial(_convergence, suite): convergence,
        _policies: policies,
        _isolation: isolation,
        _scale: scale,
        partial(_twin, device): twin,
        partial(_engine, episodes): True,
    }
    content, shown, off = next(study for study, wanted in studies.items() if wanted)()
    if as_json:
        print_json(content)
    else:
        show(*shown)
    for each in off:
        print(f"missed: {each}", file=sys.stderr)
    if off:
        raise typer.Exit(1)


def _engine(episodes: int) -> Report:
    """Return the speed, the accuracy and the memory of the benchmark itself."""
    figures: dict[str, float] = {}
    parts: dict[str, Callable[[], dict[str, float]]] = {
        "one process": single_process,
        "solver": lambda: {"solver_error": solver_error()},
        "two workers": lambda: two_workers_ratio(process_pool),
    }
    hundreds = episodes // 100
    with job_bar("bench", len(parts) + hundreds, words=True) as bar:
        for name, part in parts.items():
            bar.stage(name)
            figures |= part()
            bar.advance(1)
        bar.stage(f"{episodes} episodes")
        figures |= _endurance(episodes, bar.advance)
    return figures, (_figures_table("colift bench", figures),), missed(figures)


def _figures_table(title: str, figures: dict[str, float], caption: str = "") -> Table:
    rows = []
    for name, value in figures.items():
        figure = FIGURES[name]
        verdict = ("kept" if figure.kept(value) else "MISSED") if figure.bar else ""
        rows.append((name, f"{value:.3g}", figure.bar, verdict, figure.meaning))
    titles = ("figure", "value", left("bar"), "", left("meaning"))
    return table(title, titles, rows, caption=caption)


def _scale() -> Report:
    """Return the speed of a cluster and of verification, over a run in the local pool."""
    lifts = 3 * SCALE_ROUNDS * make_suite(SCALE_SUITE).size
    with progress_bar("bench", lifts) as progress:
        figures = measure_scale(SCALE_POLICY, SCALE_SUITE, SCALE_ROUNDS, progress)
    caption = f"{SCALE_POLICY} on {SCALE_SUITE}, two worker processes; median of {SCALE_ROUNDS}"
    return figures, (_figures_table("scale", figures, caption),), missed(figures)


def _twin(device: str | None) -> Report:
    """Return the deviation of the twin from the engine, and its speed."""
    require_jax(device)
    from colift.benchmark.profiling.twin import BATCHES, twin_speeds
    from colift.benchmark.twin.deviation import AMPLIFYING, PAIR, POLICIES, deviations

    found, batches = [], BATCHES[device_in_use()]
    with progress_bar("bench", sum(map(len, POLICIES.values())) + 1 + len(batches)) as progress:
        for each in deviations():
            found.append(each)
            progress(1)
        steady = [each for each in found if each.policy not in (PAIR, *AMPLIFYING)]
        figures = {
            "twin_mean_error": max(each.mean_error for each in steady),
            "twin_worst_error": max(each.worst_error for each in steady),
        }
        speeds, ratios = twin_speeds(progress)
    figures |= ratios
    content = {
        **figures,
        "device": device_in_use(),
        "steps_per_second": [each._asdict() for each in speeds],
        "policies": {
            f"{each.task} {each.policy}": {
                "engine_mm": each.engine_mm,
                "twin_mm": each.twin_mm,
                "mean_error": each.mean_error,
                "worst_error": each.worst_error,
                "within_limits": each.within_limits,
            }
            for each in found
        },
    }
    rows: list[Sequence[Cell] | None] = [
        (
            each.task,
            each.policy,
            f"{each.engine_mm:.3f}",
            f"{each.twin_mm:.3f}",
            f"{100 * each.mean_error:.3f} %",
            f"{100 * each.worst_error:.3f} %",
            "kept" if each.within_limits else "EXCEEDED",
        )
        for each in found
    ]
    titles = ("task", left("policy"), "engine mm", "twin mm", "mean error", "worst lift", "limits")
    off = [f"{each.policy} is too far from the engine" for each in found if not each.within_limits]
    caption = "lifts with people outside all suites: 10 of a level table, 4 of the other tasks"
    deviation = table("The twin and the engine", titles, rows, caption=caption)
    fast = [(f"{each.lifts:,}", *(f"{rate / 1e6:.3g}" for rate in each[1:])) for each in speeds]
    ways = ("lifts at a time", "whole lifts", "with gradients", "environment")
    *of_engine, of_bulk = (f"{ratio:.0f} times" for ratio in ratios.values())
    caption = (
        f"on one {device_in_use()}; the best are {', '.join(of_engine)} the engine's, in this run. "
        f"Lifts are drawn {of_bulk} as fast in bulk as one by one."
    )
    speed = table("Million control steps per second", ways, fast, caption=caption)
    return content, (deviation, speed), [*missed(figures), *off]


def _isolation() -> Report:
    """Return the cost of each isolation level, over the same policy in this process."""
    found: dict[str, IsolationCost] = {}
    bits: dict[str, float] = {}
    with isolated() as (plain, ways), progress_bar("bench", ROUNDS * len(ways)) as progress:
        for name, policy in ways.items():
            found[name] = isolation_cost(plain, policy, progress=progress)
            bits[name] = bits_of_time(policy)
    content = {
        "aim": {"step_us": STEP_US, "episode_ms": EPISODE_MS},
        "isolation": {
            name: {
                **dataclasses.asdict(cost),
                "within_aim": cost.within_aim,
                "bits_of_time": bits[name],
            }
            for name, cost in found.items()
        },
    }
    rows = (
        (
            name,
            f"{cost.step_us:.0f}",
            f"{cost.episode_ms:.1f}",
            "reached" if cost.within_aim else "missed",
            f"{bits[name]:.1f}",
        )
        for name, cost in found.items()
    )
    titles = ("isolation", "us per step", "ms per episode", "aim", "bits of time")
    caption = (
        f"over in-process; aim: {STEP_US:g} us per step, {EPISODE_MS:g} ms per episode; "
        "bits that a lift can pass on by the time it takes"
    )
    return content, (table("cost of isolation", titles, rows, caption=caption),), []


def _endurance(episodes: int, progress: Callable[[int], None]) -> dict[str, float]:
    rows = []
    for row in endurance(episodes):
        rows.append(row)
        progress(1)
    third = max(1, len(rows) // 3)
    early = sum(row["ms_per_episode"] for row in rows[:third])
    late = sum(row["ms_per_episode"] for row in rows[-third:])
    return {
        "memory_growth_mb": rows[-1]["memory_mb"] - rows[0]["memory_mb"],
        "late_over_early": late / early,
    }


def _policies() -> Report:
    """Return the time of a step of each policy, and whether it exceeds the limit."""
    scenarios, names = default_scenarios(), list(playing(LEVEL.name))
    found: dict[str, StepTime | None] = {}
    with progress_bar("bench", len(names)) as progress:
        for name in names:
            found[name] = step_time(PolicySpec(text=name), scenarios)
            progress(1)
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
    rows = []
    for name, taken in found.items():
        if taken is None:
            rows.append((name, "none", "none", "0", "fails"))
        else:
            kept = "kept" if taken.within_limit else "exceeded"
            times = (f"{taken.median_ms:.3f}", f"{taken.p99_ms:.3f}")
            rows.append((name, *times, str(taken.steps), kept))
    titles = ("policy", "median ms", "p99 ms", "steps", "limit")
    caption = f"limit: 99th percentile at most {LIMIT_MS:g} ms"
    slow = [
        f"{name}: a step takes {taken.p99_ms:.3g} ms, must take at most {LIMIT_MS:g}"
        for name, taken in found.items()
        if taken is not None and not taken.within_limit
    ]
    return content, (table("time of a step", titles, rows, caption=caption),), slow


def _convergence(suite: str) -> Report:
    """Return the errors that coarser physics cause."""
    errors = []
    with progress_bar("bench", None) as progress:
        for error in study(suite):
            errors.append(error)
            progress(1)
    content = [
        {
            "policy": row.policy,
            "step_s": row.physics.step,
            "iterations": row.physics.iterations,
            "reference_step_s": row.reference.step,
            "reference_iterations": row.reference.iterations,
            "mean_rmse_error": row.mean_error,
            "mean_rmse_error_spread": row.mean_spread,
            "median_rmse_error": row.median_error,
            "worst_rmse_error": row.worst_error,
            "height_error_mm": row.height_error_mm,
        }
        for row in errors
    ]
    rows = (
        (
            row.policy,
            _setting(row.physics, row.reference),
            f"{100 * row.mean_error:+.2f} ± {100 * row.mean_spread:.2f} %",
            f"{100 * row.median_error:.2f} %",
            f"{100 * row.worst_error:.2f} %",
            f"{row.height_error_mm:.3f}",
        )
        for row in errors
    )
    titles = ("policy", left("physics"), "mean", "median", "worst lift", "heights mm")
    caption = (
        "RMSE error against steps of 0.5 ms, ± standard error over the same lifts; of the solvers\n"
        "(direct, sequential impulses) against 3000 iterations, on the lifts of one seed"
    )
    return content, (table(f"convergence on {suite}", titles, rows, caption=caption),), []


def _setting(physics: Physics, other: Physics) -> str:
    """Return a table cell with the difference of a setting from another."""
    if physics.step != other.step:
        return f"{1000 * physics.step:g} ms"
    return f"{physics.iterations} iterations" if physics.iterations else "direct"
