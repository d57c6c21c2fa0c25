"""The table of the learners: each learns each task with some seeds, and the engine scores it.

A cell is one command, and is made once: what is in the folder already stays, so that the command
may be stopped and given again. It needs the extra ``train``::

    python examples/learners/table.py learners --steps 2e6 --seeds 5

In the folder are the submissions, ``learners.json`` with score and curve of each cell, and
``learners.png``: the error while learning, over steps and over seconds. A folder that begins with
the ``learners.json`` of another goes on with it.
"""

import argparse
import csv
import itertools
import json
import os
import re
import shutil
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from colift.benchmark.statistics import interquartile_mean
from colift.benchmark.tables.printing import show, table

HERE = Path(__file__).parent
TASKS = {"level": "standard-v1", "agree": "agree-v1", "ball": "ball-v1", "intent": "intent-v1"}
LEARNERS = {
    "ppo": ("ppo.py",),
    "sac": ("sac.py",),
    "ippo": ("mappo.py", "--critic", "own"),
    "mappo": ("mappo.py", "--critic", "all"),
    "fcp": ("fcp.py",),
}
GRADIENTS = "apg"  # Of the package: ``colift train apg``, with its own number of steps.
ALONE = ("copy",)  # Robots that did not learn, for comparison.
FAILED_LIFTS = 1  # The exit status of ``colift run`` where lifts failed; they count as worst.
DRAWS = 10_000  # Of the bootstrap over seeds.
CURVE = ("steps", "seconds", "errors_mm")  # What is kept of a training.


def command(learner, task, seed, steps, place):
    """Return the command that trains, and the folder of its submission."""
    if learner == GRADIENTS:
        folder = place.parent / "training"
        seeds = ("--seeds", str(seed + 1))  # Those before are there already.
        made = [sys.executable, "-m", "colift", "train", "apg", "--task", task, *seeds]
        return [*made, "--out", str(folder)], folder / f"seed-{seed}"
    script, *options = LEARNERS[learner]
    made = [sys.executable, str(HERE / script), *options, "--task", task, "--seed", str(seed)]
    return [*made, "--steps", str(steps), "--out", str(place / "policy")], place / "policy"


def curve(printed, training, seed):
    """Return the steps, seconds and errors [mm] while a cell was learning."""
    table = training / f"seed-{seed}.csv"
    if table.exists():
        with table.open() as file:
            rows = [[float(each) for each in row.values()] for row in csv.DictReader(file)]
        return np.array(rows).T
    found = re.findall(r"([\d,]+) steps +([\d.]+) mm", printed)
    steps = np.array([float(many.replace(",", "")) for many, _ in found])
    taken = float(re.search(r"([\d.]+) s: ", printed)[1])
    return steps, steps / steps[-1] * taken, np.array([float(error) for _, error in found])


def made(learner, task, seed, steps, folder):
    """Train and score a cell; return its result."""
    place = folder / task / learner / f"seed-{seed}"
    shutil.rmtree(place, ignore_errors=True)  # Of a cell that was stopped.
    place.mkdir(parents=True)
    # One thread for each: the cells are many.
    env = {**os.environ, "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false"}
    policy, result = learner, {"learner": learner, "task": task, "seed": seed}
    if learner not in ALONE:
        order, policy = command(learner, task, seed, steps, place)
        trained = subprocess.run(order, env=env, capture_output=True, text=True)
        if trained.returncode:
            raise SystemExit(trained.stderr)
        learned = curve(trained.stdout, policy.parent, seed)
        for name, values in zip(CURVE, learned, strict=True):
            result[name] = [round(float(each), 3) for each in values]
    order = [sys.executable, "-m", "colift", "run", str(policy), "--suite", TASKS[task], "--json"]
    scored = subprocess.run([*order, "--jobs", "1"], capture_output=True, text=True)
    if scored.returncode not in (0, FAILED_LIFTS):
        raise SystemExit(scored.stderr)
    result["rmse_mm"] = json.loads(scored.stdout)["summary"]["rmse_mm"]["mean"]
    return result


def of(cells, learner, task):
    """Return the cells of a learner on a task."""
    return [each for each in cells if (each["learner"], each["task"]) == (learner, task)]


def scored(cells, learner, task):
    """Return an entry of the table: the interquartile mean over seeds, and its interval."""
    errors = np.array([each["rmse_mm"] for each in of(cells, learner, task)])
    if not len(errors):
        return ""
    drawn = np.random.default_rng(0).choice(errors, (DRAWS, len(errors)))
    low, high = np.quantile(interquartile_mean(drawn, axis=1), (0.025, 0.975))
    between = f" [{low:.1f}, {high:.1f}]" if len(errors) > 1 else ""
    return f"{interquartile_mean(errors):.1f}{between}"


