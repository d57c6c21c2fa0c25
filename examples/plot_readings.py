"""
The paper's ambiguous places
============================

Four readings of the paper's text, and how level and smooth a lift is with each.
"""

import colift
import numpy as np
from colift.agents.control.predictor import PredictorParameters
from colift.agents.estimators.motion_filter import MotionFilterParameters
from colift.agents.policies.blend import Blend

READINGS = {
    "literal": PredictorParameters(),
    "rho = standard deviation": PredictorParameters(reading="standard deviation as rho"),
    "R = 0.49 mm2": PredictorParameters(motion=MotionFilterParameters(measurement_noise=0.49)),
    "Q on the acceleration": PredictorParameters(
        motion=MotionFilterParameters(noise_enters="acceleration")
    ),
}

print("| reading | RMSE mm | SPARC | mean confidence |\n|---|---|---|---|")
for name, parameters in READINGS.items():
    found = colift.evaluate(Blend(parameters=parameters), suite="paper-v1")
    episodes = found.run.episodes
    sparc = np.nanmean([episode.scores["sparc"] for episode in episodes])
    confidence = np.concatenate([e.trace.internals["confidence"] for e in episodes]).mean()
    print(f"| {name} | {found.rmse_mm:.2f} | {sparc:.2f} | {confidence:.2f} |")
