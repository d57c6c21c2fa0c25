"""The way out that a refusal names works; what two columns or points say is not believed."""

import numpy as np
import pytest
from colift.benchmark.recordings.taking import takes_of
from colift.benchmark.recordings.wishes import Wishes

from . import motion_files as files
from .motion_files import Dialect
from .refusals import refusal


@pytest.fixture
def path(tmp_path):
    return tmp_path / "take.csv"


def table(path, header, *columns):
    """Write columns of numbers, empty where they are NaN, or of texts."""
    rows = (
        ",".join(x if isinstance(x, str) else "" if np.isnan(x) else format(x, ".6f") for x in row)
        for row in zip(*columns, strict=True)
    )
    path.write_text("\n".join([header, *rows, ""]))
    return path


def in_furlongs(path, kind):
    """Write a lift in metres, with another unit in the head."""
    times, heights = files.lift(100.0)
    placed = files.points(heights, "Y", ("hand",))
    if kind == "csv":
        return times, heights, table(path, "Time [s],hand Z [furlong]", times, heights)
    write = {"trc": files.trc, "motive": files.motive}[kind]
    data = write(times, placed, Dialect("\t" if kind == "trc" else ",", unit="m"), 100.0)
    old = b"\tm\t" if kind == "trc" else b"Meters"
    path.write_bytes(
        data.replace(old, old.replace(b"m", b"furlong").replace(b"Meters", b"furlong"))
    )
    return times, heights, path


@pytest.mark.parametrize("kind", ["csv", "trc", "motive"])
def test_an_unknown_unit_can_be_named(path, kind):
    _, heights, path = in_furlongs(path, kind)
    told = "the unit of length is 'furlong', must be one of mm, cm, dm, m, in, ft: name it with"
    assert told in refusal(path)
    [take] = takes_of(path, Wishes(unit="m", metre=1.0))
    np.testing.assert_allclose(take.track.heights, heights, atol=1e-5)
    [take] = takes_of(path, Wishes(unit="0.5", metre=0.5))
    np.testing.assert_allclose(take.track.heights, 0.5 * heights, atol=1e-5)


def c3d(path, unit, names, heights):
    ezc3d = pytest.importorskip("ezc3d", reason="needs ezc3d: uv sync --all-extras")
    made = ezc3d.c3d()
    made["parameters"]["POINT"]["UNITS"]["value"] = [unit]
    made["parameters"]["POINT"]["RATE"]["value"] = [100.0]
    made["parameters"]["POINT"]["LABELS"]["value"] = list(names)
    made["data"]["points"] = np.ones((4, len(names), len(heights[0])))
    made["data"]["points"][2] = heights
    made.write(str(path))
    return path


def test_an_unknown_unit_of_c3d_can_be_named(tmp_path):
    _, heights = files.lift(100.0)
    path = c3d(tmp_path / "take.c3d", "furlong", ["RFIN"], [1000 * heights])
    assert "the unit of length is 'furlong'" in refusal(path)
    [take] = takes_of(path, Wishes(unit="mm", metre=0.001))
    np.testing.assert_allclose(take.track.heights, heights, atol=1e-4)


def test_points_of_one_name_are_numbered(tmp_path):
    _, heights = files.lift(100.0)
    _, other = files.lift(100.0, top=0.5, start=2.0)
    path = c3d(tmp_path / "take.c3d", "m", ["RFIN", "RFIN", "C7"], [heights, other, heights])
    text = refusal(path)
    assert "which point is the hand? 2 of 3 rise, and not alike: 2:RFIN (0.48 m)" in text
    assert "--marker '2:RFIN'" in text
    assert "--marker 'RFIN' may be 1:RFIN, 2:RFIN: name one in full" in refusal(path, hand="RFIN")
    [take] = takes_of(path, Wishes(hand="2:RFIN"))
    np.testing.assert_allclose(take.track.heights, other, atol=1e-4)
    c3d(path, "m", ["RFIN", "RFIN", "C7"], [heights, heights + 0.02, heights])
    [take] = takes_of(path, Wishes())
    assert (take.track.hand, take.track.why) == ("1:RFIN", "the most complete of 2 that rise alike")