def spent(cells, learner, task):
    """Return million steps and seconds of a training, the median over seeds."""
    ends = [(each["steps"][-1], each["seconds"][-1]) for each in of(cells, learner, task)]
    steps, taken = np.median(ends, axis=0) if ends else (0.0, 0.0)
    return f"{steps / 1e6:.1f} M, {taken:.0f} s" if ends else ""


def tables(cells, learners, tasks):
    """Return the table of scores, and that of budgets."""

    def made(title, entry, rows):
        filled = [(each, *(entry(cells, each, task) for task in tasks)) for each in rows]
        return table(title, ("learner", *(TASKS[task] for task in tasks)), filled)

    return (
        made("RMSE mm, interquartile mean over seeds [95 %]", scored, (*learners, *ALONE)),
        made("Control steps and seconds of a training, median over seeds", spent, learners),
    )


def draw(cells, learners, tasks):
    """Return a figure of the curves: a line for each learner, the mean over its seeds."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(3 * len(tasks), 5), layout="constrained")
    axes = figure.subplots(2, len(tasks), squeeze=False, sharey="col")
    for column, task in enumerate(tasks):
        for number, learner in enumerate(learners):
            seeds = of(cells, learner, task)
            if not seeds:
                continue
            steps, taken, errors = (
                np.mean([each[name] for each in seeds], axis=0) for name in CURVE
            )
            style = {"color": f"C{number}", "label": learner}
            axes[0, column].plot(steps / 1e6, errors, **style)
            axes[1, column].plot(taken, errors, **style)
        for alone in of(cells, *ALONE, task):
            for each in axes[:, column]:
                each.axhline(alone["rmse_mm"], color="gray", linestyle=":", label=alone["learner"])
        limits = {"xscale": "log", "ylim": (0.0, None)}
        axes[0, column].set(title=TASKS[task], xlabel="million steps", **limits)
        axes[1, column].set(xlabel="seconds", **limits)
        for each in axes[:, column]:
            each.xaxis.set_major_formatter("{x:g}")
            each.xaxis.set_minor_formatter("")
    for each in axes[:, 0]:
        each.set_ylabel("error while learning [mm]")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=9)
    return figure


def kept(path):
    """Return the cells that are there."""
    return json.loads(path.read_text()) if path.exists() else []


def keep(path, cells):
    """Write the cells, one in each line, in the order of learners, tasks and seeds."""
    cells.sort(key=lambda each: (each["learner"], each["task"], each["seed"]))
    text = ",\n".join(map(json.dumps, cells))
    new = path.with_suffix(".new")
    new.write_text(f"[\n{text}\n]\n")
    new.replace(path)


def main():
    """Make the cells that are missing, and the table."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--steps", type=float, default=2e6, help="control steps of each cell")
    arguments.add_argument("--seeds", type=int, default=5)
    learners = [*LEARNERS, GRADIENTS]
    arguments.add_argument("--learners", nargs="+", choices=learners, default=learners)
    arguments.add_argument("--tasks", nargs="+", choices=TASKS, default=list(TASKS))
    arguments.add_argument("--jobs", type=int, default=1, help="trainings at a time")
    given = arguments.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    path, writing = given.folder / "learners.json", threading.Lock()
    cells = kept(path)
    there = {(each["learner"], each["task"], each["seed"]) for each in cells}

    def make(learner, task):
        for seed in range(1 if learner in ALONE else given.seeds):
            if (learner, task, seed) in there:
                continue
            cell = made(learner, task, seed, given.steps, given.folder)
            print(f"{learner} {task} {seed}: {cell['rmse_mm']:.2f} mm", file=sys.stderr)
            with writing:
                cells.append(cell)
                keep(path, cells)

    # Each training has a processor: two that share theirs take half as long again.
    processors = itertools.cycle(os.sched_getaffinity(0))
    with ThreadPoolExecutor(
        given.jobs, initializer=lambda: os.sched_setaffinity(0, {next(processors)})
    ) as pool:
        list(
            pool.map(
                lambda cell: make(*cell), itertools.product((*ALONE, *given.learners), given.tasks)
            )
        )
    show(*tables(cells, given.learners, given.tasks))
    draw(cells, given.learners, given.tasks).savefig(given.folder / "learners.png", dpi=120)


if __name__ == "__main__":
    main()
