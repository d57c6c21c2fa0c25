"""
Confidence during a lift
========================

The paper's blend leads in proportion to its confidence in its own prediction, and follows
otherwise. The trace of a lift keeps the numbers with which a policy explains its actions.
"""

import colift
import numpy as np
from colift.benchmark.rendering.style import HUMAN, INK, ROBOT, style_axes
from matplotlib import pyplot as plt

found = colift.evaluate("blend", suite="quick-v1")
trace = found.run.episodes[0].trace
confidence = trace.internals["confidence"]
frames = np.arange(1, len(trace.human_end) + 1) / 100
steps = np.arange(len(confidence)) * len(frames) / len(confidence) / 100

# %%
# The confidence is near 1 before the lift, falls when the motion begins, and is lowest where the
# lowering ends.

figure, (heights, lower) = plt.subplots(
    2, 1, figsize=(8, 5), sharex=True, height_ratios=(2, 1), layout="constrained"
)
heights.plot(frames, 1000 * trace.human_end, color=HUMAN, label="human's end")
heights.plot(frames, 1000 * trace.robot_end, color=ROBOT, label="robot's end")
prediction = 1000 * trace.internals["prediction"]
heights.plot(steps, prediction, ".", color=INK, label="predicted height of the human's end")
heights.set_ylabel("height [mm]")
heights.legend(frameon=False)
lower.step(steps, confidence, color=INK, where="post")
lower.fill_between(steps, confidence, color=ROBOT, alpha=0.25, linewidth=0, step="post")
lower.set(xlabel="time [s]", ylabel="confidence", ylim=(0, 1.05), xlim=(0, frames[-1]))
for axes in (heights, lower):
    style_axes(axes)
plt.show()
