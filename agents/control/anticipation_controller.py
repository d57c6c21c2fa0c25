"""Control by anticipation: foresees the human, and plans the own commands by preview."""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from ..agent import FRAME, Action, Observation, RobotObservation
from ..errors import InputError
from .adaptive_impedance import certainty
from .anticipation import Anticipation
from .modes import MODES
from .preview import preview_gains
from .senses import ARM_LAG, Senses


@dataclass(frozen=True, kw_only=True)
class AnticipateParameters:
    """Parameters of :class:`.Anticipate`."""

    model: str | None = None
    """File that ``colift learn anticipate --out`` wrote; none: the one that is shipped."""
    foresight: float = 0.4
    """How far ahead commands are planned [s]."""
    smoothness: float = 0.1
    """What a bend of the command costs, relative to a height difference of its size that lasts for
    a period (:func:`.preview_gains`)."""
    arm_lag: float = ARM_LAG
    """Time by which the arm is taken to be behind its command [s]."""
    sag_memory: float = 0.1
    """Time in which the measured sag of the arm is forgotten [s]."""
    memory: float = 0.5
    """Time in which an error of the prediction is forgotten [s]; only for what the policy tells."""
    tolerance: float = 0.005
    """Error of a prediction at which it is half certain [m]; only for what the policy tells."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the smoothness or the lag is negative, or another number is not positive.
        """
        for name in ("smoothness", "arm_lag"):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise InputError(f"{name} must be a number of at least 0, got {value}")
        for name in ("foresight", "sag_memory", "memory", "tolerance"):
            value = getattr(self, name)
            if not 0 < value < math.inf:
                raise InputError(f"{name} must be a positive number, got {value}")


class AnticipationController:
    """Carries out what was learned; the equations are those of :class:`.Anticipate`.

    Parameters
    ----------
    model
        What was learned.
    parameters
        The rest.
    """

    def __init__(self, model: Anticipation, parameters: AnticipateParameters) -> None:
        self._model, self._parameters = model, parameters
        self._internals: dict[str, float] = {}

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._senses = Senses(self._model.window)
        self._sag = 0.0
        self._foreseen: deque[tuple[float, float]] = deque()
        self._squared_error = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the change of the command [m]."""
        parameters, model, senses = self._parameters, self._model, self._senses
        senses.see(observation)
        period = senses.period(model.window.interval)
        frames = max(round(period / FRAME), 1)
        steps = max(round(parameters.foresight / period), 1)

        foresight = model.foresee(senses.inputs())
        self._sag -= math.expm1(-period / parameters.sag_memory) * (senses.sag - self._sag)
        times = FRAME * np.arange(1, steps * frames + 1)
        coming = np.interp(times + parameters.arm_lag, model.leads, foresight.rises)
        law = preview_gains(frames, steps, parameters.smoothness)
        now = float(observation[RobotObservation.HAND_COMMAND])
        path = senses.height + self._sag + coming
        change = law(path, now, senses.command(period)) - now

        self._judge(senses.height, senses.time - model.latency, period)
        end, begin = np.interp((period, period - FRAME), model.leads, foresight.rises)
        self._foreseen.append((senses.time + period, senses.height + end))
        led = float(law.path @ coming)
        whole = abs(led) + abs(change - led)
        self._internals = {
            "prediction": senses.height + end,
            "predicted_velocity": (end - begin) / FRAME,
            "predicted_end": senses.height + foresight.stroke_rise,
            **dict(zip(MODES, foresight.modes.tolist(), strict=True)),
            "sag": self._sag,
            "confidence": certainty(self._squared_error, parameters.tolerance),
            "role": abs(led) / whole if whole else 0.0,
        }
        return np.array([change])

    def internals(self) -> dict[str, float]:
        """Return what the last action was based on, see :meth:`.Anticipate.internals`."""
        return self._internals

    def _judge(self, height: float, time: float, period: float) -> None:
        """Take in how far off the prediction was for the time of the newest sample."""
        while len(self._foreseen) > 1 and self._foreseen[1][0] <= time + FRAME / 2:
            self._foreseen.popleft()
        if self._foreseen and self._foreseen[0][0] <= time + FRAME / 2:
            times, heights = np.array(self._foreseen).T
            error = height - float(np.interp(time, times, heights))
            share = -math.expm1(-period / self._parameters.memory)
            self._squared_error += share * (error**2 - self._squared_error)
