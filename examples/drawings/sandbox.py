"""The sandbox of a policy as boxes within boxes."""

from colift.agents.sandbox.protocol import LIMITS
from colift.benchmark.rendering.style import FAINT, HUMAN, INK, ROBOT, SKY
from sheet import arrow, box, sheet, write

figure, axes = sheet(100, 96)
box(axes, (2, 2), (96, 92), "evaluator", "world, human, sensors, scores, seeds")
limits = f"{LIMITS.memory // 2**30} GiB, one processor, {LIMITS.processes} processes"
words = f"own file system, processes and users; no network\nLandlock, filter of calls; {limits}"
box(axes, (6, 6), (88, 70), "sandbox", words, edge=INK, ground=SKY)
words = "counts memory and time; keeps the gate from outside"
box(axes, (10, 50), (64, 11), "watch: a process of colift's own", words)
words = "module, constructor, reset(seed): reads Python,\npackages and its own folder; sees no lift"
box(axes, (10, 10), (80, 37), "loaded once", words, edge=ROBOT)
axes.plot([12, 74], [31, 31], color=FAINT, linewidth=1.4, linestyle=(0, (4, 3)))
words = "the gate closes: files, threads and imports end"
axes.text(42, 30.2, words, color=FAINT, ha="center", va="top", size=8)
words = "act(observation): one thread, no file, no import"
box(axes, (14, 13), (60, 11), "each lift: a fork", words, edge=HUMAN)
for name, x, y, side, colour in (
    ("observation", 79, 21, "right", HUMAN),
    ("action", 85, 16, "left", ROBOT),
):
    axes.plot([74.5, x], [y, y], color=colour, linewidth=1.4)
    axes.text(x, 87, name, color=colour, ha=side, size=8)
axes.plot([79, 79], [86, 21], color=HUMAN, linewidth=1.4)
arrow(axes, (85, 16), (85, 86), colour=ROBOT)
arrow(axes, (79, 21), (74, 21), colour=HUMAN)
write(figure)
