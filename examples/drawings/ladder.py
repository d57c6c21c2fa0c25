"""The ladder of standard-v1, from a robot that stands still to one that knows the plan."""

import numpy as np
from colift.benchmark.rendering.style import AIM, FAINT, HUMAN, INK, ROBOT
from colift.benchmark.results.baselines import shipped_baselines, shipped_references
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.practice.shipped_scores import shipped_scores
from sheet import WIDTH, plt, write

suite = make_suite("standard-v1")
played, known = shipped_baselines(suite), shipped_references(suite)
assert played is not None
assert known is not None
policies = shipped_scores(suite)
RUNGS = (
    ("hold", played["hold"].mean, INK, -1),
    ("copy", played["copy"].mean, INK, 2),
    ("blend", float(np.mean(policies["blend"])), ROBOT, -1),
    ("two people", played["human_human"].mean, HUMAN, 1),
    ("learned", float(np.mean(policies["learned"])), ROBOT, -1),
    ("best known", known["best_known"].mean, AIM, 2),
    ("oracle", known["oracle"].mean, AIM, -1),
)
"""Name, error [mm], colour, and the place of its label: rows above the line, or below it."""

figure, axes = plt.subplots(figsize=(WIDTH, 2.2), layout="constrained")
axes.axhline(0, color=FAINT, linewidth=1.2, zorder=0)
for name, error, colour, row in RUNGS:
    side = "bottom" if row > 0 else "top"
    axes.plot([error, error], [0, row], color=FAINT, linewidth=0.8, zorder=0)
    axes.plot(error, 0, "o", color=colour, markersize=8, markeredgecolor="white")
    label = f"{name}\n{error:.{3 if error > 10 else 2}g} mm"
    axes.text(error, row, label, color=colour, weight="bold", size=8.5, ha="center", va=side)
axes.set(xscale="log", xlim=(220, 0.08), ylim=(-2.4, 3.4), yticks=[])
axes.set_xlabel("RMSE on standard-v1 [mm]: more level to the right")
axes.set_xticks([100, 10, 1, 0.1], ["100", "10", "1", "0.1"])
axes.tick_params(labelsize=8.5, colors=FAINT, length=0, which="both")
for spine in axes.spines.values():
    spine.set_visible(False)
write(figure)
