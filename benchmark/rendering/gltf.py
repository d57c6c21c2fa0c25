"""A lift as a moving model in three dimensions: binary glTF 2.0, for Blender and for viewers.

glTF is a standard (ISO/IEC 12113) that browsers, game engines and modelling programs read; its
lengths are in metres, and y points upwards.
"""

import importlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
from colift.agents.agent import FRAME
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.metric import drawn_series
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.rendering.lift_scene import LiftScene
from colift.benchmark.rendering.rigid import Pose, Shape, pose_of, rigid_bodies
from colift.benchmark.rendering.solids import Colour
from numpy.typing import NDArray

SUFFIX: Final = ".glb"

EVERY: Final = 4
"""Frames from one key of the animation to the next: 25 keys a second, with straight lines between
them."""

UP: Final = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
"""The transformation from z upwards to y upwards."""

ROUGH: Final = 0.9
"""Roughness of all surfaces; none is metallic."""

FLOAT: Final = 5126
"""glTF's code of a float32."""


def check_model(path: Path) -> None:
    """Refuse to write a model if its library is not installed.

    Raises
    ------
    InputError
        If the extra is not installed.
    """
    _library(path)


def write_model(path: Path, episode: Episode, scenario: Scenario, policy: str) -> None:
    """Write a lift as a ``.glb`` file.

    Parameters
    ----------
    path
        The file.
    episode
        A finished episode.
    scenario
        Its scenario.
    policy
        Name of the policy, for the model's description.

    Raises
    ------
    InputError
        If the extra is not installed, the episode ended before its first frame, or the file cannot
        be written.
    """
    trimesh = _library(path)
    count = len(episode.trace.human_end)
    if count == 0:
        raise InputError(f"nothing to show: the lift ended at once ({episode.failure})")
    frames = [*range(0, count - 1, EVERY), count - 1]
    drawn = drawn_series(scenario.task.metrics)
    with LiftScene(episode.trace, scenario.partner, drawn) as lift:
        bodies = rigid_bodies(lift.scene)
        keys = []
        for frame in frames:
            lift.show(frame)
            keys.append([pose_of(lift.scene, each) for each in bodies])
    model = trimesh.Scene(metadata=_description(episode, scenario, policy))
    model.graph.update("lift", matrix=UP)
    for body, pose in zip(bodies, keys[0], strict=True):
        model.graph.update(body.name, "lift", matrix=_matrix(trimesh, pose))
        for shape in body.shapes:
            _add(trimesh, model, body.name, shape)
    times = np.array(frames) * FRAME
    tracks = {
        body.name: track
        for body, track in zip(bodies, zip(*keys, strict=True), strict=True)
        if any(pose != track[0] for pose in track)
    }
    content = model.export(
        file_type="glb",
        buffer_postprocessor=lambda items, tree: _animate(items, tree, times, tracks),
    )
    try:
        path.write_bytes(content)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror or error}") from error


def _library(path: Path) -> Any:
    try:
        return importlib.import_module("trimesh")
    except ImportError as error:
        raise InputError(f"{path} needs trimesh: {how_to_install('model')}") from error


def _description(episode: Episode, scenario: Scenario, policy: str) -> dict[str, Any]:
    """Return what the lift is, for those who open the file."""
    return {
        "policy": policy,
        "task": scenario.task.name,
        "behaviour": episode.behaviour,
        "subject": episode.subject,
        "seed": episode.seed,
        "rmse_mm": round(episode.scores["rmse_mm"], 3),
        "made by": "colift",
    }


def _add(trimesh: Any, model: Any, body: str, shape: Shape) -> None:
    """Add a shape to a model, as part of a body."""
    red, green, blue = (round(255 * value) for value in shape.colour[:3])
    material = trimesh.visual.material.PBRMaterial(
        name=f"#{red:02x}{green:02x}{blue:02x}",
        baseColorFactor=[*_linear(shape.colour), shape.colour[3]],
        metallicFactor=0.0,
        roughnessFactor=ROUGH,
    )
    mesh = trimesh.Trimesh(
        vertices=shape.mesh.vertices,
        faces=shape.mesh.triangles,
        vertex_normals=shape.mesh.normals,
        visual=trimesh.visual.TextureVisuals(material=material),
        process=False,
    )
    name = f"{body}, shape {len(model.geometry) + 1}"
    frame = _matrix(trimesh, shape.frame)
    model.add_geometry(mesh, name, geom_name=name, parent_node_name=body, transform=frame)


def _matrix(trimesh: Any, pose: Pose) -> NDArray[np.float64]:
    """Return the matrix of a pose, of shape (4, 4)."""
    place, (x, y, z, w) = pose
    matrix: NDArray[np.float64] = trimesh.transformations.quaternion_matrix([w, x, y, z])
    matrix[:3, 3] = place
    return matrix


def _linear(colour: Colour) -> list[float]:
    """Return red, green and blue in linear light, as glTF has them (IEC 61966-2-1)."""
    return [
        value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
        for value in colour[:3]
    ]


def _animate(
    items: Any,
    tree: dict[str, Any],
    times: NDArray[np.float64],
    tracks: Mapping[str, Sequence[Pose]],
) -> None:
    """Add the animation to the buffers and the tree of a model."""

    def accessor(values: NDArray[np.float64], kind: str) -> int:
        name = f"animation {len(items)}"
        items[name] = values.astype("<f4").tobytes()
        entry = {
            "bufferView": len(items) - 1,
            "componentType": FLOAT,
            "count": len(values),
            "type": kind,
        }
        if kind == "SCALAR":
            ends = values.astype("<f4")
            entry |= {"min": [float(ends.min())], "max": [float(ends.max())]}
        tree["accessors"][name] = entry
        return len(tree["accessors"]) - 1

    nodes = {node["name"]: index for index, node in enumerate(tree["nodes"])}
    clock = accessor(times, "SCALAR")
    samplers: list[dict[str, int]] = []
    channels: list[dict[str, Any]] = []
    for name, track in tracks.items():
        node = tree["nodes"][nodes[name]]
        node.pop("matrix", None)
        places, turns = (np.array(values) for values in zip(*track, strict=True))
        for path, values, kind in (
            ("translation", places, "VEC3"),
            ("rotation", _continuous(turns), "VEC4"),
        ):
            node[path] = values[0].tolist()
            channels.append(
                {"sampler": len(samplers), "target": {"node": nodes[name], "path": path}}
            )
            samplers.append({"input": clock, "output": accessor(values, kind)})
    if channels:
        tree["animations"] = [{"name": "lift", "samplers": samplers, "channels": channels}]


def _continuous(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unit quaternions whose signs do not change from one to the next."""
    units: NDArray[np.float64] = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    signs = np.where((units[1:] * units[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)
    units[1:] *= np.cumprod(signs)[:, None]
    return units
