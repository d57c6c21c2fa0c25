"""Ranks from paired tests: errors with intervals, and the differences of neighbours."""

import numpy as np
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, ROBOT, style_axes
from colift.benchmark.results.baselines import shipped_baselines
from colift.benchmark.statistics import mean_of, paired_difference
from colift.benchmark.statistics.ranking import all_pairs
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.practice.shipped_scores import shipped_scores
from sheet import WIDTH, plt, write

SHOWN = ("task_model", "linear", "minimum_jerk", "ekf_minimum_jerk", "extrapolate", "proactive")

suite = make_suite("standard-v1")
baselines = shipped_baselines(suite)
assert baselines is not None
units, errors = baselines["copy"].units, shipped_scores(suite)
family = all_pairs(errors, units)
rows = np.arange(len(SHOWN))

figure, (means, differences) = plt.subplots(
    1, 2, figsize=(WIDTH, 2.9), sharey=True, width_ratios=(4, 3), layout="constrained"
)
for row, name in enumerate(SHOWN):
    found = mean_of(errors[name], units)
    means.plot(found.ci95, [row, row], color=ROBOT, linewidth=2)
    means.plot(found.mean, row, "o", color=ROBOT, markersize=6)
    means.text(3.2, row, f"{family.ranks[name]}", color=INK, weight="bold", va="center")
    better = SHOWN[row - 1]
    if row:
        found = paired_difference(errors[name], errors[better], units)
        apart = family.apart(name, better)
        colour = INK if apart else HUMAN
        at = row - 0.5
        differences.plot(found.ci95, [at, at], color=colour, linewidth=2)
        differences.plot(found.mean, at, "o", color=colour, markersize=5)
        if not apart:
            means.plot([3.0, 3.0], [row - 1.15, row + 0.15], color=HUMAN, linewidth=3)
            differences.text(found.ci95[1] + 0.2, at, "same rank", color=HUMAN, va="center")
differences.axvline(0, color=FAINT, linewidth=1.2)
means.set(xlim=(2.8, 12.6), ylim=(len(SHOWN) - 0.5, -0.5), xlabel="RMSE [mm], 95 % interval")
means.set_yticks(rows, SHOWN)
means.set_title("rank", loc="left", size=8.5, color=FAINT)
differences.set(xlim=(-0.6, 3.4), xlabel="more than above [mm]")
differences.set_title("difference, paired", loc="left", size=8.5, color=FAINT)
for axes in (means, differences):
    style_axes(axes)
    axes.grid(visible=False, axis="y")
write(figure)
