"""The NAO's shapes: boxes, cylinders and spheres for each link, and its collision shapes.

The shapes are ours, drawn by eye around the published joints; no mesh or outline of the maker is
used. Only places that are facts (eyes, cameras, chest button, sole) come from the sensor frames of
the published model.
"""

from dataclasses import replace
from math import pi
from typing import Final

from colift.robots.description.parts import GREY, Link, Shape, mirrored_name
from colift.robots.nao.facts import FOOT_HEIGHT, JOINTS, PHALANX_LENGTH

WHITE: Final = (0.94, 0.94, 0.93)
DARK: Final = (0.20, 0.21, 0.23)
ORANGE: Final = (0.95, 0.42, 0.08)
BLUE: Final = (0.16, 0.55, 0.95)

_ALONG_X: Final = (0.0, pi / 2, 0.0)
_ALONG_Y: Final = (pi / 2, 0.0, 0.0)


def _pair(shape: Shape) -> tuple[Shape, Shape]:
    return shape, shape.mirrored()


_HEAD: Final = (
    Shape((0.060,), (0.0, 0.0, 0.054), WHITE),
    Shape((0.051,), (0.014, 0.0, 0.043), WHITE),
    *_pair(Shape((0.047,), (0.0, 0.016, 0.058), WHITE)),
    *_pair(Shape((0.031, 0.016), (0.0, 0.060, 0.050), GREY, _ALONG_Y)),
    *_pair(Shape((0.021, 0.006), (0.0, 0.067, 0.050), ORANGE, _ALONG_Y)),
    *_pair(Shape((0.0140, 0.010), (0.0535, 0.0257, 0.0466), DARK, (0.0, pi / 2, 0.38))),
    *_pair(Shape((0.0095, 0.012), (0.0540, 0.0257, 0.0466), BLUE, (0.0, pi / 2, 0.38))),
    Shape((0.0050, 0.008), (0.0587, 0.0, 0.0700), DARK, _ALONG_X),
    Shape((0.0050, 0.008), (0.0590, 0.0, 0.0177), DARK, _ALONG_X),
    Shape((0.028, 0.016, 0.010), (0.030, 0.0, 0.1020), ORANGE, (0.0, 0.52, 0.0)),
    Shape((0.028, 0.016, 0.010), (0.0, 0.0, 0.1100), ORANGE),
    Shape((0.028, 0.016, 0.010), (-0.029, 0.0, 0.1030), ORANGE, (0.0, -0.50, 0.0)),
)
_TORSO: Final = (
    Shape((0.046, 0.124), (0.0, 0.0, 0.076), WHITE, _ALONG_Y),
    *_pair(Shape((0.047, 0.026), (0.0, 0.040, 0.076), ORANGE, _ALONG_Y)),
    *_pair(Shape((0.036, 0.080), (0.002, 0.016, 0.030), WHITE)),
    *_pair(Shape((0.030, 0.060), (0.0, 0.012, -0.036), GREY)),
    Shape((0.030, 0.080, 0.110), (-0.040, 0.0, 0.055), GREY),
    Shape((0.012, 0.014), (0.0430, 0.0, 0.0552), DARK, _ALONG_X),
    Shape((0.008, 0.016), (0.0430, 0.0, 0.0552), BLUE, _ALONG_X),
    Shape((0.032, 0.070), (0.0, 0.0, -0.080), DARK, _ALONG_Y),
)
_VISUALS: Final = {
    "torso": _TORSO,
    "Neck": (Shape((0.022, 0.050), (0.0, 0.0, -0.022), DARK),),
    "Head": _HEAD,
    "LPelvis": (Shape((0.036,), (-0.004, 0.004, 0.0), DARK),),
    "LThigh": (
        Shape((0.036, 0.078), (0.004, 0.0, -0.050), WHITE),
        Shape((0.020, 0.042, 0.050), (0.0345, 0.0, -0.048), ORANGE),
    ),
    "LTibia": (
        Shape((0.031, 0.060), (0.0, 0.0, 0.0), GREY, _ALONG_Y),
        Shape((0.039, 0.076), (0.002, 0.0, -0.058), WHITE),
        Shape((0.024, 0.044, 0.056), (0.0340, 0.0, -0.056), GREY),
    ),
    "LAnklePitch": (Shape((0.030,), (0.0, 0.0, 0.0), DARK),),
    "l_ankle": (
        Shape((0.090, 0.088, 0.032), (0.020, 0.002, 0.016 - FOOT_HEIGHT), WHITE),
        Shape((0.044, 0.032), (0.065, 0.002, 0.016 - FOOT_HEIGHT), WHITE),
        Shape((0.044, 0.030), (-0.018, 0.002, 0.016 - FOOT_HEIGHT), WHITE),
        Shape((0.045, 0.008), (0.066, 0.002, 0.010 - FOOT_HEIGHT), ORANGE),
        Shape((0.034, 0.026), (0.0, 0.0, -0.008), GREY),
    ),
    "LShoulder": (Shape((0.030, 0.036), (0.0, -0.020, 0.0), DARK, _ALONG_Y),),
    "LBicep": (
        Shape((0.037,), (0.002, 0.006, 0.0), WHITE),
        Shape((0.038, 0.010), (0.004, 0.010, 0.0), ORANGE, _ALONG_X),
        Shape((0.026, 0.060), (0.056, 0.012, 0.0), WHITE, _ALONG_X),
    ),
    "LElbow": (Shape((0.0255,), (0.0, 0.0, 0.0), GREY),),
    "LForeArm": (Shape((0.029, 0.040), (0.030, 0.0, 0.0), WHITE, _ALONG_X),),
    "l_wrist": (
        Shape((0.024, 0.020), (0.004, 0.0, 0.0), ORANGE, _ALONG_X),
        *_pair(Shape((0.019,), (0.050, 0.008, 0.003), WHITE)),
        *_pair(Shape((0.019, 0.042), (0.030, 0.008, 0.003), WHITE, _ALONG_X)),
        Shape((0.026, 0.040, 0.016), (0.036, 0.0, -0.014), GREY),
    ),
}
_PHALANX: Final = (
    Shape((0.0080,), (0.0, 0.0, 0.0), GREY),
    Shape((0.0072, PHALANX_LENGTH), (PHALANX_LENGTH / 2, 0.0, 0.0), WHITE, _ALONG_X),
    Shape((0.0072,), (PHALANX_LENGTH, 0.0, 0.0), WHITE),
)
_COLLISIONS: Final = {
    "torso": Shape((0.095, 0.125, 0.215), (-0.005, 0.0, 0.012)),
    "Head": Shape((0.062,), (0.004, 0.0, 0.052)),
    "LThigh": Shape((0.036, 0.078), (0.004, 0.0, -0.050)),
    "LTibia": Shape((0.039, 0.076), (0.002, 0.0, -0.058)),
    "l_ankle": Shape((0.155, 0.088, 0.032), (0.024, 0.002, 0.016 - FOOT_HEIGHT)),
    "LBicep": Shape((0.027, 0.090), (0.050, 0.012, 0.0), rpy=_ALONG_X),
    "LForeArm": Shape((0.029, 0.040), (0.030, 0.0, 0.0), rpy=_ALONG_X),
    "l_wrist": Shape((0.060, 0.050, 0.034), (0.040, 0.0, 0.0)),
}


def _both_sides() -> dict[str, tuple[Shape, ...]]:
    left = {name: shapes for name, shapes in _VISUALS.items() if name != mirrored_name(name)}
    right = {
        mirrored_name(name): tuple(shape.mirrored() for shape in shapes)
        for name, shapes in left.items()
    }
    fingers = {joint.child: _PHALANX for joint in JOINTS.values() if joint.child.endswith("_link")}
    return _VISUALS | right | fingers


_ALL_VISUALS: Final = _both_sides()
_ALL_COLLISIONS: Final = _COLLISIONS | {
    mirrored_name(name): shape.mirrored()
    for name, shape in _COLLISIONS.items()
    if name != mirrored_name(name)
}


def dressed(link: Link) -> Link:
    """Return a link of the NAO with its visible shapes and, for main links, a collision shape."""
    solid = _ALL_COLLISIONS.get(link.name)
    return replace(
        link, visuals=_ALL_VISUALS.get(link.name, ()), collisions=(solid,) if solid else ()
    )
