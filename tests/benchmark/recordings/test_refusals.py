"""What is no motion is refused with file, place, value and a way out; and the way out works."""

from contextlib import suppress

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.recordings.cutting import Cut
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from . import motion_files as files
from .motion_files import Dialect
from .refusals import refusal


def table(path, times, heights, header="t_s,z_m"):
    rows = [
        f"{t:.6f},{'' if np.isnan(z) else format(z, '.6f')}"
        for t, z in zip(times, heights, strict=True)
    ]
    path.write_text("\n".join([header, *rows, ""]))
    return path


@pytest.fixture
def path(tmp_path):
    return tmp_path / "lift.csv"


@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    value=st.sampled_from((np.nan, 0.0, -999.0, 999.0, -9999.0)),
    first=st.integers(160, 250),
    count=st.integers(1, 20),
)
def test_a_gap_in_a_lift_is_refused_and_can_be_filled(tmp_path, value, first, count):
    path = tmp_path / "lift.csv"
    times, heights = files.lift(100.0)  # It rises from 1.5 s to 2.7 s.
    broken = heights.copy()
    broken[first : first + count] = value
    text = refusal(table(path, times, broken))
    assert f"line {first + 2} on" in text
    assert f"{count} sample(s)" in text
    assert np.isnan(value) or f"written as {value:g}" in text
    seconds = text.partition("--fill ")[2].partition(",")[0]
    [take] = takes_of(path, Wishes(fill=float(seconds)))
    [lift] = take.lifts
    assert take.filled == count
    whole = np.interp(lift.times, times, heights)
    assert np.abs(lift.heights - whole).max() < 0.006


@pytest.mark.parametrize("write", [files.vicon, files.qualisys, files.motive, files.trc])
def test_a_marker_at_the_origin_was_not_seen(tmp_path, write):
    up = "Y" if write in (files.motive, files.trc) else "Z"
    mark = "\t" if write in (files.qualisys, files.trc) else ","
    times, heights = files.lift(100.0)
    placed = files.points(heights, up, ("RFIN", "C7"))
    placed["RFIN"][180:190] = 0.0
    path = tmp_path / "take.txt"
    path.write_bytes(write(times, placed, Dialect(mark), 100.0))
    text = refusal(path, hand="RFIN")
    assert "10 sample(s), written as 0, from line" in text
    assert "at 1.80 s" in text
    assert len(takes_of(path, Wishes(hand="RFIN", fill=0.2))[0].lifts) == 1


def test_missing_rows_are_a_gap(path):
    times, heights = files.lift(100.0)
    kept = np.r_[0:180, 215:600]
    table(path, times[kept], heights[kept])
    assert "has a gap of 0.36 s in z_m: 35 sample(s) from line 181 on, at 1.80 s" in refusal(path)
    assert takes_of(path, Wishes(fill=0.4))[0].filled == 35


def test_a_gap_outside_the_lift_does_not_matter(path):
    times, heights = files.lift(100.0, lower=False)
    heights[20:60] = heights[420:520] = np.nan
    [take] = takes_of(table(path, times, heights), Wishes())
    assert len(take.lifts) == 1
    assert [round(gap, 2) for gap in take.gaps] == [0.41, 1.01]


def test_a_lift_that_ends_in_a_long_gap_was_not_seen(path):
    times, heights = files.lift(100.0)
    heights[230:400] = np.nan
    assert "begins or ends in a gap of more than a second" in refusal(table(path, times, heights))


def test_a_lift_that_had_begun_is_none(path):
    times, heights = files.lift(100.0)
    assert "had begun before the first sample" in refusal(table(path, times[200:], heights[200:]))


