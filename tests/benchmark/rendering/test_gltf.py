"""Models in three dimensions, read as the standard says (glTF 2.0, sections 3 and 4)."""

import json
import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.errors import InputError
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.playing import play
from colift.benchmark.rendering.gltf import check_model, write_model
from colift.benchmark.results.baselines import partner_spec
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.world.table import TABLE_LENGTH
from numpy.typing import NDArray

pytest.importorskip("trimesh")

SIZES = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
TYPES = {5125: "<u4", 5126: "<f4"}


class Model:
    """A binary glTF file."""

    def __init__(self, path: Path) -> None:
        content = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", content)
        assert (magic, version, length) == (b"glTF", 2, len(content))
        size, kind = struct.unpack_from("<I4s", content, 12)
        assert (size % 4, kind) == (0, b"JSON")
        self.tree: dict[str, Any] = json.loads(content[20 : 20 + size])
        size, kind = struct.unpack_from("<I4s", content, 20 + size)
        assert (size % 4, kind) == (0, b"BIN\0")
        self.data = content[-size:]
        assert self.tree["buffers"][0]["byteLength"] <= size

    def values(self, index: int) -> NDArray[Any]:
        """Return what an accessor refers to."""
        accessor = self.tree["accessors"][index]
        view = self.tree["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        numbers = np.frombuffer(
            self.data,
            TYPES[accessor["componentType"]],
            accessor["count"] * SIZES[accessor["type"]],
            start,
        )
        return numbers.reshape(accessor["count"], -1)

    def track(self, name: str, path: str) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the times and the values of a node's animation."""
        (animation,) = self.tree["animations"]
        node = [each["name"] for each in self.tree["nodes"]].index(name)
        (channel,) = [
            each for each in animation["channels"] if each["target"] == {"node": node, "path": path}
        ]
        sampler = animation["samplers"][channel["sampler"]]
        return self.values(sampler["input"])[:, 0], self.values(sampler["output"])

    def names(self) -> list[str]:
        return [each["name"] for each in self.tree["nodes"]]


def written(path: Path, policy: str, scenario: Scenario) -> tuple[Model, Episode]:
    people = scenario.partner == "human"
    spec = partner_spec(scenario) if people else PolicySpec(text=policy)
    episode = next(play(spec, scenario, (0,)))
    write_model(path, episode, scenario, policy)
    return Model(path), episode


@pytest.fixture(scope="module")
def lifted(tmp_path_factory: pytest.TempPathFactory) -> tuple[Model, Episode]:
    path = tmp_path_factory.mktemp("model") / "lift.glb"
    return written(path, "agree_leader", make_scenario("abreast", "S3", task="agree"))


def test_the_table_moves_as_it_did_in_the_lift(lifted: tuple[Model, Episode]) -> None:
    model, episode = lifted
    times, places = model.track("table", "translation")
    frames = [*range(0, len(episode.trace.human_end) - 1, 4), len(episode.trace.human_end) - 1]
    assert times == pytest.approx(np.array(frames) / 100, abs=1e-6)
    near, far = (end[frames] for end in (episode.trace.human_end, episode.trace.robot_end))
    # z points upwards in the frame of the lift.
    assert places[:, 2] - places[0, 2] == pytest.approx(
        (near + far) / 2 - (near + far)[0] / 2, abs=1e-4
    )
    _, turns = model.track("table", "rotation")
    assert np.linalg.norm(turns, axis=1) == pytest.approx(1.0, abs=1e-6)
    pitch = 2 * np.arctan2(turns[:, 1], turns[:, 3])
    assert TABLE_LENGTH * np.sin(pitch) == pytest.approx(far - near, abs=1e-5)


def test_up_is_y(lifted: tuple[Model, Episode]) -> None:
    model, _ = lifted
    nodes = {each["name"]: each for each in model.tree["nodes"]}
    turn = np.array(nodes["lift"]["matrix"]).reshape(4, 4).T
    assert turn @ [0, 0, 1, 1] == pytest.approx([0, 1, 0, 1])
    assert turn @ [1, 0, 0, 1] == pytest.approx([1, 0, 0, 1])
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_everything_that_is_seen_is_in_the_model(lifted: tuple[Model, Episode]) -> None:
    model, _ = lifted
    names = model.names()
    assert len(names) == len(set(names))
    for part in ("table", "human forearm", "human's hurdle, open", "robot's hurdle, closed"):
        assert part in names
    assert sum(name.startswith("robot ") for name in names) > 60


