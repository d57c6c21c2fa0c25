"""
A recorded motion as the human
==============================

A recording of a hand becomes the plan of a simulated human: scaled to the table, smoothed, slowed
down if it is too fast, and brought back to rest. This one is made up; yours comes from a CSV file.
"""

import dataclasses

import numpy as np
from colift.agents.humans import Recorded, Recording
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.rendering.style import FAINT, HUMAN, ROBOT, style_axes
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite
from matplotlib import pyplot as plt

time = np.arange(0, 2.4, 1 / 60)
height = 0.9 + 0.45 / (1 + np.exp(-6 * (time - 1.1))) + 0.02 * np.sin(5 * time)
recording = Recording(name="box", times=tuple(time.tolist()), heights=tuple(height.tolist()))

# %%
# ``colift.agents.humans.load_recordings`` reads such recordings from a file with the columns
# ``trial,t_s,z_m``.

human = Recorded(recording=recording)
scenario = dataclasses.replace(make_scenario("smooth"), behaviour="recorded", human=human)
suite = Suite(name="one recording", scenarios=(scenario,), seeds=(0,))
trace = run_suite(PolicySpec(text="anticipate"), suite).episodes[0].trace

figure = plt.figure(figsize=(9, 3.8), layout="constrained")
left, right = figure.subplots(1, 2, width_ratios=(1, 2))
left.plot(time, height, color=FAINT)
left.set(xlabel="time [s]", ylabel="height of the hand [m]", title="recorded")
seconds = np.arange(1, len(trace.target) + 1) / 100
right.plot(seconds, 1000 * trace.human_end, color=HUMAN, label="human's end")
right.plot(seconds, 1000 * trace.robot_end, color=ROBOT, label="robot's end")
right.set(xlabel="time [s]", ylabel="height [mm]", title="lifted with a robot")
right.legend(frameon=False)
for axes in (left, right):
    style_axes(axes)
    axes.title.set_size(11)
plt.show()
