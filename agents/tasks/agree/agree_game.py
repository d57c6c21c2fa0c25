"""The negotiator: infers where the human goes, and goes first, gives way or comes along."""

from dataclasses import dataclass, field
from typing import Final

import numpy as np
from colift.agents.agent import Action, Observation
from colift.agents.policies.anticipate import Anticipate
from colift.agents.ranges import Positive, Probability, check_ranges
from colift.agents.tasks.agree.approach import Approach, HurdleWatch
from colift.agents.tasks.agree.belief import BeliefParameters, GoalBelief
from colift.agents.tasks.agree.observation import AgreeObservation
from colift.agents.tasks.agree.touched_end import TouchedEnd

SAME: Final = 0.015
"""Distance within which two goals count as the same [m]."""

LIFTED: Final = 0.1
LOWERED: Final = 0.06
"""Heights above which a rest is at the common height, and below which the table is lowered [m]."""

SLOW: Final = 0.05
"""Speed below which the human's end rests [m/s]."""

STILL: Final = 0.25
"""Time at rest after which its height is taken as the common one [s]."""

LEVEL: Final = 0.01
"""Height difference within which the table is level [m]."""

SMALL: Final = 0.003
"""Change of the command up to which the hand has followed it, so that the rest is sag [m]."""


@dataclass(frozen=True, kw_only=True)
class AgreeGameParameters:
    """Parameters of :class:`AgreeGame`, tuned by ``colift admit agree-v1 --tune``."""

    early: Positive = 0.35
    """Time before its window opens at which it may set out [s]."""
    lead: Positive = 0.06
    """Time by which the human's end is extrapolated while it is followed [s]."""
    apart: Probability = 0.325
    """Probability that the human has a goal of its own from which the robot gives way."""
    served: Positive = 0.7
    """Time that the table rests at the human's goal until that hurdle counts as passed [s]."""
    needed: Positive = 0.91
    """Time before the end of its window from which it no longer gives way [s]."""
    respite: Positive = 0.21
    """Time for which it does not give way again after it has let the human go first [s]."""
    pace: Positive = 8.0
    """Natural frequency of the approach [rad/s]."""
    belief: BeliefParameters = field(
        default_factory=lambda: BeliefParameters(pace=3.5, noise=0.028, along=0.56)
    )
    """The filter of the human's goal."""

    def __post_init__(self) -> None:
        """Check the ranges; see :mod:`colift.agents.ranges`."""
        check_ranges(self)


class AgreeGame:
    """Plays the game of two hurdles with a belief about the human's goal (ours).

    **Touch.** The torque at its hands gives the incline of the table, and with it the present
    height of the human's end, which motion capture shows a latency later (:class:`.TouchedEnd`).

    **Belief.** A hidden Markov model over the human's goals: to come along, or to go to a height of
    its own (:class:`.GoalBelief`).

    **Turn.** It sets out first, by the linear-quadratic regulator, unless the human already goes
    elsewhere. If the human turns elsewhere while the robot is on its way, one of the two has to
    give way, or both miss their hurdles; the robot gives way at once, as it feels a conflict before
    a person sees it. Once the table rests at the human's goal, it sets out again. Near the end of
    its window it no longer gives way.

    **Level.** Away from the hurdles it keeps level by :class:`.Anticipate`; at the common height by
    touch, with the human's velocity extrapolated.
    """

    def __init__(self, *, parameters: AgreeGameParameters | None = None) -> None:
        self._parameters = parameters or AgreeGameParameters()
        self._keeper = Anticipate()

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._keeper.reset(seed)
        self._touch = TouchedEnd()
        self._approach = Approach(self._parameters.pace)
        self._hurdle = HurdleWatch()
        self._belief = GoalBelief(self._parameters.belief)
        self._common: float | None = None
        self._sag = self._change = self._still = self._rested = self._respite = 0.0
        self._last = 0.0, 0.0, -0.1
        self._yields = False

    def act(self, observation: Observation) -> Action:
        """Return the change of the hand command [m]."""
        layout, touch = AgreeObservation, self._touch
        kept = float(self._keeper.act(observation)[0])
        self._hurdle.see(observation)
        touch.update(observation)
        time = float(observation[layout.TIME])
        hand = float(observation[layout.HAND_HEIGHT])
        command = float(observation[layout.HAND_COMMAND])
        before, mine, since = self._last
        self._last = touch.height, hand, time
        period = time - since
        if abs(self._change) < SMALL:
            self._sag += 0.5 * (command - hand - self._sag)
        self._find_common(period)
        if self._common is None:
            self._belief.forget()
        else:
            self._belief.update(before, touch.height, mine, self._common, period)
            ahead = touch.height + self._parameters.lead * touch.velocity
            kept = ahead + self._sag - command
        led = self._approach.change(command, self._hurdle.height + self._sag, time)
        leads = self._decide(hand, period)
        self._change = led if leads else kept
        self._internals = {
            "prediction": touch.height + self._parameters.lead * touch.velocity,
            "human_goal": (self._common or 0.0) + self._belief.offset,
            "own_goal": self._belief.own_goal,
            "yields": float(self._yields),
            "role": float(leads),
        }
        return np.array([self._change])

    def internals(self) -> dict[str, float]:
        """Return the quantities behind the last action.

        The human's height a little ahead and the human's expected goal [m], the probability that
        the human has a goal of its own, and whether the robot gives way to it. The role is 1 on the
        way to the robot's own hurdle.
        """
        return self._internals

    def _find_common(self, period: float) -> None:
        """Take the height at which the human first comes to rest as the common one."""
        height, speed = self._touch.height, abs(self._touch.velocity)
        rests = speed < SLOW and height > LIFTED
        self._still = self._still + period if rests else 0.0
        if self._common is None and self._still >= STILL:
            self._common = height
        elif height < LOWERED:
            self._common = None

    def _decide(self, hand: float, period: float) -> bool:
        """Return whether to go to the robot's own hurdle now."""
        p, hurdle, touch = self._parameters, self._hurdle, self._touch
        if not hurdle.is_open(p.early):
            self._yields = False
            return False
        late = hurdle.stop <= p.needed
        elsewhere = self._elsewhere()
        self._respite = max(self._respite - period, 0.0)
        if not self._yields and elsewhere and not late and not self._respite:
            self._yields, self._rested = True, 0.0
        if self._yields:
            rests = abs(touch.velocity) < SLOW and abs(touch.height - hand) < LEVEL
            self._rested = self._rested + period if rests else 0.0
            if self._rested >= p.served or late or not elsewhere:
                self._yields, self._respite = False, p.respite
        return not self._yields

    def _elsewhere(self) -> bool:
        """Return whether the human goes to a goal that is not the robot's, and is not near it."""
        if self._common is None or self._belief.own_goal <= self._parameters.apart:
            return False
        goal = self._common + self._belief.offset
        return (
            min(abs(goal - self._hurdle.height), abs(self._touch.height - self._hurdle.height))
            > SAME
        )
