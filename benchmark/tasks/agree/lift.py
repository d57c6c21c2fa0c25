"""A lift in which each holder has a private hurdle."""

import numpy as np
from colift.agents.agent import FRAME, Agent
from colift.agents.humans.agree import Hurdle, HurdlePlan, Negotiator, Secret
from colift.benchmark.tasks.haptic import HapticLift
from numpy.typing import NDArray


class AgreeLift(HapticLift):
    """A lift in which each end may have a hurdle on the way; other plans have none."""

    def reset(self, seed: int) -> None:
        """Begin the episode ``seed``, as :meth:`.HapticLift.reset`."""
        super().reset(seed)
        plan = self.plan
        own, other = (plan.own, plan.other) if isinstance(plan, HurdlePlan) else (None, None)
        self.human_hurdle: Hurdle | None = own
        """The human's hurdle, or None."""
        self.robot_hurdle: Hurdle | None = other
        """The hurdle of the robot's end, or None."""
        whole = 0, self.horizon
        self.agreeing = slice(*(plan.agreeing if isinstance(plan, HurdlePlan) else whole))
        """The frames in which there is something to agree on."""

    def scripted_human(self) -> Agent:
        """Return the person who has a hurdle to pass, reset for the episode."""
        human = Negotiator(subject=self.scenario.subject)
        human.reset(self.role_seed("human"))
        return human

    def secret(self, hurdle: Hurdle | None) -> Secret[float]:
        """Return a hurdle as its holder knows it now; all 0 if there is none."""
        if hurdle is None:
            return Secret(0.0, 0.0, 0.0, 0.0)
        start, stop = ((frame - self.frame) * FRAME for frame in hurdle[1:])
        return Secret(hurdle.height, start, stop, 1.0)

    def way_over(self, hurdle: Hurdle | None) -> NDArray[np.float64]:
        """Return the common way with a hurdle's height in its window [m], (horizon,)."""
        way = self.target.copy()
        if hurdle is not None:
            way[hurdle.start : hurdle.stop] = hurdle.height
        return way
