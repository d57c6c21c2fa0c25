"""
A person's parameter and its effect
===================================

The same person lifts in 1.5 to 3.5 s. All other parameters of the person and the seeds stay the
same, so the differences between the points come from the speed alone.
"""

import dataclasses

import numpy as np
from colift.agents.humans import SUBJECTS
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.rendering.style import INK, ROBOT, style_axes
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from matplotlib import pyplot as plt

DURATIONS = (1.5, 2.0, 2.5, 3.0, 3.5)


def person(duration):
    """Return a scenario with a person who lifts as S1 does, in another time [s]."""
    subject = dataclasses.replace(SUBJECTS["S1"], name=f"S1 {duration} s", duration=duration)
    return dataclasses.replace(make_scenario("smooth"), subject=subject)


# %%
# A suite is a tuple of scenarios and a tuple of seeds: here five people and four lifts of each.

suite = Suite(name="speeds", scenarios=tuple(map(person, DURATIONS)), seeds=(0, 1, 2, 3))

figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
for policy, colour, marker in (("copy", INK, "s"), ("anticipate", ROBOT, "o")):
    run = run_suite(PolicySpec(text=policy), suite)
    errors = np.reshape([each.scores["rmse_mm"] for each in run.episodes], (len(DURATIONS), -1))
    axes.plot(DURATIONS, errors, marker, color=colour, alpha=0.3, markeredgewidth=0)
    axes.plot(DURATIONS, errors.mean(axis=1), marker + "-", color=colour, label=policy)
axes.set(xlabel="mean duration of the upward stroke [s]", ylabel="RMSE [mm]", ylim=(0, None))
style_axes(axes)
axes.legend(frameon=False)
plt.show()
