"""The NAO's URDF: the whole robot as a file, and a robot of which only the arms move."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Final

from ..description.weld import weld
from .facts import JOINTS, LINKS
from .kinematics import ARM_JOINTS
from .shapes import dressed
from .urdf_writer import write_urdf

STANDING: Final[Mapping[str, float]] = MappingProxyType({})
"""The posture of a NAO that stands straight and looks ahead, hands shut: every angle is zero."""


def nao_urdf_path() -> Path:
    """Return the path of the URDF of the whole NAO, all 42 joints moving."""
    return Path(__file__).parents[1] / "nao_urdf" / "nao.urdf"


def arms_only_urdf(posture: Mapping[str, float] = STANDING, *, shapes: bool = True) -> str:
    """Return the URDF of a NAO whose ten arm joints move and whose other joints are welded.

    It has a base and ten links. Welding is done here, because PyBullet's
    ``URDF_MERGE_FIXED_LINKS`` forgets where the centres of mass of the merged links are, which
    takes a tenth off the torque that an arm's weight puts on the shoulder.

    Parameters
    ----------
    posture
        Angle [rad] of joints to weld, by name; those not named are at zero. A joint that mimics
        another (the fingers follow ``LHand`` and ``RHand``) cannot be named: it follows.
    shapes
        Whether to keep the shapes to see and to collide with. Physics without contacts needs none;
        load it with ``URDF_USE_INERTIA_FROM_FILE``, as otherwise PyBullet derives the inertias
        from the shapes.

    Raises
    ------
    ValueError
        If ``posture`` names a joint that cannot be posed, or an angle outside its limits.
    """
    welded = {name: joint for name, joint in JOINTS.items() if name not in ARM_JOINTS}
    free = [name for name, joint in welded.items() if not joint.mimic]
    for name, angle in posture.items():
        if name not in free:
            raise ValueError(f"cannot pose joint {name!r}; these can be: {', '.join(free)}")
        if not welded[name].lower <= angle <= welded[name].upper:
            limits = f"{welded[name].lower} to {welded[name].upper} rad"
            raise ValueError(f"{name} = {angle} rad is outside its limits, {limits}")
    angles = {
        name: posture.get(joint.mimic or name, 0.0) * joint.mimic_ratio
        for name, joint in welded.items()
    }
    links = map(dressed, LINKS.values()) if shapes else LINKS.values()
    return write_urdf(*weld(JOINTS.values(), links, angles))
