"""A lift with a ball on the table, and a human who steers it to a target."""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from colift.agents.agent import HISTORY, Agent, Observation
from colift.agents.humans.ball import BallPlan, Steerer, steering_manner, with_ball
from colift.benchmark.episode.lift import MOCAP_NOISE
from colift.benchmark.tasks.haptic import HapticLift
from colift.benchmark.world import HISTORY_FRAMES, Intended
from colift.benchmark.world.table import TABLE_LENGTH

STEEPEST_MEANT: Final = 0.5
"""Largest sine of an intended pitch; people's intentions stay far below it."""


class BallLift(HapticLift):
    """A lift whose human also has a target for the ball.

    The human intends the height difference that the human's own end makes: reflexes correct
    deviations from it, and the wrists turn with its pitch according to the person's manner
    (:class:`.SteeringManner`).
    """

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``, as :meth:`.HapticLift.reset`."""
        super().reset(seed)
        plan = self.plan
        shown = isinstance(plan, BallPlan) and plan.shown
        place = plan.place if isinstance(plan, BallPlan) else np.zeros(1)
        self.shown = shown
        """Whether both know the target."""
        self.place = np.concatenate((place, np.full(self.horizon - len(place), place[-1])))
        """(horizon,) intended place of the ball at the end of each frame [m]."""
        rng = np.random.default_rng(self.role_seed("ball sensor"))
        self._ball_noise = rng.normal(0.0, MOCAP_NOISE, HISTORY_FRAMES + self.horizon).tolist()
        manner = steering_manner(self.scenario.subject)
        self._wrist = manner.wrist / manner.share
        self._moved = 0

    def scripted_human(self) -> Agent:
        """Return the person who lifts and steers, reset for the episode."""
        human = Steerer(subject=self.scenario.subject)
        human.reset(self.role_seed("human"))
        return human

    def intended_in(self, human: Sequence[float]) -> Intended:
        """Return the person's intention in the frames of some hand references."""
        target = self.target[self._moved : self._moved + len(human)].tolist()
        meant = [height - mine for height, mine in zip(target, human, strict=True)]
        limit = STEEPEST_MEANT * TABLE_LENGTH
        pitches = [
            math.asin(min(max(self._wrist * each, -limit), limit) / TABLE_LENGTH) for each in meant
        ]
        self._moved += len(human)
        return meant, pitches

    def coming_places(self) -> Observation:
        """Return the intended place of the ball [m] at the end of each of the next ten frames."""
        coming = np.arange(self.frame, self.frame + HISTORY)
        return np.asarray(self.place[np.minimum(coming, self.horizon - 1)])

    def ball_view(self) -> tuple[float, float, float]:
        """Return the robot's view: the ball's place, its target, and whether that is known."""
        age = self.scenario.latency_frames
        noise = self._ball_noise[self.frame + HISTORY_FRAMES - 1 - age]
        target = float(self.coming_places()[0]) if self.shown else 0.0
        return self.world.ball_place[-1 - age] + noise, target, float(self.shown)

    def person_view(self, view: Observation, *, far: bool) -> Observation:
        """Return a person's senses with the ball before them; see :func:`.with_ball`.

        Parameters
        ----------
        view
            The other senses.
        far
            Whether it is the second human, who knows the target only if both do.
        """
        delays = self._partner_delays if far else self._human_delays
        seen = len(self.world.ball_place) - delays[0]
        places = self.world.ball_place[seen - HISTORY : seen]
        known = self.shown or not far
        return with_ball(view, places, self.coming_places() if known else None)
