"""The scene from the side: the NAO, the person and the table as flat shapes.

Everything comes from the simulation's robot model and from the person of the pictures; the page
only draws. Lengths are in m, x from the robot towards the human, z upwards; the origin is the
NAO's torso.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any, Final

import numpy as np
from colift.benchmark.rendering import mannequin
from colift.benchmark.rendering.scene import FLOOR, PEDESTAL
from colift.benchmark.robots.model import load_model
from colift.benchmark.robots.robot import DEFAULT_ROBOT, Robot, make_robot, robot_names
from colift.benchmark.world.bullet import pybullet
from colift.benchmark.world.table import FAR_GRIP, TABLE_LENGTH
from colift.robots.description import rotations
from colift.robots.description.parts import GREY, Shape
from colift.robots.nao import shapes as nao_shapes
from colift.robots.nao.facts import JOINTS, LINKS
from colift.robots.nao.kinematics import (
    GRIP_X,
    REST_Z,
    STROKE,
    hand_position,
    joint_positions,
    lifting_angles,
)
from colift.robots.nao.shapes import dressed
from numpy.typing import NDArray

ROWS: Final = 0.01
"""Height between two rows of a table of arms [m]; the page interpolates linearly."""

REACH: Final = (-0.10, 0.40)
"""Heights of a person's hands in the tables [m]."""

PLACES: Final = 4
"""Decimals of lengths: 0.1 mm."""

PAINTS: Final = {
    nao_shapes.WHITE: "white",
    nao_shapes.DARK: "dark",
    nao_shapes.ORANGE: "orange",
    nao_shapes.BLUE: "blue",
    GREY: "grey",
}
CLOTHES: Final = {
    mannequin.TROUSERS: "trousers",
    mannequin.SHOES: "shoes",
    mannequin.SKIN: "skin",
    mannequin.HAIR: "hair",
    mannequin.SHIRT: "shirt",
}
"""Names of the colours; the page has another set for dark mode."""

MOVING: Final = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand")
"""Joints from which on the NAO moves."""

ROUND: Final = 0.35
"""Radius of the corners of a box or a cylinder as a fraction of its shorter side."""

END_ON: Final = 0.9
"""A cylinder is drawn as a disc if the cosine between its axis and the line of sight is larger."""

SMALL: Final = 0.02
"""Radius below which a part is an eye, not a limb [m]; of the two eyes, one is visible."""

PROFILE: Final = 0.022
"""Distance by which the hair is drawn farther back than it is [m]: it covers the sides of the head,
and would hide the face in a side view."""

Flat = list[float | str]
Pose = Callable[[float], list[list[float]]]


@cache
def geometry() -> dict[str, Any]:
    """Return the scene.

    ``nao.body`` has a list for each link, the farthest first, of rectangles with round corners:
    ``[x, z, width, height, turn in degrees, radius of the corners, colour]``. ``person.body`` are
    rods between two balls: ``[x, z, radius, x, z, radius, width as a fraction of the height,
    colour]``, x ahead of the hands. ``arm`` has the places of shoulder, elbow, wrist and hand, in
    rows by the height of the hands above rest: the first at ``lowest``, each ``step`` above the
    one before. ``robots`` has the same of other robots than the NAO by name, from their base to
    their hand, and x and z of their ``foot``.
    """
    return {
        "floor": _rounded(FLOOR),
        "pedestal": PEDESTAL,
        "table": TABLE_LENGTH,
        "grip": [GRIP_X, REST_Z],
        "nao": {"body": _nao(), "arm": _rows(_nao_arm, STROKE)},
        "robots": {
            name: _chain(make_robot(name)) for name in robot_names() if name != DEFAULT_ROBOT
        },
        "person": {"body": _person(), "arm": _rows(_person_arm, REACH)},
    }


def _nao() -> list[list[Flat]]:
    """Return the links that do not move, as seen from the robot's right, from -y."""
    links = []
    for name, origin in _still_links().items():
        shapes = [_seen(shape, origin) for shape in dressed(LINKS[name]).visuals]
        if shapes:
            shapes.sort(key=lambda each: -each[0])
            links.append((origin[1], [flat for _, flat in shapes]))
    return [flats for _, flats in sorted(links, key=lambda each: -each[0])]