CLOCKS = {
    "back": (lambda t: np.where(t >= 3.0, t - 0.5, t), "line 302: time goes back by 0.49 s"),
    "forward": (lambda t: np.where(t >= 3.0, t + 2e5, t), "line 302: no sample for 200000 s"),
    "rounded": (lambda t: np.floor(t / 0.05) * 0.05, "line 3: time stands still"),
    "frames": (lambda t: np.rint(100 * t), "are these the numbers of frames?"),
    "milliseconds": (lambda t: np.rint(1000 * t), "--time-unit ms"),
    "microseconds": (lambda t: np.rint(1e6 * t), "--time-unit us"),
    "hours": (lambda t: t / 3600, "must be at most 5000 per second"),
}


@pytest.mark.parametrize("name", CLOCKS)
def test_a_clock_that_is_none_is_refused_and_samples_can_be_counted(path, name):
    change, message = CLOCKS[name]
    times, heights = files.lift(100.0)
    assert message in refusal(table(path, change(times), heights))
    [take] = takes_of(path, Wishes(rate=100.0))
    np.testing.assert_allclose(take.motion.times, times, atol=1e-9)


def test_a_unit_of_time_can_be_named(path):
    times, heights = files.lift(100.0)
    [take] = takes_of(table(path, 1000 * times, heights), Wishes(second=1e-3))
    np.testing.assert_allclose(take.motion.times, times, atol=1e-5)


@pytest.mark.parametrize(
    ("change", "message", "wishes"),
    [
        (lambda z: 1000 * z, "heights along Z are about", {"unit": "mm", "metre": 0.001}),
        (lambda z: 100 * z, "--unit mm or cm", {"unit": "cm", "metre": 0.01}),
        (
            lambda z: 480 - 400 * z,
            "METRES_PER_PIXEL",
            {"unit": "0.0025", "metre": 0.0025, "up": "-Z"},
        ),
    ],
    ids=["millimetres", "centimetres", "pixels"],
)
def test_a_wrong_unit_is_refused_and_can_be_named(path, change, message, wishes):
    times, heights = files.lift(100.0)
    assert message in refusal(table(path, times, change(heights)))
    [take] = takes_of(path, Wishes(**wishes))
    assert take.lifts[0].rise == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize("sway", [0.0, 0.006, 0.02])
def test_somebody_who_stands_still_is_no_lift(path, sway):
    times = np.arange(0.0, 6.0, 0.01)
    text = refusal(table(path, times, 0.912 + sway * np.sin(2 * np.pi * 0.3 * times)))
    assert "no lift: z_m moves" in text
    assert "stands still" in text


def test_another_axis_is_named(tmp_path):
    path = tmp_path / "take.csv"
    times, heights = files.lift(100.0)
    placed = files.points(heights, "Y", ("RHand",))
    path.write_bytes(files.plain(times, placed, Dialect(unit="m"), 100.0))
    assert "but 0.29 m along Y (--up Y?)" in refusal(path)
    placed["RHand"][:, 2] += 0.3 * heights
    path.write_bytes(files.plain(times, placed, Dialect(unit="m"), 100.0))
    text = refusal(path)
    assert (
        "RHand rises 0.09 m along Z, which is usual for a table of text, and 0.29 m along Y" in text
    )
    assert len(takes_of(path, Wishes(up="Y"))[0].lifts) == 1


def two(times, heights, other, tmp_path, names=("Table:H1", "Table:H2")):
    placed = files.points(heights, "Z", names)
    placed[names[1]][:, 2] = other
    path = tmp_path / "take.csv"
    path.write_bytes(files.vicon(times, placed, Dialect(), 100.0))
    return path


def test_of_markers_that_rise_alike_the_most_complete_is_taken(tmp_path):
    times, heights = files.lift(100.0)
    other = heights + 0.02
    heights = heights.copy()
    heights[200:210] = np.nan
    [take] = takes_of(two(times, heights, other, tmp_path), Wishes())
    assert take.track.hand == "Anna:Table:H2"
    assert take.track.why == "the most complete of 2 that rise alike"


