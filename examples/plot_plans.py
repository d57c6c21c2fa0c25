"""Draw what each behaviour intends: ``python examples/plot_plans.py FILE.png``."""

import sys

import numpy as np
from colift.agents.humans import SUBJECTS, ChangingGoal, Jerky, Pause, Smooth
from matplotlib.figure import Figure

figure = Figure(figsize=(9, 5.4), layout="constrained")
axes = figure.subplots(2, 2, sharex=True, sharey=True)
for panel, behaviour in zip(axes.flat, (Smooth(), Pause(), Jerky(), ChangingGoal()), strict=True):
    for seed, (name, subject) in enumerate(SUBJECTS.items()):
        target = behaviour.plan(subject, seed + 3).target
        panel.plot(np.arange(len(target)) / 100, 1000 * target, label=name, linewidth=1.5)
    panel.set_title(type(behaviour).__name__, loc="left")
    panel.grid(alpha=0.3)
axes[0, 0].legend(ncols=5, fontsize="x-small", loc="upper center")
figure.supxlabel("time [s]")
figure.supylabel("intended height [mm]")
figure.savefig(sys.argv[1], dpi=110)
