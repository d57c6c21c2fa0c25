"""What the ambiguous places of the paper change: ``python examples/readings.py``."""

from dataclasses import dataclass, field

import numpy as np
from colift.agents.estimators.motion_filter import MotionFilterParameters
from colift.agents.policies.blend import Blend
from colift.agents.policies.in_process import InProcess
from colift.agents.policies.loading import source_digest
from colift.agents.policies.predictor import PredictorParameters
from colift.benchmark.runner import run_suite
from colift.benchmark.suite import make_suite


@dataclass(frozen=True, kw_only=True)
class Reading(InProcess):
    """The paper's policy, read in another way."""

    name: str
    parameters: PredictorParameters = field(default_factory=PredictorParameters)

    def check(self) -> None:
        """Do nothing: it is always there."""

    def digest(self) -> str:
        """Return the hash of the policy's source."""
        return source_digest(Blend)

    def make(self) -> Blend:
        """Return the policy."""
        return Blend(parameters=self.parameters)


READINGS = (
    Reading(name="literal"),
    Reading(
        name="rho = standard deviation",
        parameters=PredictorParameters(reading="standard deviation as rho"),
    ),
    Reading(
        name="R = 0.49 mm2",
        parameters=PredictorParameters(motion=MotionFilterParameters(measurement_noise=0.49)),
    ),
    Reading(
        name="Q on the acceleration",
        parameters=PredictorParameters(motion=MotionFilterParameters(noise_enters="acceleration")),
    ),
)

print("| reading | RMSE mm | SPARC | mean confidence |\n|---|---|---|---|")
for reading in READINGS:
    run = run_suite(reading, make_suite("paper-v1"))
    rmse = np.mean([episode.scores.rmse_mm for episode in run.episodes])
    sparc = np.nanmean([episode.scores.sparc for episode in run.episodes])
    confidence = np.concatenate([e.trace.internals["confidence"] for e in run.episodes]).mean()
    print(f"| {reading.name} | {rmse:.2f} | {sparc:.2f} | {confidence:.2f} |")
