"""Robots that are controlled by torque instead of position: a claim (section V.A)."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.benchmark.episode.loop import Episode
from colift.benchmark.execution.runner import Run
from colift.benchmark.paper.evidence import Evidence
from colift.benchmark.paper.exhibits import Claim, p_value_text
from colift.benchmark.paper.table_one import errors, single_lifts
from colift.benchmark.robots.robot import make_robot
from colift.benchmark.statistics import paired_permutation_p
from numpy.typing import NDArray

Series = NDArray[np.float64]

SMALL: Final = 0.01
"""Largest p-value of a difference."""


def torque_claims(evidence: Evidence) -> list[Claim]:
    """Return the claim about robots that are controlled by velocity or torque."""
    arm = evidence.torque
    name = arm.blend.suite.scenarios[0].partner
    smooth, jerk = (_of(arm.blend, metric) for metric in ("sparc", "ldlj"))
    servo, servo_jerk = (_same(evidence.blend, arm.blend, each) for each in ("sparc", "ldlj"))
    p = paired_permutation_p(smooth, servo, single_lifts(smooth))
    gains = [
        float(errors(blend).mean() / errors(reactive).mean())
        for blend, reactive in (
            (arm.blend.episodes, arm.reactive.episodes),
            (_chosen(evidence.blend, arm.blend), _chosen(evidence.reactive, arm.blend)),
        )
    ]
    smoother = bool(smooth.mean() > servo.mean() and p < SMALL)
    return [
        Claim(
            claim="Robots that are controlled by velocity or torque yield smoother motions and "
            "better improvements.",
            figure="section V.A",
            paper="a speculation, in words",
            criterion="with prediction, mean SPARC of the robot's end higher than with the NAO, "
            "paired p < 0.01, and the RMSE with prediction a smaller part of that without",
            measured=f"{make_robot(name).label} ({make_robot(name).control}) SPARC "
            f"{smooth.mean():.2f} against {servo.mean():.2f} ({p_value_text(p)}), LDLJ "
            f"{np.nanmean(jerk):.1f} against {np.nanmean(servo_jerk):.1f}; RMSE with / without "
            f"prediction {gains[0]:.2f} against {gains[1]:.2f}",
            values={
                "torque_sparc": float(smooth.mean()),
                "servo_sparc": float(servo.mean()),
                "p": p,
                "torque_ratio": gains[0],
                "servo_ratio": gains[1],
            },
            holds=smoother and gains[0] < gains[1],
            note="Both robots get the same changes of a height ten times a second. An arm that "
            "follows them more quickly shows their steps more clearly.",
        )
    ]


def _chosen(run: Run, as_in: Run) -> Sequence[Episode]:
    """Return the episodes of a run that are the same lifts as those of another."""
    wanted = {(each.behaviour, each.subject, each.seed) for each in as_in.episodes}
    return [each for each in run.episodes if (each.behaviour, each.subject, each.seed) in wanted]


def _of(run: Run, metric: str) -> Series:
    return np.array([each.scores[metric] for each in run.episodes])


def _same(run: Run, as_in: Run, metric: str) -> Series:
    return np.array([each.scores[metric] for each in _chosen(run, as_in)])
