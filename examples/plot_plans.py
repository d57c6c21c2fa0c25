"""
The plans of the behaviours
===========================

The heights that five people intend, in one lift of each behaviour.
"""

import numpy as np
from colift.agents.humans import SUBJECTS, ChangingGoal, Jerky, Pause, Smooth
from matplotlib import pyplot as plt

figure = plt.figure(figsize=(9, 5.4), layout="constrained")
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
