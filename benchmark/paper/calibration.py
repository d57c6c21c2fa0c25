"""Fitting the few free numbers of the simulated set-up to the paper's results.

The paper states neither the lift heights of its subjects nor Q, and only one RMSE of two people
lifting together. The fitted numbers are the mean lift height of each subject (so that ``reactive``
and ``blend`` together have the error of the subject's row of Table I), q (so that the ratio of the
two columns is the paper's), and the partner's lag (so that two people have 6.531 mm).
The paper gives eleven numbers for these seven; the rest of Table I is not fitted and shows how well
the set-up reproduces the experiment.
"""

import dataclasses
import json
import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

import numpy as np
from colift.agents.calibration import CALIBRATION, Calibration
from colift.agents.control.predictor import PredictorParameters
from colift.agents.estimators.motion_filter import MotionFilterParameters
from colift.agents.humans import GOAL_RANGE, SecondPerson
from colift.agents.humans.second_person import SecondPersonParameters
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.agents.policies.blend import Blend
from colift.agents.spec import AgentSpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.paper.table_one import HUMAN_HUMAN_RMSE, WITH_PREDICTION, WITHOUT_PREDICTION
from colift.benchmark.suites.suite import Suite, make_suite

TABLE_1: Final = {
    name: (WITHOUT_PREDICTION[name], WITH_PREDICTION[name]) for name in WITHOUT_PREDICTION
}
"""Average RMSE of each subject without and with prediction [mm] (Table I)."""

SEEDS: Final = (50_000, 50_060)
"""Seeds of the calibration, far from those of the suites: 60 lifts per subject."""

ROUNDS: Final = 4
"""Rounds of the fit; each corrects all numbers at once by the errors of the last one."""

RATIO_SLOPE: Final = -0.11
"""Change of the ratio of Table I's columns with the logarithm of q."""

LAG_SLOPE: Final = 25.0
"""Change of the human-human RMSE with the partner's lag [mm/s]."""


def _blend(process_noise: float) -> InMemorySpec:
    """Return the paper's policy with another q."""
    motion = MotionFilterParameters(process_noise=process_noise)
    factory = partial(Blend, parameters=PredictorParameters(motion=motion))
    return InMemorySpec(name="blend", factory=factory, source=Blend)


def _partner(lag: float) -> InMemorySpec:
    """Return the second human with another lag [s]."""
    factory = partial(SecondPerson, parameters=SecondPersonParameters(lag=lag))
    return InMemorySpec(name="partner", factory=factory, source=SecondPerson)


@dataclass(frozen=True, kw_only=True)
class Fit:
    """One round: the parameters and the resulting errors."""

    calibration: Calibration
    without: dict[str, float]
    """Mean RMSE of ``reactive`` for each subject [mm]."""
    with_prediction: dict[str, float]
    """Mean RMSE of ``blend`` for each subject [mm]."""
    human_human: float
    """Mean RMSE of two people [mm]."""

    @property
    def worst_cell(self) -> float:
        """Largest relative error of a cell of Table I."""
        return max(
            max(abs(self.without[name] / row[0] - 1), abs(self.with_prediction[name] / row[1] - 1))
            for name, row in TABLE_1.items()
        )


def fit_rounds(
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Iterator[Fit]:
    """Fit the free numbers and yield each round; the last one is the result."""
    current = CALIBRATION
    for _ in range(ROUNDS):
        fit = _measure(current, executor, progress)
        yield fit
        current = _correct(fit)


def episodes() -> int:
    """Return the number of episodes that :func:`fit_rounds` plays."""
    return ROUNDS * 3 * len(TABLE_1) * (SEEDS[1] - SEEDS[0])


def calibration_json(fit: Fit) -> str:
    """Return the content of the file of calibrated numbers."""
    content: dict[str, Any] = {
        "amplitude_m": fit.calibration.amplitude,
        "process_noise_mm2_s6": fit.calibration.process_noise,
        "partner_lag_s": fit.calibration.partner_lag,
        "provenance": {
            "command": "colift calibrate",
            "fitted_to": "Thobbi, Gu, Sheng 2011: Table I and the human-human RMSE of section V",
            "seeds": list(SEEDS),
            "rmse_without_prediction_mm": fit.without,
            "rmse_with_prediction_mm": fit.with_prediction,
            "rmse_human_human_mm": fit.human_human,
        },
    }
    return json.dumps(content, indent=2) + "\n"


def _measure(
    calibration: Calibration, executor: Executor | None, progress: Callable[[int], None]
) -> Fit:
    suite = make_suite("paper-v1").with_seeds(*SEEDS)
    scenarios = tuple(
        dataclasses.replace(
            scenario,
            subject=dataclasses.replace(
                scenario.subject, amplitude=calibration.amplitude[scenario.subject.name]
            ),
        )
        for scenario in suite.scenarios
    )
    suite = dataclasses.replace(suite, scenarios=scenarios)

    def means(spec: AgentSpec, played: Suite) -> dict[str, float]:
        run = run_suite(spec, played, executor=executor, progress=progress)
        return {
            name: float(np.mean([e.scores["rmse_mm"] for e in run.episodes if e.subject == name]))
            for name in TABLE_1
        }

    human_human = means(_partner(calibration.partner_lag), suite.with_partner("human"))
    return Fit(
        calibration=calibration,
        without=means(PolicySpec(text="reactive"), suite),
        with_prediction=means(_blend(calibration.process_noise), suite),
        human_human=float(np.mean(list(human_human.values()))),
    )


def _correct(fit: Fit) -> Calibration:
    """Return the numbers of the next round.

    Errors are proportional to the speed of a lift, so heights are scaled by the (geometric) mean
    relative error of the two cells of a row; q and the lag are corrected along slopes.
    """
    old = fit.calibration
    low, high = GOAL_RANGE
    amplitude = {}
    for name, row in TABLE_1.items():
        missing = (row[0] * row[1] / (fit.without[name] * fit.with_prediction[name])) ** 0.5
        height = min(max(old.amplitude[name] * missing, low + 0.05), high - 0.02)
        amplitude[name] = round(height, 4)
    wanted = sum(row[1] for row in TABLE_1.values()) / sum(row[0] for row in TABLE_1.values())
    factor = math.exp((wanted - _ratio(fit)) / RATIO_SLOPE)
    lag = old.partner_lag + (HUMAN_HUMAN_RMSE - fit.human_human) / LAG_SLOPE
    return Calibration(
        amplitude=amplitude,
        process_noise=float(f"{old.process_noise * factor:.3g}"),
        partner_lag=round(lag, 5),
        provenance=old.provenance,
    )


def _ratio(fit: Fit) -> float:
    """Return the ratio of the columns' means, with over without prediction."""
    return sum(fit.with_prediction.values()) / sum(fit.without.values())
