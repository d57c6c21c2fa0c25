"""Robots of colift and of other packages hold a table; what is no robot is refused in words."""

from dataclasses import dataclass

import pytest
from colift.benchmark.robots.robot import make_robot, robot_names
from colift.testing import check_robot

from ..extensions import crane


@pytest.mark.parametrize("name", ["nao", "iiwa"])
def test_those_of_colift_conform(name):
    assert name in robot_names()
    check_robot(make_robot(name))


def test_one_of_another_package_conforms():
    check_robot(crane.Crane())


class Slack(crane.Hook):
    """A hook without a force."""

    def drive(self, begin, height, velocity):
        return 0.0


class Worn(crane.Hook):
    """A hook that sags more with each lift."""

    worn = 0.0

    def reset(self):
        super().reset()
        self.worn += 1e-4

    def prepare(self, command, own, other, force):
        super().prepare(command - self.worn, own, other, force)


def changed(name, **members):
    """Return a crane with other members."""
    base = {"__annotations__": {}, "__module__": __name__, "__doc__": "A crane.", **members}
    return dataclass(frozen=True)(type(name, (crane.Crane,), base))()


def holding(hook):
    """Return a method that holds the table with a hook."""

    def hold(self, engine):
        made = hook()
        made.reset()
        return made

    return hold


@pytest.mark.parametrize(
    ("members", "told"),
    [
        ({"stroke": (0.1, 0.5)}, r"has the stroke 0.1 to 0.5 m; must include 0"),
        ({"hand_speed": 0.0}, r"has the hand speed 0.0 m/s; must be above 0"),
        ({"mass": -1.0}, "has the mass -1.0 kg"),
        ({"hold": holding(Slack)}, r"holds the table at -?[\d.]+ m when told 0.250 m"),
        ({"hold": holding(Worn)}, "does not repeat itself after a reset"),
        ({"posture": lambda self, height: {"elbow": height}}, "the joint 'elbow', which its model"),
        ({"posture": lambda self, height: {"hoist": float("nan")}}, "has the angle nan of hoist"),
        ({"model": lambda self: "nowhere.urdf"}, "has a model that PyBullet does not load"),
        ({"posture": None}, r"has no method posture\(\)"),
    ],
)
def test_what_is_no_robot_is_refused_in_words(members, told):
    with pytest.raises(AssertionError, match=told):
        check_robot(changed("Other", **members))


def test_a_class_is_no_robot():
    with pytest.raises(AssertionError, match="must be an object, got the class Crane"):
        check_robot(crane.Crane)
