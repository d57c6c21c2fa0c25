"""Motion capture over the Lab Streaming Layer: a real outlet in this process."""

import math
import os
import socket
import time
from contextlib import closing

import pytest
from colift.agents.hardware.lsl import Layout, LslCapture
from colift.agents.hardware.ports import CaptureLostError
from colift.base.errors import InputError

pytestmark = pytest.mark.slow

pylsl = pytest.importorskip("pylsl")


@pytest.fixture
def stream(lsl_on_loopback):
    """Open an outlet with a channel for each label, type and unit; yield a sender and its name."""
    kept = []

    def make(*channels):
        name = f"lsl-{os.getpid()}-{time.monotonic_ns()}"
        info = pylsl.StreamInfo(name, "MoCap", len(channels), 100, pylsl.cf_double64, name)
        node = info.desc().append_child("channels")
        for channel in channels:
            each = node.append_child("channel")
            for key, value in channel.items():
                each.append_child_value(key, value)
        kept.append(pylsl.StreamOutlet(info))
        return name, kept[-1]

    yield make
    kept.clear()


def channels(unit="meters", markers=("H1", "H2", "R1", "R2"), axes="XYZ"):
    return [
        {"label": f"{marker}_{axis}", "type": f"Position{axis}", "unit": unit}
        for marker in markers
        for axis in axes
    ]


def received(capture, outlet, rows):
    """Send rows that were captured 50 ms ago, and return what comes out."""
    for row in rows:
        outlet.push_sample(row, pylsl.local_clock() - 0.05)
    frames, end = [], time.monotonic() + 30
    while len(frames) < len(rows) and time.monotonic() < end:
        frames += capture.drain()
        time.sleep(0.005)
    return frames


def test_millimetres_and_another_axis_become_metres_up(stream):
    name, outlet = stream(*channels("millimeters"))
    capture = LslCapture(name, Layout(up="y"))
    row = [0, 1000, 0, 0, 1002, 0, 0, 900, 0, 0, 904, 0]
    (frame,) = received(capture, outlet, [row])
    assert frame[1:] == pytest.approx((1.001, 0.902))
    capture.set_rest(1.0, 0.9)
    (frame,) = received(capture, outlet, [row])
    assert frame[1:] == pytest.approx((0.001, 0.002))
    capture.close()


def test_one_hidden_marker_hides_its_end(stream):
    name, outlet = stream(*channels())
    capture = LslCapture(name, Layout())
    nan = math.nan
    (frame,) = received(capture, outlet, [[0, 0, 1, nan, nan, nan, 0, 0, 1, 0, 0, 1]])
    assert math.isnan(frame.human_end)
    assert frame.robot_end == 1.0
    capture.close()


def test_the_stamps_are_on_this_machines_clock(stream):
    name, outlet = stream(*channels())
    capture = LslCapture(name, Layout())
    before = time.monotonic()
    (frame,) = received(capture, outlet, [[0.0] * 12])
    # The layer's clocks are brought together to half of a round trip, which a busy machine delays.
    assert before - 0.55 < frame.time < time.monotonic() + 0.45
    capture.close()


@pytest.mark.parametrize(
    ("made", "layout", "told"),
    [
        (channels(), Layout(human=("T1",)), "no Z of marker 'T1'; markers: H1, H2, R1, R2"),
        (channels("feet"), Layout(), "unit 'feet'; known: m, "),
        (channels(axes="XY"), Layout(), "no Z of marker 'H1'"),
    ],
)
def test_a_stream_that_does_not_fit_is_refused_by_what_it_lacks(stream, made, layout, told):
    name, _ = stream(*made)
    with pytest.raises(InputError, match=told):
        LslCapture(name, layout)


@pytest.fixture
def twins(lsl_on_loopback):
    """Open outlets of one name, with source ids; yield what opens one."""
    kept = []
    name = f"twins-{os.getpid()}-{time.monotonic_ns()}"

    def make(source):
        info = pylsl.StreamInfo(name, "MoCap", 12, 100, pylsl.cf_double64, source)
        node = info.desc().append_child("channels")
        for channel in channels():
            each = node.append_child("channel")
            for key, value in channel.items():
                each.append_child_value(key, value)
        outlet = pylsl.StreamOutlet(info)
        kept.append(outlet)
        return name, outlet

    make.end = kept.remove
    yield make
    kept.clear()


def test_two_streams_of_a_name_are_refused_and_one_can_be_chosen(twins):
    name, _ = twins("lab-a")
    twins("lab-b")
    host = socket.gethostname()
    with pytest.raises(InputError) as refused:
        LslCapture(name, Layout())
    told = str(refused.value)
    assert f"2 streams are called '{name}'" in told
    for source in ("lab-a", "lab-b"):
        assert f"{name} of {host} (source id {source})" in told
    assert f"choose one, such as lsl:{name}@lab-a" in told
    # Both are on this host: its name does not choose.
    with pytest.raises(InputError, match="2 streams are called"):
        LslCapture(f"{name}@{host}", Layout())
    for source in ("lab-a", "lab-b"):
        with closing(LslCapture(f"{name}@{source}", Layout())) as capture:
            assert capture.info["source_id"] == source
    with pytest.raises(InputError, match=f"no stream '{name}@elsewhere'"):
        LslCapture(f"{name}@elsewhere", Layout())


def test_a_host_chooses_one_stream(twins):
    name, _ = twins("lab-a")
    host = socket.gethostname()
    with closing(LslCapture(f"{name}@{host}", Layout())) as capture:
        assert (capture.info["host"], capture.info["source_id"]) == (host, "lab-a")


def test_streams_that_nothing_tells_apart_are_refused(twins):
    """Such as a sender that was restarted, and whose first process lives on."""
    name, _ = twins("my-vicon")
    twins("my-vicon")
    with pytest.raises(InputError, match="end all but one"):
        LslCapture(f"{name}@my-vicon", Layout())


def test_another_stream_does_not_take_the_place_of_one_that_ends(twins):
    name, outlet = twins("my-vicon")
    capture = LslCapture(name, Layout())
    received(capture, outlet, [[0.0] * 12])
    twins.end(outlet)
    del outlet
    _, other = twins("my-vicon")
    with pytest.raises(CaptureLostError, match="the stream is lost"):
        nothing_comes(capture, other)
    capture.close()


def nothing_comes(capture, outlet, seconds=30):
    """Send frames, none of which is received."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        outlet.push_sample([1.0] * 12)
        assert capture.drain() == []
        time.sleep(0.02)


@pytest.mark.parametrize(
    ("made", "layout", "told"),
    [
        ([*channels(), *channels(markers=("H1",))], Layout(), "2 channels for Z of marker 'H1'"),
        (channels(), {"robot": ("R1", "H1")}, "markers named more than once: H1"),
    ],
)
def test_a_marker_that_is_there_twice_is_refused(stream, made, layout, told):
    name, _ = stream(*made)
    with pytest.raises(InputError, match=told):
        LslCapture(name, layout if isinstance(layout, Layout) else Layout(**layout))
