"""Malformed files of any kind are read as they are meant, or refused with their name."""

import io
import re

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.recordings.kinds import read_motions
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes

from . import motion_files as files
from .motion_files import Dialect
from .refusals import refusal

SKELETON = (
    ":units\n length 0.45\n angle deg\n:root\n order TX TY TZ RX RY RZ\n:bonedata\n"
    " begin\n name arm\n direction 0 1 0\n length 6\n axis 0 0 0 XYZ\n dof rx\n end\n"
    " begin\n name hand\n direction 0 1 0\n length 4\n axis 0 0 0 XYZ\n end\n"
    ":hierarchy\n begin\n root arm\n arm hand\n end\n"
)
MOTION = "#!OML:ASF arm.asf\n:FULLY-SPECIFIED\n:DEGREES\n" + "".join(
    f"{i}\nroot 0 {i} 0 0 0 0\narm 90\n" for i in range(1, 4)
)


@pytest.mark.parametrize("mark", [",", ";", "\t"])
@pytest.mark.parametrize("rows", [300, 12_000])
def test_a_quotation_mark_without_an_end_is_named_by_its_line(tmp_path, mark, rows):
    lines = [mark.join((f"{i / 100:.2f}", "0.900000", "fair")) for i in range(rows)]
    lines[100] = lines[100].replace("fair", '"fair')
    path = tmp_path / "take.csv"
    path.write_text("\n".join([mark.join(("t_s", "z_m", "note")), *lines, ""]))
    assert (
        "this begins as a table of text, but cannot be read as one (line 102: a quotation mark "
        "opens a field that does not end)"
    ) in refusal(path)
    lines[200] = lines[200].replace("fair", '"fair')  # The two would hide a hundred lines.
    path.write_text("\n".join([mark.join(("t_s", "z_m", "note")), *lines, ""]))
    assert "line 102: a quotation mark" in refusal(path)


def test_a_title_may_have_two_lines(tmp_path):
    times, heights = files.lift(100.0)
    rows = [f"{t:.3f},{z:.6f}" for t, z in zip(times, heights, strict=True)]
    path = tmp_path / "take.csv"
    path.write_text("\n".join(['"Time\n [s]","RHand\n Z [m]"', *rows, ""]))
    [motion] = read_motions(path)
    assert (motion.names, motion.unit, motion.places[0]) == (("RHand",), "m", 4)
    np.testing.assert_allclose(motion.times, times, atol=1e-9)


def test_motive_may_write_decimal_commas(tmp_path):
    times, heights = files.lift(100.0)
    placed = files.points(heights, "Y", ("RFIN",))
    path = tmp_path / "take.csv"
    data = files.motive(times, placed, Dialect(";", ",", unit="m"), 100.0).decode()
    path.write_text(data.replace("100.000000", "100,000000").replace("Time (Seconds)", "-"))
    [take] = takes_of(path, Wishes())
    np.testing.assert_allclose(take.motion.times, times, atol=1e-9)
    np.testing.assert_allclose(take.track.heights, heights, atol=1e-6)


@pytest.mark.parametrize("count", ["1e999", "600,0", "-3", "nan", "six"])
def test_the_frames_of_bvh_are_a_whole_number(tmp_path, count):
    times, heights = files.lift(50.0)
    data = files.bvh(times, files.points(heights, "Y", ("Hand",)), Dialect(), 50.0)
    path = tmp_path / "take.bvh"
    path.write_bytes(data.replace(b"Frames: 300", f"Frames: {count}".encode()))
    line = 1 + data[: data.index(b"Frames:")].count(b"\n")
    told = f"line {line}: 'Frames:' is '{count}', must be a whole number"
    assert told in refusal(path)


def test_an_array_with_a_damaged_head_is_refused(tmp_path):
    data = io.BytesIO()
    np.save(data, np.zeros(300))
    path = tmp_path / "take.npy"
    for old, new in (
        (b"{'descr'", b"{('descr'"),
        (b"{'descr'", b'{"""descr'),
        (b"(300,)", b"(300000000000000,)"),
        (b"(300,)", b"(-3,)"),
        (b"'<f8'", b"'<q9'"),
    ):
        path.write_bytes(data.getvalue().replace(old, new))
        assert "cannot be read" in refusal(path)


