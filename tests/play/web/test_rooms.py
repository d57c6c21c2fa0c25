"""Pages and rooms: real lifts over real sockets, by a hand that follows the cues."""

import json
import multiprocessing
import os
import signal
import time

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.real_lifts.session_folder import EVENTS, lift_folders
from colift.play.rooms.messages import parse_frame
from colift.play.web.keeper import PlayConfig

from ... import web
from .pages import GRIP, Page, new_session, playing, samples

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def config(tmp_path_factory):
    """One room, and a moment for those who come back."""
    named = {"hold": PolicySpec(text="hold"), "copy": PolicySpec(text="copy")}
    return PlayConfig(folder=tmp_path_factory.mktemp("live"), policies=named, rooms=1, away_s=0.5)


@pytest.fixture(scope="module")
def url(config):
    with playing(config) as address:
        yield address


@pytest.fixture
def session(url):
    """A new session; the room of the one before has ended."""
    wait_for(url, rooms=0)
    return new_session(url)


def wait_for(url, **wanted):
    end = time.monotonic() + 30
    while not wanted.items() <= web.get(f"{url}/api/health").json().items():
        assert time.monotonic() < end
        time.sleep(0.1)


def events(config, session, kind):
    lines = (config.folder / session / EVENTS).read_text().splitlines()
    return [line for line in map(json.loads, lines) if line["event"] == kind]


def room_processes():
    """Return the ids of this process's rooms: those that a fork server has forked."""
    return [child.pid for child in multiprocessing.active_children() if child.name == "room"]


def test_a_lift_from_the_first_ping_to_its_replay(url, session, config):
    name, secret = session
    with Page(url, name, secret) as host:
        joined = host.until("joined")
        assert joined["seat"] == 0
        host.say("ping", t=17)
        assert host.until("pong")["t"] == 17
        host.ready()
        with Page(url, *joined["watch"].split("."), "spectator") as spectator:
            assert spectator.until("joined")["watch"] is None
            assert spectator.until("state")["you"] == "spectator"
            spectator.say("ping", t=18)
            assert spectator.until("pong")["t"] == 18
            spectator.say("release")
            assert "type must be one of ping" in spectator.until("fault")["message"]
            spectator.socket.send(samples(0, [(0.0, 0.1)]))
            assert "a spectator watches" in spectator.until("fault")["message"]
            end = host.lifted()
            assert spectator.until("end")["lift"] == end["lift"]
            assert "cue" in [told["type"] for told in host.told]
            assert "pong" not in [told["type"] for told in host.told[3:]]
            shown = {told["type"] for told in spectator.told}
            assert shown == {"joined", "state", "pong", "fault", "start", "end"} | (
                shown & {"void"}
            )
            assert spectator.frames == host.frames
    assert parse_frame(host.frames[-1])[0].frame == end_frame(host)
    assert [path.name for path in lift_folders(config.folder / name)] == ["001-hold"]
    assert len(events(config, name, "join")) == 1
    place, headers = f"{url}/api/sessions/{name}/lifts/001/replay", bearer(name, secret)
    replay = web.get(place, headers=headers).json()
    assert replay["policy"] == "hold"
    assert replay["scores"]["rmse_mm"] == pytest.approx(end["rmse_mm"], abs=1e-3)
    assert replay["ghost"]["rmse_mm"] == pytest.approx(end["ghost_rmse_mm"], abs=1e-3)


def end_frame(page):
    """Return how many frames the last lift of a page had."""
    return [told for told in page.told if told["type"] == "start"][-1]["frames"]


def bearer(name, secret):
    return {"Authorization": f"Bearer {name}.{secret}"}


def test_a_room_that_is_killed_is_replaced_and_the_lift_under_way_is_lost(url, session, config):
    name, _ = session
    with Page(url, *session) as host:
        host.ready()
        host.say("choose", partner="copy", latency_ms=None, kind="smooth")
        host.until("state", phase="ready", partner="copy")
        host.say("grip", **GRIP)
        host.until("start")
        (room,) = room_processes()
        os.kill(room, signal.SIGKILL)
        assert "does not count" in host.until("room_lost")["message"]
        assert host.until("state", phase="ready", partner="copy")["lift"] == 1
        host.say("grip", **GRIP)
        assert host.until("start")["lift"] == 1
        assert len(room_processes()) == 1
    assert lift_folders(config.folder / name) == []
    assert len(events(config, name, "room lost")) == 1


def test_the_only_room_is_given_to_one_session_after_the_other(url, session):
    other = new_session(url)
    with Page(url, *other) as second:
        with Page(url, *session) as first:
            second.until("joined")
            assert first.until("queued")["reason"] == "The only room is taken."
            second.socket.close()
            first.until("joined")
            first.ready()
        assert [told["type"] for told in first.told].count("joined") == 1


def test_two_people_meet_in_one_room_and_nobody_else(url, session):
    with Page(url, *session) as host:
        joined = host.until("joined")
        host.ready()
        host.say("choose", partner="person", latency_ms=None, kind="smooth")
        host.until("state", phase="waiting")
        with Page(url, *joined["invite"].split("."), 1) as person:
            assert person.until("joined")["invite"] is None
            assert person.until("state", phase="ready")["you"] == "far"
            assert host.until("state", phase="ready")["people"] == 2
            with Page(url, *joined["invite"].split("."), 1) as again:
                assert person.closed() == 4001
                again.until("state", phase="ready")
            host.until("state", phase="waiting")
        _, secret = new_session(url)
        with Page(url, session[0], secret) as page:
            assert page.closed() == 4003
