"""The motion of a table over the frames of a step, in parts that the reflexes cannot notice."""

from typing import Any

import jax
import jax.numpy as jnp
from colift.benchmark.tasks.touch import Ends
from colift.benchmark.twin.arm import ArmVariation
from colift.benchmark.twin.ball_plant import BallPlant, advance_ball_plant
from colift.benchmark.twin.body import Body
from colift.benchmark.twin.haptic_plant import HapticPlant, Meant, advance_haptic_plant
from colift.benchmark.twin.lifts import chunk
from colift.benchmark.twin.plant import Plant, advance_plant

Table = Plant | HapticPlant | BallPlant


def moved_table(
    table: Table,
    body: Body,
    meant: Meant,
    commands: jax.Array,
    variation: ArmVariation | None,
) -> tuple[Table, Ends]:
    """Return the table after a step, and its read-outs in each frame (f, n).

    Parameters
    ----------
    table
        The table.
    body
        The people.
    meant
        Their intention in each frame (f, n).
    commands
        (f, n) commanded height of the far hands at the end of each frame [m].
    variation
        Variation of the arms; None is the benchmark's arms.
    """
    size, parts = len(commands), []
    many, table = chunk(size), unpulled(table)
    for first in range(0, size, many):
        frames = slice(first, first + many)
        some, due = Meant(*(each[frames] for each in meant)), commands[frames]
        ball = jnp.zeros_like(due)
        match table:
            case BallPlant():
                table = advance_ball_plant(table, body, some, due, variation)
                plant, ball = table.haptic.plant, table.places[:many][::-1]
            case HapticPlant():
                table, _, _ = advance_haptic_plant(table, body, some, due, variation)
                plant = table.plant
            case Plant():
                table = plant = advance_plant(table, body, some.reference, due, variation)
        near = plant.heights[:many][::-1]
        parts.append(Ends(near, near + plant.differences[:many][::-1], ball))
    return table, Ends(*map(jnp.concatenate, zip(*parts, strict=True)))


def unpulled(table: Any) -> Any:
    """Return the table with a new sum of the far hands' force."""
    match table:
        case BallPlant(haptic=haptic):
            return table._replace(haptic=unpulled(haptic))
        case HapticPlant(plant=plant):
            return table._replace(plant=unpulled(plant))
        case Plant(moving=moving):
            return table._replace(moving=moving._replace(pulled=jnp.zeros_like(moving.pulled)))