def amc(folder, skeleton=SKELETON, motion=MOTION):
    (folder / "arm.asf").write_text(skeleton)
    path = folder / "arm.amc"
    path.write_text(motion)
    return path


def test_bones_may_be_listed_before_their_parents(tmp_path):
    [motion] = read_motions(amc(tmp_path))
    turned = SKELETON.replace(" root arm\n arm hand\n", " arm hand\n root arm\n")
    [other] = read_motions(amc(tmp_path, turned))
    assert motion.names == other.names == ("root", "arm", "hand")
    np.testing.assert_array_equal(motion.positions, other.positions)
    np.testing.assert_allclose(motion.positions[0, 2], [0, 0.0254 / 0.45, 10 * 0.0254 / 0.45])


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (" arm hand\n end\n", " arm ha", "its bone 'ha' is not described"),
        (" root arm\n", " hand arm\n", "its bone 'arm' is not described, or hangs on no other"),
        ("length 0.45", "length 0", "its unit of length is 0, must be positive"),
        ("order TX TY TZ", "order TX TZ", "its root has no ty"),
        ("order TX TY TZ RX RY RZ", "", "its root has no tx"),
        (":hierarchy\n begin\n root arm\n", ":hierarchy\n begin\n root root arm\n", "'root'"),
    ],
)
def test_a_skeleton_that_is_not_whole_is_refused_with_the_reason(tmp_path, old, new, told):
    with pytest.raises(InputError) as caught:
        read_motions(amc(tmp_path, SKELETON.replace(old, new)))
    assert re.search(r"arm\.asf: this skeleton \(ASF\) is not whole \(.*\): get", str(caught.value))
    assert told in str(caught.value)


def test_a_motion_of_another_skeleton_is_refused(tmp_path):
    path = amc(tmp_path, SKELETON.replace("dof rx", "dof rq"))
    assert "does not fit the skeleton arm.asf" in refusal(path)


def written(path, times, heights, kind):
    """Write a lift whose sample 20 is infinite as an array, a motion of a skeleton, or a table."""
    texts = ["1e999" if np.isinf(z) else f"{z:.6f}" for z in heights]
    if kind == "npy":
        np.save(path, heights)
    elif kind == "amc":
        path.with_suffix(".asf").write_text(
            SKELETON.replace("0.45", "0.0254")
            .replace("length 6", "length 1")
            .replace("length 4", "length 1")
        )
        rows = (f"{i}\nroot 0 {z} 0 0 0 0\narm 0\n" for i, z in enumerate(texts, 1))
        path.write_text(":FULLY-SPECIFIED\n:DEGREES\n" + "".join(rows))
    elif kind == "bvh":
        data = files.bvh(times, files.points(np.full(600, 0.5), "Y", ("Hand",)), Dialect(), 100.0)
        head, _, _ = data.decode().partition("0.01000000\n")
        rows = (f"0 {100 * float(z):.6f} 0 0 0 0 0 0 0" for z in texts)
        path.write_text(f"{head}0.01000000\n" + "\n".join(rows).replace("inf", "1e999") + "\n")
    else:
        rows = (f"{t:.6f},{z}" for t, z in zip(times, texts, strict=True))
        path.write_text("\n".join(["t_s,z_m", *rows, ""]))


@pytest.mark.parametrize(
    ("kind", "hand"), [("npy", None), ("amc", "root"), ("bvh", "Hips"), ("csv", None)]
)
def test_an_infinite_sample_was_not_seen_in_any_format(tmp_path, kind, hand):
    times, heights = files.lift(100.0)
    heights[20] = np.inf
    path = tmp_path / f"take.{kind}"
    written(path, times, heights, kind)
    [take] = takes_of(path, Wishes(hand=hand, rate=100.0))
    assert np.flatnonzero(np.isnan(take.track.heights)).tolist() == [20]
    assert len(take.lifts) == 1
