"""How often somebody may ask, and what every answer carries."""

import socket

import pytest
from colift.leaderboard.service.dependencies import Rates
from colift.leaderboard.service.security import Rate, RateLimit, local_path, network

from ... import web

SELDOM = Rate(per_second=0.01, burst=3)
OFTEN = Rate(per_second=1e6, burst=10**6)


class Clock:
    now = 1000.0

    def __call__(self):
        return self.now


def test_a_burst_then_as_much_as_the_rate_allows():
    clock = Clock()
    limit = RateLimit(rate=Rate(per_second=0.5, burst=3), clock=clock)
    assert [limit.wait("a") for _ in range(4)] == [0, 0, 0, 2]
    clock.now += 1
    assert limit.wait("a") == 1
    clock.now += 1
    assert [limit.wait("a"), limit.wait("a")] == [0, 2]
    assert limit.wait("b") == 0
    clock.now += 1000
    assert [limit.wait("a") for _ in range(4)] == [0, 0, 0, 2]


def test_what_is_remembered_of_clients_is_bounded():
    limit = RateLimit(rate=SELDOM, most=10)
    for number in range(1000):
        limit.wait(str(number))
    assert len(limit._buckets) == 10


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("192.0.2.7", "192.0.2.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::/64"),
        ("2001:db8:1:2:ffff::1", "2001:db8:1:2::/64"),
        ("testclient", "testclient"),
    ],
)
def test_addresses_of_one_subscriber_are_one(address, expected):
    assert network(address) == expected


def test_who_asks_too_often_is_told_when_to_come_again(folder, serving):
    with serving(folder, Rates(address=SELDOM, submitter=OFTEN)) as url:
        answers = [web.get(f"{url}/healthz") for _ in range(4)]
    assert [answer.status_code for answer in answers] == [200, 200, 200, 429]
    assert "too many requests from your address" in answers[-1].json()["error"]
    assert 0 < int(answers[-1].headers["Retry-After"]) <= 100
    assert "Content-Security-Policy" in answers[-1].headers


def test_behind_a_proxy_it_is_the_client_that_is_counted(folder, serving):
    with serving(folder, Rates(address=SELDOM, submitter=OFTEN)) as url:
        codes = [
            web.get(f"{url}/healthz", headers={"X-Forwarded-For": client}).status_code
            for client in ["192.0.2.1"] * 4 + ["192.0.2.2"]
        ]
    assert codes == [200, 200, 200, 429, 200]


def test_who_uploads_too_often_is_told_when_to_come_again(folder, serving, ada):
    with serving(folder, Rates(address=OFTEN, submitter=SELDOM)) as url:
        answers = [
            web.post(f"{url}/api/v1/submissions", headers=ada, content=b"?") for _ in range(4)
        ]
    assert [answer.status_code for answer in answers] == [422, 422, 422, 429]
    assert "ada has submitted too often" in answers[-1].json()["error"]
    assert int(answers[-1].headers["Retry-After"]) > 0


def test_a_request_of_two_lengths_is_refused_and_the_connection_ends(url):
    """What follows it must not be taken for a second request."""
    host, port = url.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), timeout=20) as connection:
        connection.sendall(
            b"POST /api/v1/submissions HTTP/1.1\r\nHost: x\r\nContent-Length: 6\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"
        )
        answer = b""
        while data := connection.recv(65536):
            answer += data
    assert answer.startswith(b"HTTP/1.1 400 ")
    assert answer.count(b"HTTP/1.1 ") == 1
    assert b"Content-Length or Transfer-Encoding, not both" in answer


@pytest.mark.parametrize("path", ["/healthz", "/api", "/api/v1/standings", "/nothing"])
def test_every_answer_tells_browsers_to_trust_nothing_else(client, path):
    headers = client.get(path).headers
    assert "default-src 'self'" in headers["Content-Security-Policy"]
    assert "unsafe" not in headers["Content-Security-Policy"]
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert len(headers["X-Request-ID"]) == 16
    assert "server" not in headers or "uvicorn" not in headers["server"]


HOST = {"Host": "evil.example"}


def test_no_answer_has_the_host_of_the_request(url, client):
    """A cache in front could give it to others."""
    for path in ("/", "/submit", "/api", "/seasons/1/feed.atom", "/api/v1/openapi.json"):
        answer = client.get(path, headers=HOST)
        assert answer.status_code == 200
        assert "evil.example" not in answer.text


@pytest.mark.parametrize("path", ["/seasons/1/", "/method/", "/seasons/1/feed.atom/?x=1"])
def test_a_redirect_stays_on_the_board(client, path):
    answer = client.get(path, headers=HOST)
    assert answer.status_code == 307
    assert answer.headers["Location"] == path.replace("/?", "?").removesuffix("/")


@pytest.mark.parametrize(
    ("address", "path"),
    [
        ("http://evil.example/seasons/x%00", "/seasons/x%00"),
        ("//evil.example/x", "/x"),
        ("https://a/b?c=1#d", "/b?c=1#d"),
        ("/api/v1/jobs/1", "/api/v1/jobs/1"),
        ("http://a//evil.example", "/evil.example"),
    ],
)
def test_a_location_is_a_path(address, path):
    assert local_path(address) == path


def test_a_board_that_knows_its_address_tells_it(folder, serving):
    with serving(folder, address="https://board.example/lift") as url:
        feed = web.get(f"{url}/seasons/1/feed.atom", headers=HOST).text
        submit = web.get(f"{url}/submit", headers=HOST).text
    assert 'href="https://board.example/' in feed
    assert "--board https://board.example/lift</code>" in submit
