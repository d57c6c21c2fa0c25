"""The operator's controls: what presses the stop button, and when the table counts as taken out."""

import itertools
import os
import signal
import sys
import threading
import time
from pathlib import Path

import pytest
from colift.agents.hardware import operator
from colift.agents.hardware.operator import (
    BACKGROUND,
    STOPPING,
    StopButton,
    armed,
    await_table_out,
)


def test_what_would_end_or_suspend_the_process_presses_the_button():
    kept = {number: signal.getsignal(number) for number in (*STOPPING, *BACKGROUND)}
    for number in STOPPING:
        button = StopButton()
        with armed(button):
            signal.raise_signal(number)
            for background in BACKGROUND:
                signal.raise_signal(background)
        assert button.reason == signal.Signals(number).name
    assert {number: signal.getsignal(number) for number in kept} == kept


def test_a_hang_up_that_was_ignored_presses_the_button():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        button = StopButton()
        with armed(button):
            signal.raise_signal(signal.SIGHUP)
        assert button.reason == "SIGHUP"
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def pressed_at(moment, ends):
    """Press a button at a moment of its wait, as a handler of signals of the same thread does."""
    button = StopButton()
    lines = 0

    def trace(*_):
        nonlocal lines
        if lines == moment:
            button.press("a signal")
        lines += 1
        return trace

    sys.settrace(trace)
    button.wait(0.02)
    sys.settrace(None)
    ends.append((lines, button.wait(0.0)))


def test_a_press_amid_its_own_wait_does_not_hang():
    for moment in itertools.count():
        ends = []
        waiting = threading.Thread(target=pressed_at, args=(moment, ends), daemon=True)
        waiting.start()
        waiting.join(10.0)
        assert ends, f"pressed at line {moment} of the wait, it waits forever"
        [(lines, pressed)] = ends
        assert pressed is (lines > moment)
        if not pressed:
            break
    assert moment > 3


def test_a_press_wakes_all_that_wait():
    button = StopButton()
    woken = []
    waiting = [
        threading.Thread(target=lambda: woken.append(button.wait(20.0)), daemon=True)
        for _ in range(4)
    ]
    for thread in waiting:
        thread.start()
    time.sleep(0.1)
    begin = time.monotonic()
    button.press("the Enter key")
    button.press("SIGTERM")
    for thread in waiting:
        thread.join(10.0)
    assert woken == [True] * 4
    assert time.monotonic() - begin < 10.0
    assert button.reason == "the Enter key"


@pytest.fixture
def keyboard(monkeypatch):
    """An input on which keys are pressed by writing to the other end, which is yielded."""
    monkeypatch.setattr(operator, "HANDOVER", 0.6)
    reading, writing = os.pipe()
    with os.fdopen(reading) as stdin, os.fdopen(writing, "wb", buffering=0) as keys:
        monkeypatch.setattr(sys, "stdin", stdin)
        yield keys


def waited(button, *, attended=True, later=()):
    """Return how long the table was waited for [s], while something happens after 0.3 s."""
    timers = [threading.Timer(0.3, action) for action in later]
    for timer in timers:
        timer.start()
    begin = time.monotonic()
    await_table_out(button, attended=attended)
    for timer in timers:
        timer.join()
    return time.monotonic() - begin


def pressed(*reasons):
    button = StopButton()
    for reason in reasons:
        button.press(reason)
    return button


@pytest.mark.slow
@pytest.mark.parametrize("reasons", [(), ("SIGINT",), ("the Enter key",), ("SIGTSTP",)])
def test_who_is_at_the_terminal_is_waited_for(keyboard, reasons):
    enter = waited(pressed(*reasons), later=[lambda: time.sleep(1.0) or keyboard.write(b"\n")])
    assert enter > 1.2


def test_another_ctrl_c_counts_as_enter(keyboard):
    button = pressed("SIGINT")
    assert 0.25 < waited(button, later=[lambda: button.press("SIGINT")]) < 0.6


@pytest.mark.slow
@pytest.mark.parametrize("reason", ["SIGHUP", "SIGTERM", "SIGQUIT", "the terminal is gone"])
def test_a_stop_from_elsewhere_gives_a_stated_time(keyboard, reason):
    assert 0.55 < waited(pressed(reason)) < 5.0
    enter = waited(pressed(reason), later=[lambda: keyboard.write(b"\n")])
    assert 0.25 < enter < 0.55


@pytest.mark.slow
def test_a_terminal_that_vanishes_meanwhile_gives_a_stated_time(keyboard):
    assert 0.85 < waited(pressed(), later=[keyboard.close]) < 5.0
    assert 0.55 < waited(pressed(), attended=True) < 5.0
    button = pressed()
    assert 0.55 < waited(button, later=[lambda: button.press("SIGHUP")]) < 5.0


def test_nobody_is_not_asked(keyboard):
    button = pressed("SIGINT")
    keyboard.write(b"\n")
    assert 0.55 < waited(button, attended=False, later=[lambda: button.press("SIGINT")]) < 5.0


@pytest.mark.parametrize("stdin", [None, "closed"])
def test_without_an_input_it_is_a_stated_time(monkeypatch, stdin):
    monkeypatch.setattr(operator, "HANDOVER", 0.6)
    if stdin == "closed":
        with Path(os.devnull).open() as stdin:
            pass
    monkeypatch.setattr(sys, "stdin", stdin)
    assert 0.55 < waited(pressed()) < 5.0
