"""Calls as they travel to a cluster: without their large values, back as they were."""

import hashlib
import os
import threading

import pytest
from colift.base.errors import InputError
from colift.benchmark.execution.cluster import LARGE, call, parcel
from colift.benchmark.execution.provenance import origin

WEIGHTS = os.urandom(LARGE)
active = 0


def kept(*values, **more):
    return values, more


def sent_apart(*values):
    """Return a parcel of a call with these values, and what was sent apart from it."""
    sent = []

    def send(value):
        sent.append(value)
        return value

    data, large = parcel(kept, values, {"more": values}, send)
    return data, large, sent


def alone():
    global active
    active += 1
    try:
        for _ in range(1000):
            assert active == 1
    finally:
        active -= 1


def test_a_call_comes_back_as_it_was():
    values = (1.5, "text", b"short", (WEIGHTS, {"inside": WEIGHTS}), None)
    data, large, _ = sent_apart(*values)
    assert call(data, large, origin()) == (values, {"more": values})


def test_large_values_travel_apart_by_their_hash():
    data, large, sent = sent_apart(WEIGHTS)
    assert len(data) < 2000
    assert large == {hashlib.sha256(WEIGHTS).hexdigest(): WEIGHTS}
    assert set(sent) == {WEIGHTS}
    assert sent_apart(WEIGHTS[1:])[1:] == ({}, [])


def test_a_worker_of_another_origin_refuses_and_names_the_difference():
    data, large, _ = sent_apart()
    with pytest.raises(InputError, match=r"python is 'CPython .*' on a worker that has joined"):
        call(data, large, {**origin(), "python": "CPython 2.7"})


def test_calls_in_the_threads_of_a_worker_take_turns():
    data, large = parcel(alone, (), {}, lambda value: value)
    failed = []

    def run():
        try:
            call(data, large, origin())
        except AssertionError as error:
            failed.append(error)

    threads = [threading.Thread(target=run) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []
