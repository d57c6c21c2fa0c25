"""Artefacts of motion capture are refused by line and with a cure; motion of people is read."""

import numpy as np
import pytest
from colift.agents.humans import load_recordings
from colift.agents.humans.artefacts import CHECKS, Fault, fault
from colift.base.errors import InputError

from .motion import lift, rows, table

RNG = np.random.default_rng(1)
TIMES, HEIGHTS = lift()


def heights(where, value):
    """Return the heights of the lift with some samples changed."""
    changed = HEIGHTS.copy()
    changed[where] = value
    return TIMES, changed


def times(start, by):
    """Return the lift with a clock that jumps at a sample."""
    changed = TIMES.copy()
    changed[start:] += by
    return changed, HEIGHTS


def without(start, stop):
    """Return the lift without the rows of some samples."""
    kept = np.r_[0:start, stop : len(TIMES)]
    return TIMES[kept], HEIGHTS[kept]


def stand(spread, unit=1.0, noise=0.0):
    """Return somebody who stands still, with sway and noise [m], in a unit."""
    sway = spread / 2 * np.sin(2 * np.pi * 0.3 * TIMES)
    return TIMES, unit * (0.912 + sway + noise * RNG.standard_normal(len(TIMES)))


SEEN_AS = "written for a marker that was not seen"
ARTEFACTS = {
    "0 for a gap": (heights(slice(150, 185), 0.0), 152, f"z_m is 0 in 35 of 600.*{SEEN_AS}"),
    "0 at the start": (heights(slice(0, 5), 0.0), 2, f"z_m is 0 in 5 of 600.*{SEEN_AS}"),
    "0 at the end": (heights(slice(590, 600), 0.0), 592, SEEN_AS),
    "0 in one frame": (heights(300, 0.0), 302, SEEN_AS),
    "0 in every fifth frame": (heights(slice(0, 600, 5), 0.0), 2, SEEN_AS),
    "0 at 10 Hz": (
        (lift(10.0)[0], np.where(np.arange(60) == 30, 0.0, lift(10.0)[1])),
        32,
        SEEN_AS,
    ),
    "-999": (heights(slice(200, 210), -999.0), 202, "z_m is -999 in 10 of 600"),
    "9999": (heights(400, 9999.0), 402, "z_m is 9999 in 1 of 600"),
    "-1": (heights(slice(200, 210), -1.0), 202, "from 1.03788 m to -1 m in 0.01 s"),
    "the last value repeated": (
        heights(slice(140, 240), HEIGHTS[140]),
        242,
        "m/s, must be at most 10 m/s",
    ),
    "nan": (heights(slice(250, 259), np.nan), 252, "nan or empty in 9 samples, 2.5 s to 2.58 s"),
    "a lost marker": (heights(slice(250, 600), HEIGHTS[250:] + 0.4), 252, "lost or exchanged"),
    "a clock that jumps ahead": (times(300, 200_000.0), 302, "no sample for 200000 s.*correct t_s"),
    "a clock that jumps 45 s": (times(300, 45.0), 302, "no sample for 45.01 s, from 2.99 s on"),
    "a clock that jumps 0.3 s": (times(300, 0.3), 302, "no sample for 0.31 s"),
    "a clock that jumps back": (times(300, -0.5), 302, "time goes from 2.99 s to 2.5 s.*set back"),
    "missing rows": (without(110, 290), 112, "no sample for 1.81 s.*missing rows: fill the gap"),
    "missing rows at 15 Hz": (
        tuple(np.delete(each, slice(30, 50)) for each in lift(15.0)),
        32,
        "no sample for 1.4 s",
    ),
    "frame numbers as time": ((np.arange(110.0), HEIGHTS[::5][:110]), 3, "frame numbers in t_s"),
    "milliseconds as time": ((1000 * TIMES, HEIGHTS), 3, "seconds.*milliseconds: divide by 1000"),
    "microseconds as time": ((1e6 * TIMES, HEIGHTS), 3, "microseconds: divide by 1e6"),
    "nanoseconds as time": ((1e9 * TIMES, HEIGHTS), 3, "nanoseconds: divide by 1e9"),
    "minutes as time": ((TIMES / 60, HEIGHTS), 601, "lasts 0.0998.* s.*in seconds"),
    "rounded times": ((np.round(lift(240.0)[0], 2), lift(240.0)[1]), 3, "must increase .rounded"),
    "two takes under one name": (
        (np.r_[TIMES, TIMES + 20], np.r_[HEIGHTS, HEIGHTS + 0.3]),
        602,
        "no sample for 14.01 s.*two takes under one name",
    ),
    "two takes without a pause": (
        (np.r_[TIMES, TIMES + 6], np.r_[HEIGHTS, HEIGHTS + 0.3]),
        602,
        "two takes under one name",
    ),
    "two markers in turn": (
        (np.repeat(TIMES, 2), np.repeat(HEIGHTS, 2)),
        3,
        "must increase .*two markers under one name",
    ),
    "two markers in blocks": ((np.r_[TIMES, TIMES], np.r_[HEIGHTS, HEIGHTS]), 602, "two markers"),
    "millimetres": ((TIMES, 1000 * HEIGHTS), 2, "in metres. divide millimetres by 1000"),
    "millimetres from the start": ((TIMES, 1000 * (HEIGHTS - 0.9)), 2, "in metres"),
    "centimetres": ((TIMES, 100 * HEIGHTS), 2, "in metres.*centimetres by 100"),
    "pixels": ((TIMES, 480 - 400 * HEIGHTS), 2, "in metres.*pixels"),
    "standing, in millimetres": (stand(0.0, 1000.0, 0.00025), 2, "in metres"),
    "swaying, in millimetres": (stand(0.002, 1000.0), 2, "in metres"),
    "swaying, in centimetres": (stand(0.012, 100.0), 2, "in metres"),
    "standing": (stand(0.0, noise=0.0005), 2, "does not move.*stands still"),
    "swaying": (stand(0.012), 2, "does not move: its heights span 0.0120 m"),
    "standing, by a coarse camera": (stand(0.0, noise=0.02), None, "slowed down|10 m/s"),
    "low-passed outliers": (
        (TIMES, HEIGHTS - 0.9 * np.exp(-(((TIMES - 2.0) / 0.06) ** 2))),
        None,
        "m/s|slowed down",
    ),
    "two samples": ((np.array([0.0, 5.0]), np.array([0.0, 0.3])), 2, "has 2 sample.s., needs"),
    "a huge number": (heights(300, 1e308), 302, "z_m goes from"),
    "huge numbers": ((TIMES, 1e308 * np.cos(TIMES)), 2, "in metres"),
}


