"""
Two policies on the same lifts
==============================

Policies are compared lift by lift: people, plans and noise are the same for each. A point below
the line is a lift that the second policy keeps more level.
"""

import colift
from colift.benchmark.rendering.style import FAINT, style_axes
from matplotlib import pyplot as plt

FIRST, SECOND = "copy", "anticipate"
MARKS = {
    "smooth": ("o", "#0072B2"),
    "pause": ("s", "#D55E00"),
    "jerky": ("^", "#009E73"),
    "changing_goal": ("D", "#CC79A7"),
}

first, second = (colift.evaluate(name, suite="quick-v1").to_frame() for name in (FIRST, SECOND))

figure, axes = plt.subplots(figsize=(5.6, 5.2), layout="constrained")
for behaviour, (marker, colour) in MARKS.items():
    chosen = first["behaviour"] == behaviour
    pairs = first[chosen]["rmse_mm"], second[chosen]["rmse_mm"]
    axes.plot(*pairs, marker, color=colour, label=behaviour, markersize=7)
top = 1.1 * max(first["rmse_mm"].max(), second["rmse_mm"].max())
axes.plot([0, top], [0, top], color=FAINT, linewidth=1)
axes.set(xlim=(0, top), ylim=(0, top), aspect="equal")
axes.set(xlabel=f"RMSE of {FIRST} [mm]", ylabel=f"RMSE of {SECOND} [mm]")
style_axes(axes)
axes.legend(frameon=False, loc="upper left")
plt.show()
