"""
The paper's ambiguous places
============================

Four readings of the paper's text, and how level, smooth and confident the lifts of ``paper-v1``
are with each. Bars are 95 % intervals of the mean RMSE.
"""

import colift
import numpy as np
from colift.agents.control.predictor import PredictorParameters
from colift.agents.estimators.motion_filter import MotionFilterParameters
from colift.agents.policies.blend import Blend
from colift.benchmark.rendering.style import ROBOT, style_axes
from matplotlib import pyplot as plt

READINGS = {
    "literal": PredictorParameters(),
    "rho = standard deviation": PredictorParameters(reading="standard deviation as rho"),
    "R = 0.49 mm2": PredictorParameters(motion=MotionFilterParameters(measurement_noise=0.49)),
    "Q on the acceleration": PredictorParameters(
        motion=MotionFilterParameters(noise_enters="acceleration")
    ),
}

figure = plt.figure(figsize=(9, 2.8), layout="constrained")
panels = figure.subplots(1, 3, sharey=True)
print("| reading | RMSE mm | SPARC | mean confidence |\n|---|---|---|---|")
for row, (name, parameters) in enumerate(READINGS.items()):
    found = colift.evaluate(Blend(parameters=parameters), suite="paper-v1")
    episodes = found.run.episodes
    sparc = np.nanmean([episode.scores["sparc"] for episode in episodes])
    confidence = np.concatenate([e.trace.internals["confidence"] for e in episodes]).mean()
    print(f"| {name} | {found.rmse_mm:.2f} | {sparc:.2f} | {confidence:.2f} |")
    panels[0].plot(found.rmse_mm_ci95, [row, row], color=ROBOT, linewidth=2)
    for panel, value in zip(panels, (found.rmse_mm, sparc, confidence), strict=True):
        panel.plot(value, row, "o", color=ROBOT)

for panel, label in zip(panels, ("RMSE [mm]", "SPARC", "mean confidence"), strict=True):
    panel.set_xlabel(label)
    panel.margins(x=0.15)
    style_axes(panel)
panels[0].set_yticks(range(len(READINGS)), READINGS)
panels[0].set_ylim(len(READINGS) - 0.5, -0.5)
plt.show()
