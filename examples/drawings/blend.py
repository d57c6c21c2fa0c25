"""The blend of a lift: how much of each action is the leader's, and how much the follower's."""

import colift
import numpy as np
from colift.benchmark.rendering.style import AIM, HUMAN, LINE, ROBOT, style_axes
from sheet import WIDTH, legend, plt, write

trace = colift.evaluate("blend", suite="quick-v1").run.episodes[0].trace
confidence = np.append(trace.internals["confidence"], trace.internals["confidence"][-1])
time = np.arange(1, len(trace.human_end) + 1) / 100
steps = np.arange(len(confidence)) * time[-1] / (len(confidence) - 1)

figure, (heights, shares) = plt.subplots(
    2, 1, figsize=(WIDTH, 3.8), sharex=True, height_ratios=(3, 2), layout="constrained"
)
heights.plot(time, 1000 * trace.human_end, color=HUMAN, linewidth=1.8, label="human's end")
heights.plot(time, 1000 * trace.robot_end, color=ROBOT, linewidth=1.8, label="robot's end")
heights.set_ylabel("height [mm]")
legend(heights)
parts = ((0.0, confidence, AIM, "proactive: leads"),
         (confidence, 1.0, LINE, "reactive: follows"))  # fmt: skip
for low, high, colour, name in parts:
    shares.fill_between(steps, low, high, step="post", color=colour, linewidth=0, label=name)
legend(shares)
shares.set(xlabel="time [s]", ylabel="share: confidence", ylim=(0, 1), xlim=(0, time[-1]))
for axes in (heights, shares):
    style_axes(axes)
write(figure)
