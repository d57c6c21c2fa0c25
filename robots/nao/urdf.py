"""The NAO's URDF: the whole robot as a file, and one arm as text."""

from pathlib import Path
from typing import Final

from colift.robots.description.weld import weld
from colift.robots.nao.facts import JOINTS, LINKS
from colift.robots.nao.kinematics import ARM_JOINTS
from colift.robots.nao.urdf_writer import write_urdf

_FIRST: Final = "ShoulderPitch"


def nao_urdf_path() -> Path:
    """Return the path of the URDF of the whole NAO, all 42 joints moving."""
    return Path(__file__).parents[1] / "nao_urdf" / "nao.urdf"


def arm_urdf(side: str, arms: int = 1) -> str:
    """Return the URDF of one arm: the torso as its base, and five links with moving joints.

    The shut hand is welded to the forearm here and not by PyBullet, whose
    ``URDF_MERGE_FIXED_LINKS`` ignores the centres of mass of the merged links, which reduces the
    torque of an arm's weight on the shoulder by a tenth. There are no shapes, as physics without
    contacts needs none; load it with ``URDF_USE_INERTIA_FROM_FILE``, because PyBullet otherwise
    derives the inertias from the shapes.

    Parameters
    ----------
    side
        ``L`` or ``R``.
    arms
        A factor of all masses and inertias: the number of equal arms that this one stands for.
    """
    first = JOINTS[f"{side}{_FIRST}"]
    joints, links = [], [LINKS[first.parent]]
    bodies: set[str] = set()
    for joint in JOINTS.values():
        if joint is first or joint.parent in bodies:
            bodies.add(joint.child)
            joints.append(joint)
            links.append(LINKS[joint.child])
    shut = {joint.name: 0.0 for joint in joints if joint.name not in ARM_JOINTS}
    moving, welded = weld(joints, links, shut)
    return write_urdf(moving, [link.times(arms) for link in welded])
