from math import pi

import numpy as np
import pytest
from colift.robots.description.parts import Joint, Link, Shape
from colift.robots.description.weld import weld

BALL = (0.1, 0.0, 0.0, 0.1, 0.0, 0.1)


def body(name: str, mass: float, *shapes: Shape) -> Link:
    return Link(name=name, mass=mass, com=(0.0, 0.0, 0.0), inertia=BALL, visuals=shapes)


def hinge(name: str, parent: str, child: str) -> Joint:
    return Joint(
        name=name, parent=parent, child=child, origin=(1.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0),
        lower=-2.0, upper=2.0, speed=1.0, effort=1.0,
    )  # fmt: skip


LINKS = [body("base", 1.0), body("rod", 3.0, Shape((0.1,), (1.0, 0.0, 0.0))), body("tip", 2.0)]
JOINTS = [hinge("elbow", "base", "rod"), hinge("wrist", "rod", "tip")]


def test_welding_nothing_changes_nothing() -> None:
    joints, links = weld(JOINTS, LINKS, {})
    assert joints == JOINTS
    assert [link.mass for link in links] == [1.0, 3.0, 2.0]


def test_two_balls_become_a_dumb_bell() -> None:
    joints, (base, tip) = weld(JOINTS, LINKS, {"elbow": 0.0})
    assert (base.name, tip.name) == ("base", "tip")
    assert base.mass == 4.0
    assert base.com == pytest.approx((0.75, 0.0, 0.0))
    # Reduced mass 3/4 kg, 1 m apart, and the balls' own moments.
    assert base.inertia == pytest.approx((0.2, 0.0, 0.0, 0.95, 0.0, 0.95))
    assert [(joint.name, joint.parent, joint.child) for joint in joints] == [
        ("wrist", "base", "tip")
    ]


def test_weld_at_a_right_angle_turns_what_comes_after() -> None:
    (wrist,), (base, _) = weld(JOINTS, LINKS, {"elbow": pi / 2})
    assert wrist.origin == pytest.approx((1.0, 1.0, 0.0))
    assert wrist.rpy == pytest.approx((0.0, 0.0, pi / 2))
    assert base.visuals[0].at == pytest.approx((1.0, 1.0, 0.0))
    assert base.visuals[0].rpy == pytest.approx((0.0, 0.0, pi / 2))


def test_masses_are_never_lost() -> None:
    _, links = weld(JOINTS, LINKS, {"elbow": 0.3, "wrist": -0.7})
    assert [link.mass for link in links] == [6.0]
    assert np.isfinite(links[0].inertia).all()
