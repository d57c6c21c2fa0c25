"""
Error over latency
==================

The mean error of two policies when motion capture arrives earlier or later than the standard
100 ms. ``anticipate`` was learned at 100 ms; ``colift sweep`` learns it anew at each latency.
"""

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.rendering.style import INK, ROBOT, style_axes
from colift.benchmark.suites.suite import make_suite
from matplotlib import pyplot as plt

LATENCIES = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)

# %%
# Every point is the mean of the same lifts: people, plans and noise do not depend on the latency.

suite = make_suite("quick-v1").with_seeds(0, 2)

figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
for policy, colour, marker in (("copy", INK, "s"), ("anticipate", ROBOT, "o")):
    errors = []
    for latency in LATENCIES:
        run = run_suite(PolicySpec(text=policy), suite.with_timing(latency, None))
        errors.append(np.mean([episode.scores["rmse_mm"] for episode in run.episodes]))
    axes.plot(1000 * np.array(LATENCIES), errors, color=colour, marker=marker, label=policy)
axes.set(xlabel="latency of motion capture [ms]", ylabel="RMSE [mm]", ylim=(0, None))
style_axes(axes)
axes.legend(frameon=False)
plt.show()
