"""
The force that the human feels
==============================

A robot that lags lets the human carry more than half of the table on the way up. The picture shows
the force at the human's hands beyond that half, in the same lift with two policies.
"""

import colift
import numpy as np
from colift.benchmark.rendering.style import INK, ROBOT, style_axes
from colift.benchmark.world.table import WEIGHT_SHARE
from matplotlib import pyplot as plt

figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
for policy, colour in (("reactive", INK), ("anticipate", ROBOT)):
    episode = colift.evaluate(policy, suite="quick-v1").run.episodes[0]
    force = episode.trace.human_force - WEIGHT_SHARE
    label = f"{policy}: {episode.scores['human_force_n']:.2f} N root mean square"
    axes.plot(np.arange(1, len(force) + 1) / 100, force, color=colour, linewidth=1, label=label)
axes.set(xlabel="time [s]", ylabel="force beyond half the weight [N]", xlim=(0, len(force) / 100))
style_axes(axes)
axes.legend(frameon=False)
plt.show()