@pytest.mark.parametrize("duration", [6.0, 1234.57])
def test_of_two_takes_in_one_file_the_first_can_be_read(path, duration):
    times, heights = files.lift(100.0, duration=duration)
    table(path, "t_s,z_m", np.tile(times, 2), np.tile(heights, 2))
    text = refusal(path)
    assert f"time goes back by {times[-1]:g} s, {times[-1]:.6f}".rstrip("0") in text
    part = text.partition("read the part before it with --between ")[2].partition(",")[0]
    start, stop = map(float, part.split(":"))
    [take] = takes_of(path, Wishes(between=(start, stop)))
    np.testing.assert_allclose(take.motion.times, times, atol=1e-6)
    assert len(take.lifts) == 1
    assert "time goes back" in refusal(path, between=(0.0, stop + 1.0))  # Which of them is meant?


@pytest.mark.parametrize("jump", [-3.0, 2e5])
def test_a_part_that_is_too_short_is_no_way_out(path, jump):
    times, heights = files.lift(100.0)
    text = refusal(
        table(path, "t_s,z_m", np.where(np.arange(600) < 5, times, times + jump), heights)
    )
    assert "--between" not in text
    assert "correct the times" in text or "count samples by --rate HZ" in text


def test_the_part_before_a_hole_can_be_read(path):
    times, heights = files.lift(100.0)
    table(path, "t_s,z_m", np.r_[times, 500.0 + times], np.tile(heights, 2))
    assert "read the part before it with --between 0:5.99, or correct" in refusal(path)
    [take] = takes_of(path, Wishes(between=(0.0, 5.99)))
    assert len(take.motion.times) == 600


@pytest.mark.parametrize(("first", "last"), [(50, 600), (200, 600), (0, 200), (0, 600)])
def test_a_lift_whose_other_end_was_not_seen_is_left_out(path, first, last):
    times, heights = files.lift(100.0)  # It rises from 1.5 s to 2.7 s.
    far = heights - 0.02
    far[first:last] = np.nan
    table(path, "t_s,hand Z [m],far Z [m]", times, heights, far)
    wishes = {"hand": "hand", "far": "far"}
    assert "the other end was not seen from its start to its end: choose" in refusal(path, **wishes)
    [take] = takes_of(path, Wishes(**wishes, leave_out=True))
    assert (take.lifts, len(take.left_out)) == ((), 1)
    assert len(takes_of(path, Wishes(hand="hand"))[0].lifts) == 1


def test_rest_without_the_other_end_is_cut_off(path):
    times, heights = files.lift(100.0)
    far = heights - 0.02
    far[:120] = far[300:] = np.nan
    table(path, "t_s,hand Z [m],far Z [m]", times, heights, far)
    [take] = takes_of(path, Wishes(hand="hand", far="far"))
    [lift] = take.lifts
    assert (lift.times[0], lift.times[-1]) == pytest.approx((1.2, 2.99))
    np.testing.assert_allclose(lift.far, lift.heights - 0.02, atol=1e-6)


@pytest.mark.parametrize("name", ["trial", "person", "marker", "Time", "timestamp [ms]"])
def test_a_column_that_is_there_twice_is_refused(path, name):
    times, heights = files.lift(100.0)
    texts = ["one"] * len(times), ["two"] * len(times)
    if name in ("Time", "timestamp [ms]"):
        table(path, f"{name},{name.upper()},hand Z [m]", times, times + 1.0, heights)
    else:
        table(path, f"{name},{name.upper()},t_s,hand Z [m]", *texts, times, heights)
    told = f"the column {name!r} is there 2 times, must be there once: keep the right one"
    assert told in refusal(path)


def test_two_axes_of_one_letter_are_refused(path):
    times, heights = files.lift(100.0)
    text = refusal(table(path, "t,z,z", times, heights, heights + 1.0))
    assert "the columns 'z' and 'z' are the same axis of the same point" in text
