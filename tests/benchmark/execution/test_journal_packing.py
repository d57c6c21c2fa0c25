"""An episode that was record_of and episode_of is the same one, to the bit."""

import dataclasses
import math

import msgpack
import numpy as np
import pytest
from colift.agents.policies.blend import Blend
from colift.agents.policies.copy import Copy
from colift.base.errors import PolicyError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.execution.records import episode_of, record_of
from colift.benchmark.suites.catalogue import make_scenario

HIDDEN_SEED = 2**127 + 3


class Failing(Blend):
    """Explains itself, fails at a step, and has printed what no text may hold."""

    printed = "line\n\ud800\x00\N{PILE OF POO}"
    last_step = 12

    def reset(self, seed):
        super().reset(seed)
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        if self.steps > self.last_step:
            raise PolicyError("no \ud800 more")
        return super().act(observation)


class Refusing(Failing):
    last_step = 0


@pytest.fixture(scope="module", params=[Copy, Failing, Refusing])
def episode(request):
    lift = Lift(make_scenario("pause", "S2"))
    yield run_episode(lift, request.param(), HIDDEN_SEED)
    lift.close()


def plain(value):
    """Return a value so that equal ones have equal bits, NaN included."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, float):
        return value.hex() if math.isfinite(value) else repr(value)
    if dataclasses.is_dataclass(value):
        return {each.name: plain(getattr(value, each.name)) for each in dataclasses.fields(value)}
    if isinstance(value, dict):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, tuple):
        return tuple(plain(each) for each in value)
    return value


def test_all_bits_of_an_episode_come_back(episode):
    data = msgpack.packb(record_of(episode), unicode_errors="surrogatepass")
    back = episode_of(msgpack.unpackb(data, unicode_errors="surrogatepass"))
    assert plain(back) == plain(episode)
    assert back.trace.digest() == episode.trace.digest()


def test_what_comes_back_can_be_changed(episode):
    back = episode_of(record_of(episode))
    back.trace.human_end[:] = 0.0


def test_every_field_is_packed(episode):
    names = {each.name for each in dataclasses.fields(type(episode))}
    assert set(record_of(episode)) == names
    assert set(record_of(episode)["trace"]) == {
        each.name for each in dataclasses.fields(type(episode.trace))
    }