@pytest.mark.parametrize("name", ARTEFACTS)
def test_an_artefact_is_refused_with_its_line_and_a_cure(tmp_path, name):
    samples, line, told = ARTEFACTS[name]
    path = tmp_path / "lifts.csv"
    path.write_text(table(rows(*samples, form="")))
    with pytest.raises(InputError, match=rf"lifts\.csv, line \d+: trial 'a' .*({told})") as caught:
        load_recordings(path)
    if line is not None:
        assert f", line {line}: " in str(caught.value)
    assert "\n" not in str(caught.value)


IRREGULAR = np.cumsum(np.random.default_rng(1).lognormal(np.log(0.01), 1.0, 500))
IRREGULAR = IRREGULAR[IRREGULAR < 6.0]
PEOPLE = {
    **{f"{rate:g} Hz": lift(rate) for rate in (10.0, 15.0, 30.0, 100.0, 119.88, 240.0, 1000.0)},
    "irregular": (IRREGULAR, np.interp(IRREGULAR, TIMES, HEIGHTS)),
    "steps of 1 cm at 15 Hz": (lift(15.0)[0], np.round(lift(15.0)[1], 2)),
    "steps of 1 cm at 1000 Hz": (lift(1000.0)[0], np.round(lift(1000.0)[1], 2)),
    "noise of 1 mm at 1000 Hz": (
        lift(1000.0)[0],
        lift(1000.0)[1] + 1e-3 * RNG.standard_normal(6000),
    ),
    "noise of 5 mm at 30 Hz": (lift(30.0)[0], lift(30.0)[1] + 5e-3 * RNG.standard_normal(180)),
    "Unix seconds": (1_741_687_872.123 + TIMES, HEIGHTS),
    "another origin": (TIMES, HEIGHTS - 5.0),
    "an origin at the start": (TIMES, HEIGHTS - 0.9),
    "exactly 0 at rest": (TIMES, np.where(TIMES < 1.0, 0.0, HEIGHTS - 0.9)),
    "a fast reach of 1 m": lift(duration=6.0, top=1.0),
    "a slow lift": (TIMES * 4, HEIGHTS),
    "a low lift": lift(top=0.05),
    "downwards": (TIMES, 2.0 - HEIGHTS),
    "samples left out at random": without(300, 315),
    "bursts of a network": (TIMES - np.where(np.arange(600) % 10, 0.0, 0.00999), HEIGHTS),
}


@pytest.mark.parametrize("name", PEOPLE)
def test_movements_of_people_are_read(tmp_path, name):
    path = tmp_path / "lifts.csv"
    path.write_text(table(rows(*PEOPLE[name], form="")))
    (recording,) = load_recordings(path)
    assert np.array_equal(recording.times, PEOPLE[name][0])
    assert np.array_equal(recording.heights, PEOPLE[name][1])


def test_the_line_is_that_of_the_trial_in_a_file_of_several(tmp_path):
    path = tmp_path / "lifts.csv"
    bad = heights(300, 0.0)
    path.write_text("\n" + table(rows(*lift(top=0.4), trial="good"), rows(*bad, trial="bad")))
    with pytest.raises(InputError, match=r"line 903: trial 'bad' z_m is 0"):
        load_recordings(path)


def test_of_several_artefacts_the_first_check_reports():
    assert CHECKS[0](np.array([0.0, 0.0]), np.array([0.0, 1.0])) is not None
    found = fault(np.array([0.0, 0.0]), np.array([0.0, 1.0]))
    assert isinstance(found, Fault)
    assert "must increase" in found.text
    assert fault(TIMES, HEIGHTS) is None
