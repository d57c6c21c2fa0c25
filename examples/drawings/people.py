"""One lift, five people: the heights that they intend, and those of their ends of the table."""

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.rendering.style import style_axes
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from sheet import WIDTH, legend, plt, write

PEOPLE = ("S1", "S2", "S3", "S4", "S5")

# Distinct with any kind of colour vision (M. Okabe and K. Ito, "Color universal design", 2008).
COLOURS = ("#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7")

scenarios = tuple(make_scenario("pause", name) for name in PEOPLE)
run = run_suite(PolicySpec(text="learned"), Suite(name="people", scenarios=scenarios, seeds=(3,)))

figure, axes = plt.subplots(figsize=(WIDTH, 3.0), layout="constrained")
for colour, episode in zip(COLOURS, run.episodes, strict=True):
    trace = episode.trace
    time = np.arange(1, len(trace.human_end) + 1) / 100
    axes.plot(time, 1000 * trace.target, color=colour, linewidth=0.8, linestyle=(0, (3, 2)))
    axes.plot(time, 1000 * trace.human_end, color=colour, linewidth=1.6, label=episode.subject)
axes.set(xlabel="time [s]", ylabel="height of the human's end [mm]", xlim=(0, None))
style_axes(axes)
legend(axes)
write(figure)
