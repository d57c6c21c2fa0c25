"""A lift as a person's rules see it, from lists of what has been."""

from dataclasses import dataclass, field

import numpy as np
from colift.agents.humans.hand import HandMemory, HandNoise, carry_out
from colift.agents.rules import SCALARS, Drawn, NumberSeries


@dataclass
class Past:
    """The view of a person to whom everything was at rest but what ``read`` says."""

    visual: int = 15
    haptic: int = 6
    latency: int = 10
    frame: int = 0
    hand: float = 0.0
    command: float = 0.0
    read: dict = field(default_factory=dict)

    def seen(self, name, age):
        series = self.read.get(name, ())
        return series[-1 - age] if age < len(series) else 0.0


def drawn_of(target, manner, series=(), facts=(), chance=()):
    """Return what was drawn, from arrays (n,) and records of numbers."""
    kinds = [type(each)(*map(NumberSeries.of, each)) if each else each for each in (series, chance)]
    return Drawn(NumberSeries.of(np.asarray(target)), kinds[0], facts, kinds[1], manner)


class Walking:
    """Carries out a person's intentions step by step, without noise."""

    def __init__(self, person, drawn, frames=10):
        self.person, self.drawn, self.frames = person, drawn, frames
        self.memory = person.begin(SCALARS, 0.0, False)
        self.hand = HandMemory(0.0, 0.0, 0.0)

    def step(self, view):
        """Return the hand's references in a step; the view then has the intention too."""
        self.memory, intention = self.person.intend(
            SCALARS, self.drawn, self.memory, view, self.frames
        )
        nothing = HandNoise([0.0] * self.frames, [0.0] * self.frames)
        self.hand, references = carry_out(SCALARS, self.hand, view, intention.target, nothing)
        for name, column in intention._asdict().items():
            view.read[name] = [*view.read.get(name, ()), *column]
        view.frame += self.frames
        return references
