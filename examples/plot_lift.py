"""
One lift
========

The heights of both ends of the table over time, and the tilt that follows from them. The robot
goes to the last height it has seen, so it lags while the human moves.
"""

import colift
import numpy as np
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, ROBOT, style_axes
from colift.benchmark.world.table import TABLE_LENGTH
from matplotlib import pyplot as plt

found = colift.evaluate("copy", suite="quick-v1")
episode = next(each for each in found.run.episodes if each.behaviour == "pause")
trace = episode.trace
time = np.arange(1, len(trace.human_end) + 1) / 100
tilt = np.degrees(np.arcsin((trace.human_end - trace.robot_end) / TABLE_LENGTH))

# %%
# The human pauses on the way up, goes on, and lowers the table again.

figure, (heights, tilts) = plt.subplots(
    2, 1, figsize=(8, 5), sharex=True, height_ratios=(2, 1), layout="constrained"
)
heights.plot(time, 1000 * trace.human_end, color=HUMAN, label="human's end")
heights.plot(time, 1000 * trace.robot_end, color=ROBOT, label="robot's end")
heights.plot(time, 1000 * trace.target, "--", color=INK, linewidth=1, label="human's intention")
heights.set_ylabel("height [mm]")
heights.legend(loc="upper left", frameon=False)
tilts.fill_between(time, tilt, color=FAINT, alpha=0.4, linewidth=0)
tilts.plot(time, tilt, color=INK, linewidth=1)
tilts.set(xlabel="time [s]", ylabel="tilt [°]", xlim=(0, time[-1]))
for axes in (heights, tilts):
    style_axes(axes)
plt.show()
