"""The table of the learners: each learns each task with some seeds, and the engine scores it.

A cell is one command, and is made once: what is in the folder already stays, so that the command
may be stopped and given again. It needs the extra ``train``::

    python examples/learners/table.py learners --steps 2e6 --seeds 5

In the folder are the submissions, what the learners printed, the scores, ``table.md``, and
``curves.png``: the error while learning, over steps and over seconds.
"""

import argparse
import csv
import itertools
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from colift.benchmark.statistics import interquartile_mean

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


def make(learner, task, seed, steps, folder):
    """Train and score one cell, unless that has been done."""
    place = folder / task / learner / f"seed-{seed}"
    if (place / "score.json").exists():
        return
    place.mkdir(parents=True, exist_ok=True)
    # One thread for each: the cells are many.
    env = {**os.environ, "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false"}
    policy = learner
    if learner not in ALONE:
        order, policy = command(learner, task, seed, steps, place)
        begin = time.perf_counter()
        printed = subprocess.run(order, env=env, check=True, capture_output=True, text=True).stdout
        taken = time.perf_counter() - begin
        (place / "printed.txt").write_text(f"{printed}\n{taken:.1f} s with compilation\n")
    order = [sys.executable, "-m", "colift", "run", str(policy), "--suite", TASKS[task], "--json"]
    scored = subprocess.run([*order, "--jobs", "1"], capture_output=True, text=True)
    if scored.returncode not in (0, FAILED_LIFTS):
        raise SystemExit(scored.stderr)
    (place / "score.json").write_text(scored.stdout)
    print(f"{learner} {task} {seed}: {score(place):.2f} mm", flush=True)


def score(place):
    """Return the mean RMSE of a cell [mm]."""
    return json.loads((place / "score.json").read_text())["summary"]["rmse_mm"]["mean"]


def curve(place):
    """Return the steps, seconds and errors [mm] while a cell was learning."""
    training = place.parent / "training" / f"{place.name}.csv"
    if training.exists():
        with training.open() as file:
            rows = [[float(each) for each in row.values()] for row in csv.DictReader(file)]
        return np.array(rows).T
    text = (place / "printed.txt").read_text()
    found = re.findall(r"([\d,]+) steps +([\d.]+) mm", text)
    steps = np.array([float(many.replace(",", "")) for many, _ in found])
    taken = float(re.search(r"([\d.]+) s: ", text)[1])
    return steps, steps / steps[-1] * taken, np.array([float(error) for _, error in found])


def row(learner, folder, tasks):
    """Return a row of the table: the interquartile mean over seeds, and its interval."""
    rng, cells = np.random.default_rng(0), [learner]
    for task in tasks:
        places = sorted((folder / task / learner).glob("seed-*/score.json"))
        errors = np.array([score(each.parent) for each in places])
        if not len(errors):
            cells.append("")
            continue
        drawn = interquartile_mean(rng.choice(errors, (DRAWS, len(errors))), axis=1)
        low, high = np.quantile(drawn, (0.025, 0.975))
        between = f" [{low:.1f}, {high:.1f}]" if len(errors) > 1 else ""
        cells.append(f"{interquartile_mean(errors):.1f}{between}")
    return f"| {' | '.join(cells)} |"


def budget(learner, folder, tasks):
    """Return a row of the budget: million steps, and seconds."""
    cells = [learner]
    for task in tasks:
        places = sorted((folder / task / learner).glob("seed-*/printed.txt"))
        ends = [[each[-1] for each in curve(place.parent)[:2]] for place in places]
        steps, taken = np.median(ends, axis=0) if ends else (0, 0)
        cells.append(f"{steps / 1e6:.1f} M, {taken:.0f} s" if ends else "")
    return f"| {' | '.join(cells)} |"


def written(folder, learners, tasks):
    """Write the table, and return it."""
    head = [f"| | {' | '.join(TASKS[task] for task in tasks)} |", "|---" * (len(tasks) + 1) + "|"]
    scores = [row(learner, folder, tasks) for learner in (*learners, *ALONE)]
    budgets = [budget(learner, folder, tasks) for learner in learners]
    text = "\n".join([*head, *scores, "", *head, *budgets, ""])
    (folder / "table.md").write_text(text)
    return text


def draw(folder, learners, tasks):
    """Draw the curves: a line for each learner, the interquartile mean over its seeds."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(3 * len(tasks), 5), layout="constrained")
    axes = figure.subplots(2, len(tasks), squeeze=False, sharey="col")
    for column, task in enumerate(tasks):
        for learner in learners:
            places = sorted((folder / task / learner).glob("seed-*/printed.txt"))
            if not places:
                continue
            steps, taken, errors = np.mean([curve(each.parent) for each in places], axis=0)
            axes[0, column].plot(steps / 1e6, errors, label=learner)
            axes[1, column].plot(taken, errors)
        axes[0, column].set(title=TASKS[task], xlabel="million steps", yscale="log")
        axes[1, column].set(xlabel="seconds")
    for each in axes[:, 0]:
        each.set_ylabel("error while learning [mm]")
    axes[0, 0].legend()
    figure.savefig(folder / "curves.png", dpi=120)


def main():
    """Make the cells that are missing, and the table."""
    arguments = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--steps", type=float, default=2e6, help="control steps of each cell")
    arguments.add_argument("--seeds", type=int, default=5)
    arguments.add_argument("--learners", nargs="+", default=[*LEARNERS, GRADIENTS])
    arguments.add_argument("--tasks", nargs="+", choices=TASKS, default=list(TASKS))
    arguments.add_argument("--jobs", type=int, default=1, help="trainings at a time")
    given = arguments.parse_args()

    def made(cell):
        learner, task = cell
        for seed in range(1 if learner in ALONE else given.seeds):
            make(learner, task, seed, given.steps, given.folder)

    cells = list(itertools.product((*ALONE, *given.learners), given.tasks))
    with ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(made, cells))
    print(written(given.folder, given.learners, given.tasks))
    draw(given.folder, given.learners, given.tasks)


if __name__ == "__main__":
    main()