def test_markers_that_rise_differently_are_a_choice(tmp_path):
    times, heights = files.lift(100.0)
    _, other = files.lift(100.0, top=0.5, start=2.0)
    path = two(times, heights, other, tmp_path)
    text = refusal(path)
    assert "which point is the hand? 2 of 2 rise, and not alike: Anna:Table:H2 (0.48 m)" in text
    assert "--marker 'Anna:Table:H2'" in text
    middle = takes_of(path, Wishes(hand="H1+H2"))[0]
    np.testing.assert_allclose(middle.track.heights, (heights + other) / 2, atol=1e-5)


def test_a_hand_goes_before_other_markers_by_its_name(tmp_path):
    times, heights = files.lift(100.0)
    _, other = files.lift(100.0, top=0.5, start=2.0)
    [take] = takes_of(two(times, heights, other, tmp_path, ("RFIN", "Box1")), Wishes())
    assert take.track.hand == "Anna:RFIN"
    assert "that rises" not in take.track.why or "hand" in take.track.why


def test_an_unknown_marker_is_answered_with_the_known_ones(tmp_path):
    times, heights = files.lift(100.0)
    path = two(times, heights, heights, tmp_path, ("RFIN", "LFIN"))
    text = refusal(path, hand="RFNI")
    assert "--marker 'RFNI' is not there: did you mean" in text
    assert "the file has Anna:RFIN, Anna:LFIN" in text


def test_a_name_that_two_subjects_have_is_a_choice(tmp_path):
    times, heights = files.lift(100.0)
    placed = files.points(heights, "Z", ("RFIN", "C7"))
    path = tmp_path / "take.csv"
    data = files.vicon(times, placed, Dialect(), 100.0).replace(b"Anna:C7", b"Bert:RFIN")
    path.write_bytes(data)
    assert "--marker 'RFIN' may be Anna:RFIN, Bert:RFIN: name one in full" in refusal(
        path, hand="RFIN"
    )
    [take] = takes_of(path, Wishes(hand="anna:rfin", far="Bert:RFIN"))
    assert take.track.hand == "Anna:RFIN"
    assert take.lifts[0].far == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,z\n" + "".join(f"0,{i:02d},0,9\n" for i in range(9)), "line 2: 4 fields, must be 2"),
        ('t,z_m\n0.00,"1,000.5"\n0.01,"1,001.5"\n', "line 2: 'z_m' is '1,000.5', must be a number"),
        ("t_s,z_m,z_m\n0,1,2\n1,1,2\n", "the columns 'z_m' and 'z_m' are the same axis"),
        ("t_s,elbow\n0,1\n1,1\n", "no column is a position, such as 'RHand Z'"),
        ("t_s,hand_z_px\n0,1\n1,1\n", "the unit of length is 'px', must be one of mm"),
        ("1,2,3\n4,5,6\n7,8,9\n", "3 columns without titles"),
        ("hello\n", "no table of numbers"),
        ("", "the file is empty"),
        ("t_s,z_m\n0,0\n5,0.3\n", "2 samples, needs at least 10"),
        ("frame,z_m\n" + "".join(f"{i},0.9\n" for i in range(20)), "without times: .* --rate HZ"),
    ],
)
def test_tables_that_are_none(path, text, message):
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        takes_of(path, Wishes())


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"\x02P" + bytes(600), "begins as a C3D file, but cannot be read as one"),
        (b"HIERARCHY\nROOT A\n{\nOFFSET 0 0\n", "the skeleton of this BVH file is not whole"),
        (b"PK\x03\x04", "this is a ZIP archive, or a workbook .*: save the sheet as CSV"),
        (b"\x80\x04\x95", "this is a pickle of Python, .*it can run code"),
        (b"#ROSBAG V2.0\n", "this is a bag of ROS, .*rostopic echo"),
        (b"#!OML:ASF\n:DEGREES\n1\nroot 1\n", "its skeleton, an ASF file, must be beside it"),
        (bytes(300), "this is no text"),
        (
            b"Devices\n1000\n,,F\nFrame,Sub Frame,Fx\n,,N\n1,0,2\n",
            "without positions .it has Devices.",
        ),
        (
            b"a\nendheader\ntime\telbow_flexion\n0\t1\n1\t2\n",
            "no column of this file is a position",
        ),
    ],
)
def test_files_that_are_none(tmp_path, data, message):
    if b"\x02P" in data:
        pytest.importorskip("ezc3d", reason="needs ezc3d: uv sync --all-extras")
    path = tmp_path / "file.dat"
    path.write_bytes(data)
    with pytest.raises(InputError, match=message):
        takes_of(path, Wishes())


