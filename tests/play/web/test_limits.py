"""Bounds of what waits for a page, of who may ask, and of a machine's time."""

import asyncio

import pytest
from colift.play.web import load
from colift.play.web.limits import Places, same_origin
from colift.play.web.page import Outbox
from starlette.requests import HTTPConnection


def taken(outbox):
    """Return all that waits."""

    async def take():
        outbox.close()
        found = []
        while (message := await outbox.get()) is not None:
            found.append(message)
        return found

    return asyncio.run(take())


def test_a_slow_page_loses_its_oldest_frames_and_no_sentence():
    outbox = Outbox(most=4)
    for message in (b"1", "start", b"2", b"3", b"4", "end"):
        assert outbox.put(message)
    assert outbox.dropped == 2
    assert taken(outbox) == ["start", b"3", b"4", "end"]


def test_a_page_that_takes_no_sentences_is_given_up():
    outbox = Outbox(most=3)
    assert [outbox.put(str(number)) for number in range(4)] == [True, True, True, False]
    assert taken(outbox) == ["0", "1", "2"]


@pytest.mark.parametrize(
    ("origin", "host", "expected"),
    [
        ("http://127.0.0.1:8100", "127.0.0.1:8100", True),
        ("https://Lab.example", "lab.example", True),
        ("http://127.0.0.1:8000", "127.0.0.1:8100", False),
        ("https://evil.example", "lab.example", False),
        ("http://lab.example.evil.example", "lab.example", False),
        ("null", "lab.example", False),
        (None, "lab.example", False),
        ("http://lab.example", None, False),
        (None, None, False),
    ],
)
def test_only_pages_of_this_server_are_of_this_origin(origin, host, expected):
    given = {"origin": origin, "host": host}
    headers = [(name.encode(), value.encode()) for name, value in given.items() if value]
    assert same_origin(HTTPConnection({"type": "http", "headers": headers})) is expected


def test_places_come_back_and_nothing_is_remembered_of_those_who_left():
    places = Places(2)
    with places.held("a") as first, places.held("a") as second, places.held("b") as other:
        assert (first, second, other) == (True, True, True)
        with places.held("a") as third:
            assert not third
        with places.held("a") as again:
            assert not again
    with places.held("a") as free:
        assert free
    assert not places._taken


@pytest.mark.parametrize(
    ("late", "free", "told"),
    [
        ([0.0001] * 30, 1.5, None),
        ([0.0001] * 30, None, None),
        ([0.0001] * 28 + [0.05] * 2, 1.5, None),
        ([0.0001] * 20 + [0.02] * 10, 1.5, "late by 20 ms"),
        ([0.0001] * 30, 0.1, "no core is free"),
    ],
)
def test_a_machine_without_time_says_why(late, free, told):
    reason = load.busy_reason(late, free)
    assert reason is None if told is None else told in reason


def test_this_machine_can_be_measured():
    before = load.idle_seconds()
    assert before is not None
    asyncio.run(load.busy())
    assert load.idle_seconds() >= before
