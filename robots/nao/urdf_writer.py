"""The writer of the NAO's URDF, also a program: ``python -m colift.robots.nao.urdf_writer``."""

from collections.abc import Iterable
from math import isfinite
from pathlib import Path
from typing import Final
from xml.etree import ElementTree as ET

from colift.robots.description.parts import Joint, Link, Shape
from colift.robots.nao.facts import JOINTS, LINKS
from colift.robots.nao.shapes import dressed

_INERTIA_NAMES: Final = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_HEADER: Final = (
    '<?xml version="1.0"?>\n'
    "<!-- Written by colift.robots.nao.urdf_writer; README.md names the sources. -->\n"
)


def _numbers(*values: float) -> str:
    return " ".join(f"{value + 0.0:.12g}" for value in values)


def _add_geometry(parent: ET.Element, shape: Shape) -> None:
    ET.SubElement(parent, "origin", xyz=_numbers(*shape.at), rpy=_numbers(*shape.rpy))
    geometry = ET.SubElement(parent, "geometry")
    if len(shape.size) == 3:
        ET.SubElement(geometry, "box", size=_numbers(*shape.size))
    elif len(shape.size) == 2:
        radius, length = shape.size
        ET.SubElement(geometry, "cylinder", radius=_numbers(radius), length=_numbers(length))
    else:
        ET.SubElement(geometry, "sphere", radius=_numbers(*shape.size))


def _add_link(robot: ET.Element, link: Link) -> None:
    element = ET.SubElement(robot, "link", name=link.name)
    inertial = ET.SubElement(element, "inertial")
    ET.SubElement(inertial, "origin", xyz=_numbers(*link.com), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=_numbers(link.mass))
    inertia = dict(zip(_INERTIA_NAMES, map(_numbers, link.inertia), strict=True))
    ET.SubElement(inertial, "inertia", inertia)
    for shape in link.visuals:
        visual = ET.SubElement(element, "visual")
        _add_geometry(visual, shape)
        material = ET.SubElement(visual, "material", name="#{:02x}{:02x}{:02x}".format(
            *(round(255 * channel) for channel in shape.colour)
        ))  # fmt: skip
        ET.SubElement(material, "color", rgba=_numbers(*shape.colour, 1.0))
    for shape in link.collisions:
        _add_geometry(ET.SubElement(element, "collision"), shape)


def _add_joint(robot: ET.Element, joint: Joint) -> None:
    limited = isfinite(joint.upper)
    kind = "revolute" if limited else "continuous"
    element = ET.SubElement(robot, "joint", name=joint.name, type=kind)
    ET.SubElement(element, "parent", link=joint.parent)
    ET.SubElement(element, "child", link=joint.child)
    ET.SubElement(element, "origin", xyz=_numbers(*joint.origin), rpy=_numbers(*joint.rpy))
    ET.SubElement(element, "axis", xyz=_numbers(*joint.axis))
    if limited:
        ET.SubElement(
            element,
            "limit",
            lower=_numbers(joint.lower),
            upper=_numbers(joint.upper),
            velocity=_numbers(joint.speed),
            effort=_numbers(joint.effort),
        )
    if joint.mimic:
        ratio = _numbers(joint.mimic_ratio)
        ET.SubElement(element, "mimic", joint=joint.mimic, multiplier=ratio, offset="0")


def write_urdf(joints: Iterable[Joint], links: Iterable[Link]) -> str:
    """Return the URDF of a robot as XML text; the link that is not a joint's child is its base."""
    robot = ET.Element("robot", name="nao")
    for link in links:
        _add_link(robot, link)
    for joint in joints:
        _add_joint(robot, joint)
    ET.indent(robot)
    return _HEADER + ET.tostring(robot, encoding="unicode") + "\n"


def nao_urdf() -> str:
    """Return the URDF of the whole NAO as XML text: the content of ``nao_urdf/nao.urdf``."""
    return write_urdf(JOINTS.values(), map(dressed, LINKS.values()))


if __name__ == "__main__":
    (Path(__file__).parents[1] / "nao_urdf" / "nao.urdf").write_text(nao_urdf(), encoding="utf-8")