def test_hands_go_with_the_table(lifted: tuple[Model, Episode]) -> None:
    model, _ = lifted
    for name, end in (("human fist", "human's end"), ("robot l_wrist", "robot's end")):
        (_, hand), (_, there) = (model.track(each, "translation") for each in (name, end))
        rise = (hand - hand[0])[:, 2] - (there - there[0])[:, 2]
        assert np.abs(rise).max() < 0.25 * np.ptp(there[:, 2])


def test_the_file_follows_the_standard(lifted: tuple[Model, Episode]) -> None:
    """What the Khronos validator calls errors, for all that a model has."""
    model, _ = lifted
    tree = model.tree
    assert tree["asset"]["version"] == "2.0"
    for view in tree["bufferViews"]:
        assert view["byteOffset"] % 4 == 0
        assert view["byteOffset"] + view["byteLength"] <= tree["buffers"][0]["byteLength"]
    (animation,) = tree["animations"]
    for channel in animation["channels"]:
        assert "matrix" not in tree["nodes"][channel["target"]["node"]]
        sampler = animation["samplers"][channel["sampler"]]
        times, values = model.values(sampler["input"])[:, 0], model.values(sampler["output"])
        assert len(times) == len(values)
        assert (np.diff(times) > 0).all()
        accessor = tree["accessors"][sampler["input"]]
        assert (accessor["min"], accessor["max"]) == ([times[0]], [times[-1]])
    for mesh in tree["meshes"]:
        (primitive,) = mesh["primitives"]
        places, normals = (model.values(primitive["attributes"][n]) for n in ("POSITION", "NORMAL"))
        assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-4)
        assert model.values(primitive["indices"]).max() < len(places) == len(normals)
    for material in tree["materials"]:
        colour = material["pbrMetallicRoughness"]["baseColorFactor"]
        assert all(0.0 <= value <= 1.0 for value in colour)


def test_normals_point_outwards(lifted: tuple[Model, Episode]) -> None:
    model, _ = lifted
    for mesh in model.tree["meshes"]:
        (primitive,) = mesh["primitives"]
        places, normals = (model.values(primitive["attributes"][n]) for n in ("POSITION", "NORMAL"))
        corners = model.values(primitive["indices"]).reshape(-1, 3)
        a, b, c = (places[corners[:, i]] for i in range(3))
        faces = np.cross(b - a, c - a)
        real = np.linalg.norm(faces, axis=1) > 1e-9
        agree = (faces * normals[corners].sum(axis=1)).sum(axis=1)[real] > 0.0
        assert agree.mean() > 0.99, mesh["name"]


@pytest.mark.parametrize("partner", ["iiwa", "human"])
def test_other_holders_are_there(partner: str, tmp_path: Path) -> None:
    scenario = make_scenario("smooth", partner=partner)
    model, _ = written(tmp_path / "lift.glb", "copy", scenario)
    names = model.names()
    assert ("partner forearm" in names) is (partner == "human")
    assert any(name.startswith("robot lbr_iiwa") for name in names) is (partner == "iiwa")


def test_the_same_lift_gives_the_same_bytes(
    long_episode: Episode, scenario: Scenario, tmp_path: Path
) -> None:
    for name in ("one.glb", "two.glb"):
        write_model(tmp_path / name, long_episode, scenario, "copy")
    assert (tmp_path / "one.glb").read_bytes() == (tmp_path / "two.glb").read_bytes()
    extras = Model(tmp_path / "one.glb").tree["scenes"][0]["extras"]
    assert (extras["policy"], extras["behaviour"], extras["rmse_mm"]) == ("copy", "smooth", 20.0)


def test_a_lift_without_frames_is_refused(
    empty_episode: Episode, scenario: Scenario, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="the lift ended at once"):
        write_model(tmp_path / "lift.glb", empty_episode, scenario, "copy")
    assert not list(tmp_path.iterdir())


def test_without_the_extra_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(InputError, match=r"lift\.glb needs trimesh: "):
        check_model(Path("lift.glb"))
