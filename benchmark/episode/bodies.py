"""What the world of a lift is made of: a person, a holder of the far end, and a table."""

from dataclasses import replace
from typing import NamedTuple

from colift.benchmark.episode.conditions import Drawn
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seat import body_parameters
from colift.benchmark.world.human_body import BodyParameters
from colift.benchmark.world.interface import Adjustable, FarEnd
from colift.benchmark.world.table import TABLE, Table


class Bodies(NamedTuple):
    """What a world is made of."""

    human: BodyParameters
    far_end: FarEnd
    table: Table


def bodies_of(scenario: Scenario, drawn: Drawn | None) -> Bodies:
    """Return the person, the holder of the far end, and the table of a lift."""
    human, far_end = body_parameters(scenario.subject), scenario.seat.body
    if drawn is None:
        return Bodies(human, far_end, TABLE)
    human = replace(
        human,
        stiffness=human.stiffness * drawn.stiffness,
        damping=human.damping * drawn.damping,
    )
    if isinstance(far_end, Adjustable) and (drawn.sag, drawn.gain) != (1.0, 1.0):
        far_end = far_end.with_arms(drawn.sag, drawn.gain)
    return Bodies(human, far_end, drawn.table)
