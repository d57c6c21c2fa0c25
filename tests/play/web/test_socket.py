"""Who may open a socket, and what may be sent: a real server, real sockets, no room yet."""

import contextlib
import json
from dataclasses import replace

import httpx
import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.play.web.keeper import PlayConfig
from colift.play.web.limits import MESSAGES, SOCKETS
from websockets.exceptions import ConnectionClosed, InvalidStatus

from ... import web
from .pages import Page, new_session, open_socket, playing

pytestmark = pytest.mark.slow

HOSTS = frozenset({"127.0.0.1", "localhost"})


async def no_time():
    return "This machine has no time."


@pytest.fixture(scope="module")
def config(tmp_path_factory):
    folder = tmp_path_factory.mktemp("live")
    named = {"hold": PolicySpec(text="hold")}
    return PlayConfig(folder=folder, policies=named, hosts=HOSTS, strict=True, away_s=1)


@pytest.fixture(scope="module")
def url(config):
    """A server that never gives a room: its machine has no time."""
    with playing(config, no_time) as address:
        yield address


@pytest.fixture
def session(url):
    return new_session(url)


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1", None])
def test_pages_of_others_get_no_socket(url, origin):
    with pytest.raises(InvalidStatus) as refusal, open_socket(url, origin):
        pass
    assert refusal.value.response.status_code == 403


def test_pages_of_others_get_no_session(url):
    headers = {"Origin": "https://evil.example"}
    assert web.post(f"{url}/api/sessions", headers=headers).status_code == 403


def test_a_name_that_others_let_stand_for_this_machine_is_refused(url):
    answer = web.get(f"{url}/api/health", headers={"Host": "evil.example"})
    assert answer.status_code == 421
    assert "127.0.0.1, localhost" in answer.json()["error"]


@pytest.mark.parametrize("change", ["session", "secret", "seat", "role"])
def test_a_wrong_link_opens_nothing(url, session, config, change):
    name, secret = session
    other, others = new_session(url)
    asked = {"session": name, "secret": secret, "seat": 0}
    asked |= {"session": {"session": other}, "secret": {"secret": others}, "seat": {"seat": 1}}.get(
        change, {"seat": "spectator"}
    )
    with Page(url, **asked) as page:
        assert page.closed() == 4003
        assert [told["type"] for told in page.told] == ["refused"]


@pytest.mark.parametrize(
    "first",
    [
        "",
        "[" * 4000,
        "1",
        '{"type": "ping", "t": 1}',
        '{"type": "join"}',
        '{"type": "join", "session": null, "secret": [], "seat": {}}',
        b"\1",
    ],
)
def test_a_socket_begins_with_a_link(url, first):
    with open_socket(url) as socket:
        socket.send(first)
        assert json.loads(socket.recv(10))["type"] == "refused"
        with pytest.raises(ConnectionClosed) as end:
            socket.recv(10)
        assert end.value.rcvd.code == 4003


def test_those_who_wait_know_their_place_and_the_reason(url, session):
    first, second = new_session(url), new_session(url)
    with Page(url, *first) as one:
        one.until("queued", place=1, reason="This machine has no time.")
        with Page(url, *second) as two:
            two.until("queued", place=2)
            one.socket.close()
            two.until("queued", place=1, timeout=60)


def test_a_second_window_takes_the_place_and_the_first_says_so(url, session):
    with Page(url, *session) as one, Page(url, *session) as two:
        assert one.closed() == 4001
        assert one.told[-1]["type"] == "taken_over"
        assert "another window" in one.told[-1]["message"]
        two.until("queued")


def test_a_long_message_ends_the_socket(url, session):
    with Page(url, *session) as page:
        page.until("queued")
        page.socket.send(b"\1" + bytes(4095))
        page.socket.send("x" * 5000)
        assert page.closed() == 1009


def test_a_flood_ends_the_socket(url, session):
    with Page(url, *session) as page:
        page.until("queued")
        with contextlib.suppress(ConnectionClosed):
            for number in range(20 * MESSAGES.burst):
                page.say("ping", t=number)
        assert page.closed() == 4003
        assert "more than 400 messages a second" in page.told[-1]["message"]


@pytest.mark.parametrize("kind", ["join", "leave", "state", "", "open"])
def test_other_types_are_not_handed_on(url, session, kind):
    with Page(url, *session) as page:
        page.until("queued")
        for _ in range(2):  # The first one does not end the socket.
            page.say(kind)
            assert "type must be one of" in page.until("fault")["message"]


def test_an_address_has_so_many_sockets(url, session):
    with contextlib.ExitStack() as stack:
        for _ in range(SOCKETS):
            stack.enter_context(open_socket(url))
        with open_socket(url) as socket:
            assert "close one of them" in json.loads(socket.recv(10))["message"]
    with Page(url, *session) as page:
        page.until("queued")


def test_a_spectator_who_comes_first_waits(url, session, config):
    from colift.play.web.sessions import Sessions

    secret = Sessions(config.folder).find(session[0]).secret("spectator")
    with Page(url, session[0], secret, "spectator") as page:
        assert page.until("queued")["place"] == 0


def test_the_page_is_isolated_and_every_answer_is_guarded(url):
    page = web.get(url)
    assert page.headers["Cross-Origin-Embedder-Policy"] == "require-corp"
    assert page.headers["Cross-Origin-Opener-Policy"] == "same-origin"
    assert "hold" in page.text
    for place in ("/", "/api/geometry", "/static/icon.svg", "/nowhere"):
        headers = web.get(f"{url}{place}").headers
        assert headers["Content-Security-Policy"].startswith("default-src 'self'")
        assert headers["Cross-Origin-Resource-Policy"] == "same-origin"


@pytest.mark.parametrize(
    "credential", ["", "Bearer", "Bearer x.y", "Bearer {0}.x", "Basic {0}.{1}", "Bearer x.{1}"]
)
def test_a_replay_needs_a_secret_of_its_session(url, session, credential):
    headers = {"Authorization": credential.format(*session)}
    place = f"{url}/api/sessions/{session[0]}/lifts/001/replay"
    assert web.get(place, headers=headers).status_code == 401


def test_a_replay_that_is_not_there_is_not_found(url, session):
    headers = {"Authorization": "Bearer {}.{}".format(*session)}
    place = f"{url}/api/sessions/{session[0]}/lifts"
    assert web.get(f"{place}/001/replay", headers=headers).status_code == 404
    assert web.get(f"{place}/%2e%2e/replay", headers=headers).status_code in (404, 422)


def test_sessions_are_not_made_without_end(config, tmp_path):
    """On a server of its own: the other tests would find no session left."""
    alone = replace(config, folder=tmp_path)
    with playing(alone, no_time) as address, httpx.Client(base_url=address, timeout=60) as client:
        codes = [client.post("/api/sessions").status_code for _ in range(60)]
    assert codes[-1] == 429
