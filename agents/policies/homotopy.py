"""A leader, a follower, and a continuous transition between them."""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import Predictor, PredictorParameters
from colift.agents.estimators.gain_control import gain_control
from colift.base.errors import InputError


@dataclass(frozen=True, kw_only=True)
class HomotopyParameters:
    """Parameters of :class:`Homotopy`.

    Rate and gain were chosen by the RMSE on the standard suite's scenarios with seeds of no suite
    (5000 to 5002), which is flat around them and higher at a rate of 0.25 or 5 and a gain of 5.
    """

    times: tuple[float, ...] = ()
    """Breakpoints of a given alpha [s since the start of the episode], increasing. If empty, alpha
    follows the confidence."""
    alphas: tuple[float, ...] = ()
    """The given alpha at each breakpoint, in [0, 1]: linear between two, constant outside."""
    rate: float = 1.0
    """Largest rate of an alpha that follows the confidence [1/s]: the change from follower to
    leader takes at least 1 / rate seconds."""
    gain: float = 20.0
    """Rate at which the follower reduces a height difference [1/s]."""
    latency: float = 0.1
    """Assumed age of the seen heights [s], for which the leader compensates."""
    predictor: PredictorParameters = field(default_factory=PredictorParameters)
    """Prediction of the human's motion, and the confidence in it."""

    def __post_init__(self) -> None:
        """Check the ranges.

        Raises
        ------
        InputError
            If the schedule is invalid, rate or gain is not positive, or the latency is negative.
        """
        if len(self.times) != len(self.alphas):
            raise InputError(
                f"times and alphas must have the same length, got {len(self.times)} and "
                f"{len(self.alphas)}"
            )
        rising = all(before < after for before, after in itertools.pairwise(self.times))
        if not (rising and all(map(math.isfinite, self.times))):
            raise InputError(f"times must be increasing numbers, got {self.times}")
        if not all(0 <= alpha <= 1 for alpha in self.alphas):
            raise InputError(f"alphas must be in [0, 1], got {self.alphas}")
        for name in ("rate", "gain"):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(f"{name} must be a positive number, got {getattr(self, name)}")
        if not 0 <= self.latency < math.inf:
            raise InputError(f"latency must be a number of at least 0, got {self.latency}")


class Homotopy:
    """Changes between leader and follower continuously (Evrard, Kheddar 2009).

    The action is u = alpha(t) L + (1 - alpha(t)) F with a continuous alpha in [0, 1] (Evrard and
    Kheddar, "Homotopy switching model for dyad haptic interaction in physical collaborative tasks",
    World Haptics 2009, and "Homotopy-based controller for physical human-robot interaction",
    RO-MAN 2009). L acts by a plan of its own, independent of the partner's present motion;
    F acts by the partner's intention alone. The authors give alpha as a function of time; here it
    may be given (``times``, ``alphas``), or it follows, at a limited rate, the confidence of eq. 7,
    by which Thobbi, Gu and Sheng (2011) adjust it automatically.

    This follows the abstracts and the account of Thobbi, Gu and Sheng (section I). The authors'
    controllers were not available to us and would not apply: their robot measures forces, and its
    leader knows the goal. The controllers here use what a robot policy observes:

    * L goes to the plan: the predicted height of the human at the end of the coming period, when
      the command is carried out. It uses its own command, not the table.
    * F reduces the difference between the seen human's end and its own hand (encoders) at the rate
      ``gain``, like a spring to the human with a damper.
    """

    def __init__(self, *, parameters: HomotopyParameters | None = None) -> None:
        self._parameters = parameters or HomotopyParameters()
        self._predictor = Predictor(self._parameters.predictor)

    def reset(self, seed: int) -> None:
        """Begin an episode as a follower, unless a given alpha says otherwise."""
        self._predictor.reset()
        self._alpha = 0.0

    def act(self, observation: Observation) -> Action:
        """Return the leader's and the follower's action, weighted by alpha [m]."""
        _, confidence = self._predictor.step(observation)
        period = self._predictor.period
        plan = self._predictor.ahead(self._parameters.latency + period).height
        leader = plan - float(observation[RobotObservation.HAND_COMMAND])
        human = float(observation[RobotObservation.HUMAN_END])
        hand = float(observation[RobotObservation.HAND_HEIGHT])
        follower = -math.expm1(-self._parameters.gain * period) * (human - hand)
        self._alpha = self._next_alpha(confidence, float(observation[RobotObservation.TIME]))
        self._internals = {
            "prediction": plan,
            "leader": leader,
            "follower": follower,
            "confidence": confidence,
            "role": self._alpha,
        }
        return np.array([gain_control(self._alpha, leader, follower)])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action: plan, actions [m], confidence, alpha.

        The role is alpha: 1 for a leader and 0 for a follower.
        """
        return self._internals

    def _next_alpha(self, confidence: float, time: float) -> float:
        """Return alpha at a time [s], from the schedule or from the confidence."""
        parameters = self._parameters
        if parameters.times:
            return float(np.interp(time, parameters.times, parameters.alphas))
        # A clock may be set back; alpha must stay in [0, 1] even then.
        change = parameters.rate * abs(self._predictor.period)
        return min(max(confidence, self._alpha - change), self._alpha + change)