def _seen(shape: Shape, origin: NDArray[np.float64]) -> tuple[float, Flat]:
    """Return y of the part of a shape that is nearest to the viewer, and its visible outline.

    For a ball, y is that of the centre: parts that stick out in front are nearer than its edge.
    """
    turn = rotations.from_rpy(shape.rpy)
    x, y, z = origin + np.array(shape.at)
    match shape.size:
        case (radius,):
            width, height, angle, reach, corner = 2 * radius, 2 * radius, 0.0, 0.0, radius
        case (radius, length):
            ahead, aside, up = turn[:, 2]
            width = 2 * radius
            height = max(length * math.hypot(ahead, up), width * abs(aside))
            end_on = abs(aside) > END_ON
            angle = 0.0 if end_on else math.atan2(ahead, up)
            reach = length / 2 * abs(aside) + radius * math.sqrt(max(1 - aside**2, 0.0))
            corner = radius if end_on else ROUND * min(width, height)
        case (width, depth, height):
            angle, reach = math.atan2(turn[0, 2], turn[2, 2]), depth / 2
            corner = ROUND * min(width, height)
        case _:
            raise ValueError(f"a shape of {len(shape.size)} lengths")
    numbers = (x, z, width, height, math.degrees(angle), corner)
    return y - reach, [*map(_rounded, numbers), PAINTS[shape.colour]]


def _still_links() -> dict[str, NDArray[np.float64]]:
    """Return the origin of each link outside the arms; the frames of all are upright."""
    places = {"torso": np.zeros(3)}
    for joint in JOINTS.values():
        moves = joint.name[1:] in MOVING and joint.name[0] in "LR"
        if joint.parent in places and not moves:
            places[joint.child] = places[joint.parent] + np.array(joint.origin)
    return places


def _chain(robot: Robot) -> dict[str, Any]:
    """Return a robot as its links between joints: the places of these, and of its foot."""
    client: int = pybullet.connect(pybullet.DIRECT)
    try:
        body, index = load_model(client, robot)
        chain = [index[[*robot.posture(0.0)][-1]]]
        while (parent := pybullet.getJointInfo(body, chain[0], client)[16]) >= 0:
            chain.insert(0, parent)

        def pose(height: float) -> list[list[float]]:
            for name, angle in robot.posture(height).items():
                pybullet.resetJointState(body, index[name], angle, physicsClientId=client)
            states = (
                pybullet.getLinkState(
                    body, link, computeForwardKinematics=1, physicsClientId=client
                )
                for link in chain
            )
            places = [robot.place, *(state[4] for state in states)]
            hand = [FAR_GRIP[0], FAR_GRIP[2] + height]
            return [*([place[0], place[2]] for place in places), hand]

        foot = [_rounded(robot.place[0]), _rounded(robot.place[2] + robot.foot)]
        return {"foot": foot, "arm": _rows(pose, robot.stroke)}
    finally:
        pybullet.disconnect(client)


def _person() -> list[Flat]:
    """Return the shapes of a person who faces -x, the far leg first."""
    parts = mannequin.person(-1)
    return [
        [
            *map(_rounded, (part.start[0] - _back(part), part.start[2], part.radii[0])),
            *map(_rounded, (part.stop[0] - _back(part), part.stop[2], part.radii[1])),
            part.depth,
            CLOTHES[part.colour],
        ]
        for part in sorted(parts, key=lambda part: round(part.start[1], 2))
        if part.start[1] >= 0 or part.radii[0] > SMALL
    ]


def _back(part: mannequin.Limb) -> float:
    return PROFILE if part.colour == mannequin.HAIR and part.radii[0] > SMALL else 0.0


def _rows(pose: Pose, span: tuple[float, float]) -> dict[str, Any]:
    low, high = span
    heights = np.linspace(low, high, round((high - low) / ROWS) + 1)
    rows = [[[_rounded(c) for c in place] for place in pose(height)] for height in heights]
    return {"lowest": low, "step": ROWS, "rows": rows}


def _nao_arm(height: float) -> list[list[float]]:
    """Return x and z of shoulder, elbow, wrist and hand."""
    angles = lifting_angles(REST_Z + height)
    shoulder, _, elbow, _, wrist = joint_positions(angles)
    return [[at[0], at[2]] for at in (shoulder, elbow, wrist, hand_position(angles))]


def _person_arm(height: float) -> list[list[float]]:
    """Return the same of a person, x ahead of the hands at rest and z above the floor."""
    ahead, up = mannequin.SHOULDER
    shoulder = np.array([ahead, mannequin.HALF_SHOULDERS, up])
    hand = np.array([0.0, mannequin.HALF_GRIP, REST_Z + height - FLOOR])
    elbow, wrist = mannequin.arm(shoulder, hand, np.array([1.0, 0.0, 0.0]), 1)
    return [[at[0], at[2]] for at in (shoulder, elbow, wrist, hand)]


def _rounded(value: float) -> float:
    return round(float(value), PLACES) + 0.0