def test_a_skeleton_without_all_its_frames_is_refused(tmp_path):
    times, heights = files.lift(50.0)
    data = files.bvh(times, files.points(heights, "Y", ("Hand",)), Dialect(), 50.0)
    path = tmp_path / "cut.bvh"
    path.write_bytes(data[: len(data) // 2])
    assert "'Frames:' says 300" in refusal(path)


def test_what_cannot_be_used_is_left_out_when_asked(path):
    times, heights = files.lift(100.0, lower=True)
    double = np.concatenate((heights, heights[::1] + 0.02 * np.sin(times)))
    double[180:190] = np.nan
    table(path, np.arange(1200) / 100, double)
    [take] = takes_of(path, Wishes(leave_out=True, cut=Cut(pause=0.5)))
    assert [lift.trial for lift in take.lifts] == ["lift-2"]
    [text] = take.left_out
    assert "has a gap of 0.11 s" in text


TIMES, HEIGHTS = files.lift(50.0, duration=4.0)


@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    write=st.sampled_from(
        (files.vicon, files.qualisys, files.motive, files.trc, files.sto, files.bvh, files.long)
    ),
    mark=st.sampled_from((",", ";", "\t")),
    cuts=st.lists(
        st.tuples(
            st.floats(0.0, 1.0),
            st.sampled_from((0, 1, 20, 300)),
            st.sampled_from((b"", b",", b"\n", b'"', b"nan", b"1e999", b"\xff", b"X", b"-", b"7")),
        ),
        min_size=1,
        max_size=6,
    ),
)
def test_a_damaged_file_is_read_or_refused(tmp_path, write, mark, cuts):
    data = write(TIMES, files.points(HEIGHTS, "Z", ("RFIN", "C7")), Dialect(mark), 50.0)
    for place, length, put in cuts:
        start = int(place**3 * len(data))
        data = data[:start] + put + data[start + length :]
    path = tmp_path / "damaged.dat"
    path.write_bytes(data)
    with suppress(InputError):
        takes_of(path, Wishes(hand="RFIN"))


@pytest.mark.slow
def test_a_damaged_c3d_file_never_ends_the_program(tmp_path):
    ezc3d = pytest.importorskip("ezc3d", reason="needs ezc3d: uv sync --all-extras")
    made = ezc3d.c3d()
    made["parameters"]["POINT"]["UNITS"]["value"] = ["m"]
    made["parameters"]["POINT"]["RATE"]["value"] = [50.0]
    made["parameters"]["POINT"]["LABELS"]["value"] = ["RFIN"]
    made["data"]["points"] = np.ones((4, 1, len(TIMES)))
    made["data"]["points"][2, 0] = HEIGHTS
    path = tmp_path / "take.c3d"
    made.write(str(path))
    whole, rng = path.read_bytes(), np.random.default_rng(3)
    for _ in range(40):
        data = bytearray(whole)
        for place in rng.integers(2, 3000, 4):
            data[place % len(data)] = rng.integers(256)
        path.write_bytes(data)
        with suppress(InputError):
            takes_of(path, Wishes())
    path.write_bytes(whole[: len(whole) - 900])
    assert "the file was cut off" in refusal(path)
