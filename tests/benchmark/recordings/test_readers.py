"""A lift in any format and dialect is read as the lift that was written."""

import numpy as np
import pytest
from colift.benchmark.recordings.kinds import read_motions
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from . import motion_files as files
from .motion_files import Dialect

QUICK = settings(
    max_examples=20, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
RATES = st.sampled_from((30.0, 50.0, 100.0, 119.88, 240.0))
LIFTS = st.fixed_dictionaries(
    {
        "base": st.floats(-0.5, 1.4).map(lambda x: round(x, 3)),
        "top": st.floats(0.12, 0.6).map(lambda x: round(x, 3)),
        "start": st.floats(0.6, 2.0),
        "rise": st.floats(0.8, 2.2),
        "lower": st.booleans(),
    }
)
NEWLINES = st.sampled_from(("\n", "\r\n", "\r"))
ENCODINGS = st.sampled_from(("utf-8", "utf-8-sig", "utf-16", "cp1252", "utf-16-le"))
COMMAS = st.sampled_from(((",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")))
NAMES = st.sampled_from(
    (("RFIN", "C7"), ("RHand", "Head", "Table Höhe"), ("hand_r",), ("R_Wrist_1", "L-Knee"))
)
UNITS = st.sampled_from(("mm", "cm", "m"))


def written(path, write, rate, shape, up, names, dialect):
    """Write a lift and return its times and heights."""
    times, heights = files.lift(rate, **shape)
    path.write_bytes(write(times, files.points(heights, up, names), dialect, rate))
    return times, heights


def check(path, times, heights, hand, wishes=None):
    """Check that a file has this hand, and that its lift is cut out."""
    [take] = takes_of(path, wishes or Wishes(hand=hand))
    np.testing.assert_allclose(take.motion.times, times - times[0], atol=2e-5)
    np.testing.assert_allclose(take.track.heights, heights, atol=1e-5)
    [lift] = take.lifts
    assert lift.rise == pytest.approx(np.ptp(heights), rel=0.08, abs=0.015)
    return take


@QUICK
@given(
    rate=RATES,
    shape=LIFTS,
    names=NAMES,
    newline=NEWLINES,
    encoding=ENCODINGS,
    marks=COMMAS,
    first=st.integers(1, 3000),
    blank=st.integers(0, 2),
)
def test_vicon(tmp_path, rate, shape, names, newline, encoding, marks, first, blank):
    dialect = Dialect(*marks, newline, encoding, "mm", first, blank_lines=blank)
    path = tmp_path / "take.csv"
    times, heights = written(path, files.vicon, rate, shape, "Z", names, dialect)
    take = check(path, times, heights, names[0])
    assert (take.motion.kind, take.track.up) == ("a CSV file of Vicon Nexus", "Z")
    assert take.track.hand == f"Anna:{names[0]}"


@QUICK
@given(
    rate=RATES, shape=LIFTS, names=NAMES, newline=NEWLINES, encoding=ENCODINGS, titled=st.booleans()
)
def test_qualisys(tmp_path, rate, shape, names, newline, encoding, titled):
    dialect = Dialect("\t", ".", newline, encoding, titled=titled)
    path = tmp_path / "take.tsv"
    times, heights = written(path, files.qualisys, rate, shape, "Z", names, dialect)
    assert check(path, times, heights, names[0]).motion.kind == "a TSV file of Qualisys"


@QUICK
@given(rate=RATES, shape=LIFTS, names=NAMES, newline=NEWLINES, unit=UNITS, titled=st.booleans())
def test_motive(tmp_path, rate, shape, names, newline, unit, titled):
    dialect = Dialect(",", ".", newline, "utf-8", unit, titled=titled)
    path = tmp_path / "take.csv"
    times, heights = written(path, files.motive, rate, shape, "Y", names, dialect)
    take = check(path, times, heights, names[0])
    assert (take.track.up, take.motion.unit) == ("Y", unit)


@QUICK
@given(
    rate=RATES,
    shape=LIFTS,
    names=NAMES,
    newline=NEWLINES,
    unit=UNITS,
    titled=st.booleans(),
    marks=st.sampled_from((("\t", "."), ("\t", ","), (",", "."))),
)
def test_trc(tmp_path, rate, shape, names, newline, unit, titled, marks):
    dialect = Dialect(*marks, newline, "utf-8", unit, titled=titled)
    path = tmp_path / "take.trc"
    times, heights = written(path, files.trc, rate, shape, "Y", names, dialect)
    check(path, times, heights, names[0])


@QUICK
@given(
    rate=RATES,
    shape=LIFTS,
    newline=NEWLINES,
    titled=st.booleans(),
    mark=st.sampled_from(("\t", " ", ",")),
)
def test_sto(tmp_path, rate, shape, newline, titled, mark):
    dialect = Dialect(mark, ".", newline, titled=titled)
    path = tmp_path / "take.sto"
    times, heights = written(path, files.sto, rate, shape, "Y", ("hand_r", "box"), dialect)
    check(path, times, heights, "hand_r")


@QUICK
@given(rate=RATES, shape=LIFTS, newline=NEWLINES)
def test_bvh(tmp_path, rate, shape, newline):
    path = tmp_path / "take.bvh"
    dialect = Dialect(newline=newline)
    times, heights = written(path, files.bvh, rate, shape, "Y", ("RightHand",), dialect)
    check(path, times, heights, "RightHand")


@QUICK
@given(rate=RATES, shape=LIFTS, newline=NEWLINES)
def test_rostopic(tmp_path, rate, shape, newline):
    path = tmp_path / "pose.csv"
    times, heights = written(
        path, files.rostopic, rate, shape, "Z", ("hand",), Dialect(newline=newline)
    )
    check(path, times, heights, None)


@QUICK
@given(
    rate=RATES,
    shape=LIFTS,
    names=NAMES,
    newline=NEWLINES,
    encoding=ENCODINGS,
    marks=COMMAS,
    unit=UNITS,
    write=st.sampled_from((files.plain, files.long)),
)
def test_tables(tmp_path, rate, shape, names, newline, encoding, marks, unit, write):
    path = tmp_path / "table.txt"
    dialect = Dialect(*marks, newline, encoding, unit)
    times, heights = written(path, write, rate, shape, "Z", names, dialect)
    check(path, times, heights, names[0])


@QUICK
@given(rate=RATES, shape=LIFTS, names=NAMES, unit=UNITS, screen=st.sampled_from(("", "+Z", "+Y")))
def test_c3d(tmp_path, rate, shape, names, unit, screen):
    ezc3d = pytest.importorskip("ezc3d", reason="needs ezc3d: uv sync --all-extras")
    times, heights = files.lift(rate, **shape)
    up = screen.strip("+") or "Z"
    placed = files.points(heights, up, names)
    made = ezc3d.c3d()
    made["parameters"]["POINT"]["UNITS"]["value"] = [unit]
    made["parameters"]["POINT"]["RATE"]["value"] = [rate]
    made["parameters"]["POINT"]["LABELS"]["value"] = [f"Anna:{name}" for name in placed]
    if screen:
        made.add_parameter("POINT", "X_SCREEN", ["+X"])
        made.add_parameter("POINT", "Y_SCREEN", [screen])
    data = np.ones((4, len(placed), len(times)))
    data[:3] = np.array([*placed.values()]).transpose(2, 0, 1) / files.METRES[unit]
    made["data"]["points"] = data
    path = tmp_path / "take.c3d"
    made.write(str(path))
    [take] = takes_of(path, Wishes(hand=names[0]))
    assert take.track.up == up
    np.testing.assert_allclose(take.track.heights, heights, atol=1e-4)
    np.testing.assert_allclose(take.motion.times, times, atol=1e-4)


@pytest.mark.parametrize("shape", ["heights", "point", "points", "poses"])
def test_arrays_have_no_rate(tmp_path, shape):
    times, heights = files.lift(60.0)
    place = files.points(heights, "Z", ("hand", "other"))
    poses = np.tile(np.eye(4), (len(times), 1, 1))
    poses[:, :3, 3] = place["hand"]
    arrays = {
        "heights": heights,
        "point": place["hand"],
        "points": np.stack([*place.values()], axis=1),
        "poses": poses,
    }
    path = tmp_path / "take.npy"
    np.save(path, arrays[shape])
    check(path, times, heights, None, Wishes(rate=60.0, up="Z"))


def test_joints_of_a_skeleton_follow_their_parents(tmp_path):
    """The hand of an arm of two bones, against rotations by SciPy."""
    from scipy.spatial.transform import Rotation

    rng = np.random.default_rng(3)
    frames = 50
    root, angles = rng.normal(size=(frames, 3)), rng.uniform(-90, 90, (frames, 2, 3))
    rows = [" ".join(f"{v:.9f}" for v in (*root[i], *angles[i].ravel())) for i in range(frames)]
    path = tmp_path / "arm.bvh"
    path.write_text(
        "HIERARCHY\nROOT Arm\n{\nOFFSET 1 2 3\nCHANNELS 6 Xposition Yposition Zposition Zrotation "
        "Xrotation Yrotation\nJOINT Elbow\n{\nOFFSET 0 30 4\nCHANNELS 3 Yrotation Zrotation "
        "Xrotation\nEnd Site\n{\nOFFSET 5 25 0\n}\n}\n}\nMOTION\n"
        f"Frames: {frames}\nFrame Time: 0.01\n" + "\n".join(rows)
    )
    [motion] = read_motions(path)
    first = Rotation.from_euler("ZXY", angles[:, 0], degrees=True)
    second = first * Rotation.from_euler("YZX", angles[:, 1], degrees=True)
    elbow = root + first.apply([0, 30, 4])
    assert motion.names == ("Arm", "Elbow", "Elbow_end")
    np.testing.assert_allclose(motion.positions[:, 1], 0.01 * elbow, atol=1e-8)
    tip = elbow + second.apply([5, 25, 0])
    np.testing.assert_allclose(motion.positions[:, 2], 0.01 * tip, atol=1e-8)


def test_a_bone_of_acclaim_turns_about_its_own_axes(tmp_path):
    from scipy.spatial.transform import Rotation

    (tmp_path / "arm.asf").write_text(
        ":version 1.10\n:units\n mass 1.0\n length 0.45\n angle deg\n:root\n"
        " order TX TY TZ RX RY RZ\n axis XYZ\n position 0 0 0\n orientation 0 0 0\n"
        ":bonedata\n begin\n id 1\n name upper\n"
        " direction 0 1 0\n length 6\n axis 20 -30 40 XYZ\n dof rx rz\n limits (-90 90)\n (-9 9)\n"
        " end\n begin\n id 2\n name hand\n direction 1 0 0\n length 4\n axis 0 0 0 XYZ\n end\n"
        ":hierarchy\n begin\n root upper\n upper hand\n end\n"
    )
    rng = np.random.default_rng(5)
    root, turns, own = (
        rng.normal(size=(9, 3)),
        rng.uniform(-60, 60, (9, 3)),
        rng.uniform(-60, 60, (9, 2)),
    )
    text = "#!OML:ASF arm.ASF\n:FULLY-SPECIFIED\n:DEGREES\n"
    for i in range(9):
        values = " ".join(map(str, (*root[i], *turns[i])))
        text += f"{i + 1}\nroot {values}\nupper {own[i, 0]} {own[i, 1]}\n"
    (tmp_path / "arm_lift.amc").write_text(text)
    [motion] = read_motions(tmp_path / "arm_lift.amc")
    fixed = Rotation.from_euler("xyz", [20, -30, 40], degrees=True)
    free = Rotation.from_euler("xz", own, degrees=True)
    world = Rotation.from_euler("xyz", turns, degrees=True) * fixed * free * fixed.inv()
    end = root + world.apply([0, 6, 0]) + world.apply([4, 0, 0])
    assert motion.names == ("root", "upper", "hand")
    np.testing.assert_allclose(motion.positions[:, 2], end * 0.0254 / 0.45, atol=1e-9)
    assert not motion.clocked
