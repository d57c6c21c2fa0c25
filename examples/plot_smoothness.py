"""
Smoothness against error
========================

How level and how smooth the lifts of several policies are, on ``quick-v1``. A policy that is
better at both stands further to the upper left.
"""

import colift
from colift.benchmark.rendering.style import FAINT, INK, ROBOT, style_axes
from matplotlib import pyplot as plt

POLICIES = ("anticipate", "blend", "copy", "extrapolate", "impedance", "proportional", "reactive")

figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
for policy in POLICIES:
    summary = colift.evaluate(policy, suite="quick-v1").results.summary
    error, smoothness = summary.rmse_mm, summary.metrics["sparc"].mean
    axes.plot(error.ci95, [smoothness] * 2, color=FAINT, linewidth=1, alpha=0.6)
    axes.plot(error.mean, smoothness, "o", color=ROBOT)
    axes.annotate(
        policy,
        (error.mean, smoothness),
        xytext=(0, 6),
        textcoords="offset points",
        ha="center",
        color=INK,
    )
axes.set_xlabel("RMSE [mm], with its 95 % interval: less is better")
axes.set_ylabel("SPARC: nearer to zero is smoother")
axes.margins(y=0.12)
style_axes(axes)
plt.show()
