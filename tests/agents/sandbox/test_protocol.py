"""Frames between a policy and its episode."""

import contextlib
import socket
import struct

import msgpack
import pytest
from colift.agents.sandbox.protocol import FRAME, Channel, ClosedError, WireError, packed, unpacked
from hypothesis import given
from hypothesis import strategies as st

LENGTH = struct.Struct(">I")


@pytest.fixture
def ends():
    """The two ends of a connection: a channel that does not wait, and a plain socket."""
    here, there = socket.socketpair()
    here.setblocking(False)
    with here, there:
        yield Channel(here), there


@given(
    st.lists(
        st.floats(allow_nan=False) | st.text(max_size=50) | st.lists(st.floats(allow_nan=False))
    )
)
def test_what_is_packed_comes_back_to_the_bit(content):
    frame = packed(content)
    assert LENGTH.unpack(frame[:4])[0] == len(frame) - 4
    back = unpacked(frame[4:])
    assert back == content
    assert packed(back) == frame


def test_a_frame_in_pieces_is_one_frame(ends):
    channel, other = ends
    frame = packed([1, "action", [0.25]])
    for place in range(len(frame) - 1):
        other.sendall(frame[place : place + 1])
        assert channel.fetch() is None
        assert channel.partial.startswith(f"sent {place + 1} bytes")
    other.sendall(frame[-1:])
    assert channel.fetch() == [1, "action", [0.25]]
    assert channel.partial == ""
    assert channel.fetch() is None


def test_the_longest_frame_passes_and_a_longer_one_is_refused_by_who_sends():
    text = "x" * (FRAME - 4)
    assert len(packed([text])) == 4 + FRAME
    with pytest.raises(WireError, match="65537 bytes; at most 65536"):
        packed([text + "x"])


def test_a_length_over_the_cap_is_refused_before_its_body_comes(ends):
    channel, other = ends
    other.sendall(LENGTH.pack(FRAME + 1))
    with pytest.raises(WireError, match="65537 bytes; at most 65536"):
        channel.fetch()


def test_a_second_frame_behind_the_first_is_refused(ends):
    channel, other = ends
    other.sendall(2 * packed([1]))
    with pytest.raises(WireError, match="more than one answer"):
        channel.fetch()


@pytest.mark.parametrize(
    ("body", "told"),
    [
        (b"", "not msgpack"),
        (b"\xc1", "not msgpack"),
        (msgpack.packb([1]) + b"\x00", "not msgpack"),
        (b"\x91" * 1000, "not msgpack"),
        (b"\xdd\xff\xff\xff\xff", "not msgpack"),
        (msgpack.packb([{"a": 1}]), "not msgpack"),
        (msgpack.packb([msgpack.ExtType(1, b"x")]), "not msgpack"),
        (msgpack.packb([msgpack.Timestamp(0)]), "not msgpack"),
        (b"\x91\xa1\xff", "not msgpack"),
        (msgpack.packb(7), "a int instead of a list"),
        (msgpack.packb(None), "a NoneType instead of a list"),
    ],
)
def test_what_is_no_list_of_plain_values_is_refused(ends, body, told):
    channel, other = ends
    other.sendall(LENGTH.pack(len(body)) + body)
    with pytest.raises(WireError, match=told):
        channel.fetch()


@given(st.binary(max_size=200))
def test_any_bytes_are_a_list_or_an_error(body):
    with contextlib.suppress(WireError):
        assert type(unpacked(body)) is list


@pytest.mark.parametrize("content", [[object()], [1 << 70], [{1, 2}], ["\udc80"]])
def test_what_a_frame_cannot_hold_is_refused_and_leaves_nothing_behind(content):
    whole = packed([1, "action"])
    with pytest.raises(WireError, match="cannot be sent"):
        packed([1, "action", *content])
    assert packed([1, "action"]) == whole


def test_an_end_that_closes_is_told_from_one_that_closes_within_a_frame(ends):
    channel, other = ends
    other.sendall(packed([1])[:5])
    other.close()
    assert channel.fetch() is None
    with pytest.raises(ClosedError, match="sent 5 bytes of an answer, then no more"):
        channel.fetch()
    with pytest.raises(ClosedError, match="closed the connection"):
        channel.send(packed([1]))


def test_sending_to_who_does_not_read_ends_and_never_waits(ends):
    channel, _ = ends

    def flood():
        for _ in range(1000):
            channel.send(packed(["x" * 60_000]))

    with pytest.raises(ClosedError, match="does not read"):
        flood()


def test_receiving_waits_for_the_whole_frame():
    here, there = socket.socketpair()
    with here, there:
        there.sendall(packed([1, "ready"]))
        assert Channel(here).receive() == [1, "ready"]
        there.close()
        with pytest.raises(ClosedError):
            Channel(here).receive()
