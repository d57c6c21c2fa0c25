"""The time line of a step: a sample of motion capture, its age, the decision and the ramp."""

import colift
import numpy as np
from colift.agents.agent import FRAME
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, ROBOT, style_axes
from sheet import WIDTH, arrow, legend, plt, write

STEP = 20
"""The step that is drawn, while the human lifts."""

trace = colift.evaluate("extrapolate", suite="quick-v1").run.episodes[0].trace
command = 1000 * np.concatenate(([0.0], np.cumsum(trace.action[:, 0])))
frames = 1000 * (FRAME * np.arange(1, len(trace.human_end) + 1) - STEP * CONTROL_PERIOD)
human, robot = 1000 * trace.human_end, 1000 * trace.robot_end
period, age = 1000 * CONTROL_PERIOD, 1000 * LATENCY
decisions = period * np.array([0, 1])
samples = np.interp(decisions - age, frames, human)

figure, axes = plt.subplots(figsize=(WIDTH, 3.3), layout="constrained")
axes.plot(frames, human, color=HUMAN, linewidth=1.8, label="human's end")
axes.plot(frames, robot, color=ROBOT, linewidth=1.8, label="robot's end")
steps = period * (np.arange(len(command)) - STEP)
axes.plot(steps, command, color=INK, linewidth=1.2, linestyle=(0, (4, 2)), label="command")
axes.plot(decisions - age, samples, "o", color=HUMAN, markersize=7, markeredgecolor="white")
for name, at, sample, light in zip(
    ("decision", "next decision"), decisions, samples, (INK, FAINT), strict=True
):
    axes.axvline(at, color=light, linewidth=1.2)
    axes.text(at + 4, 3, name, color=light)
    arrow(axes, (at - age, sample), (at, sample), colour=light, linewidth=1.0)
thin = {"arrowstyle": "-", "color": FAINT, "linewidth": 0.8}
axes.annotate(
    f"sample of the human's end:\n{age:.0f} ms old at the decision",
    (-age, samples[0] + 2),
    (-142, 72),
    color=HUMAN,
    arrowprops={**thin, "relpos": (0.2, 0)},
)
axes.annotate(
    f"the hand's ramp\nuntil the next\ndecision: {period:.0f} ms",
    (period / 2, float(np.interp(period / 2, steps, command))),
    (period + 18, 46),
    color=INK,
    va="center",
    arrowprops=thin,
)
axes.set(xlim=(-150, 215), ylim=(0, 122), xlabel="time [ms]", ylabel="height [mm]")
axes.set_xticks([-100, 0, 100, 200])
style_axes(axes)
legend(axes)
write(figure)
