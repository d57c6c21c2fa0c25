"""
The plans of the behaviours
===========================

The heights that five people intend, in one lift of each behaviour.
"""

import numpy as np
from colift.agents.humans import SUBJECTS, ChangingGoal, Jerky, Pause, Smooth
from colift.benchmark.rendering.style import style_axes
from matplotlib import pyplot as plt

# Distinct with any kind of colour vision (M. Okabe and K. Ito, "Color universal design", 2008).
COLOURS = ("#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7")

figure = plt.figure(figsize=(9, 5.4), layout="constrained")
axes = figure.subplots(2, 2, sharex=True, sharey=True)
for panel, behaviour in zip(axes.flat, (Smooth(), Pause(), Jerky(), ChangingGoal()), strict=True):
    people = zip(SUBJECTS.items(), COLOURS, strict=True)
    for seed, ((name, subject), colour) in enumerate(people):
        target = behaviour.plan(subject, seed + 3).target
        time = np.arange(len(target)) / 100
        panel.plot(time, 1000 * target, color=colour, label=name, linewidth=1.5)
    panel.set_title(type(behaviour).__name__, loc="left")
    style_axes(panel)
axes[0, 0].legend(fontsize="small", loc="upper right", frameon=False)
figure.supxlabel("time [s]")
figure.supylabel("intended height [mm]")
plt.show()
