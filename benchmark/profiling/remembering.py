"""The memory that a policy can have of a lift: the time that it took."""

import contextlib
import dataclasses
import math
import statistics
import tempfile
from pathlib import Path
from typing import Final

from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.suites.catalogue import make_scenario

LIFTS: Final = 20
"""Equal lifts whose times are compared."""

APART: Final = 4.0
"""Standard deviations by which two times must differ to be told apart in 19 of 20 lifts."""

_OBSERVER: Final = """
import socket, time

orders = [time.monotonic()]
received = socket.recv_fds

def noting(*arguments):
    order = received(*arguments)
    orders.append(time.monotonic())
    return order

socket.recv_fds = noting

class Observer:
    def reset(self, seed):
        pass

    def act(self, observation):
        return [0.0]

    def internals(self):
        return {"before": orders[-1] - orders[-2]}
"""
"""A policy that notes the time between two orders to fork a lift: nothing else can be kept."""


def bits_of_time(policy: SandboxedPolicy, lifts: int = LIFTS) -> float:
    """Return the number of bits that a lift can pass on by the time it takes.

    It is log2(1 + T / (4 s)), with the time T by which a policy may delay a lift, and the standard
    deviation s of the time that equal lifts take, here and now.

    Parameters
    ----------
    policy
        Any sandboxed policy; its isolation level and its limits count.
    lifts
        Number of lifts.
    """
    times = []
    with (
        tempfile.TemporaryDirectory(prefix="colift-") as folder,
        contextlib.closing(Lift(make_scenario("smooth"))) as lift,
    ):
        Path(folder, "policy.py").write_text(_OBSERVER)
        observer = dataclasses.replace(
            policy, origin="policy:Observer", parameters="", folder=Path(folder)
        )
        for _ in range(lifts + 2):
            with observer.agent() as agent:
                trace = run_episode(lift, agent, 0).trace
            times.append(float(trace.internals["before"][0]))
    limits = policy.limits
    most = limits.start_seconds + len(trace.action) * limits.pace_seconds
    return math.log2(1.0 + most / (APART * statistics.stdev(times[2:])))
