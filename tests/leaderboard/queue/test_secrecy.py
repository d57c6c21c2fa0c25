"""What may be published holds nothing of the hidden episodes, whatever a policy tries."""

import io
import zipfile

import numpy as np
import pytest
from colift.benchmark.episode.lift import Lift
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.verification.checking import LIFTS, SEED
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.queries import read_error_numbers, read_errors
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.queue.worker import Worker

from ..signed import write_signed

TELLTALE = """
import sys
import numpy as np

class Policy:
    def reset(self, seed):
        self.seed, self.hidden = seed, None
        print(f"MARK seed {seed}")

    def internals(self):
        return {"seen": self.seen}

    def act(self, observation):
        self.seen = float(observation[0])
        print(f"MARK {observation}", file=sys.stderr)
        if self.hidden is None:
            self.hidden = observation.tolist() not in PUBLIC
        if self.hidden and observation[4] > 0.5:
            raise RuntimeError(f"MARK {self.seed} {observation}")
        return np.array([observation[0] - observation[3]])
"""


def beginnings():
    """Return the first observation of each lift that anybody can play: of check and suites."""
    lifts = [(make_scenario(*lift), (SEED,)) for lift in LIFTS]
    suites = [make_suite(name) for name in ("quick-v1", "tiny")]
    lifts += [(each, suite.seeds) for suite in suites for each in suite.scenarios]
    found = []
    for scenario, seeds in lifts:
        lift = Lift(scenario)
        for seed in seeds:
            lift.reset(seed)
            found.append(lift.partner_observation().tolist())
        lift.close()
    return found


@pytest.fixture(scope="module")
def published(tmp_path_factory, tiny_suite):
    """Evaluate a policy that tells all it sees; return the board and its entry.

    It knows the public lifts by heart: their seed does not give the hidden ones away.
    """
    folder = tmp_path_factory.mktemp("secrecy")
    write_signed(folder / "telltale")
    source = f"PUBLIC = {beginnings()}\n{TELLTALE}"
    (folder / "telltale" / "policy.py").write_text(source)
    board = Board.open(folder / "board", "tiny")
    queue = Queue(board)
    queue.enqueue(board.keep(folder / "telltale"))
    job = Worker(WorkerQueue(queue.board)).once()
    yield board, board.entry("1", job.submission)
    board.close()


def contents(board):
    """Return all bytes that may be published, and those within archives; names too."""
    season = board.seasons()[0]
    (standing,), (entry,) = board.standings(), board.entries_of("telltale")
    (job,) = Queue(board).jobs()
    told = [
        vars(season),
        standing.row.plain(),
        entry.plain(),
        job.plain(),
        vars(board.human_human()),
    ]
    told += [event.plain() for event in board.events()]
    found = [repr(told).encode(), job.log.encode(), board.ranking().to_csv().encode()]
    for path in (*(board.folder / "public").rglob("*"), *(board.folder / "logs").iterdir()):
        found.append(str(path.relative_to(board.folder)).encode())
        if path.is_file():
            found.append(path.read_bytes())
            if path.suffix == ".npz":
                with zipfile.ZipFile(path) as archive:
                    found += [archive.read(name) for name in archive.namelist()]
    return found


def hidden_errors(board, submission):
    """Return the RMSE of the hidden episodes, as the database keeps them."""
    with board.database.reading() as connection:
        numbers = read_error_numbers(connection, "1")
        return [float(each) for each in read_errors(connection, "1", numbers)[submission]]


def spellings(number, size):
    """Return how a seed can be written."""
    return (
        str(number).encode(),
        f"{number:x}".encode(),
        number.to_bytes(size, "big"),
        number.to_bytes(size, "little"),
    )


def test_the_policy_saw_hidden_episodes_and_failed_there(published):
    _, entry = published
    assert (entry.row.public.failed, entry.row.hidden.failed) == (0, 2)
    assert entry.row.hidden.failures == {"step": 2}


def test_the_scan_finds_what_is_public(published):
    board, entry = published
    everything = b"\n".join(contents(board))
    assert entry.row.commitment.encode() in everything
    traces = next(board.folder.glob("public/1/entries/*/bundle/traces.npz"))
    with np.load(io.BytesIO(traces.read_bytes())) as arrays:
        assert arrays["action"].tobytes()[:64] in everything


def test_no_secret_seed_or_person_is_in_what_is_published(published):
    board, _ = published
    season = board.season
    hidden = [season.secret, season.secret.hex().encode()]
    for seed in season.hidden.seeds:
        hidden += spellings(seed, 16)
    for scenario in season.hidden.scenarios:
        person = scenario.subject.name
        hidden += [person.encode(), *spellings(int(person.removeprefix("draw-")), 16)]
        hidden += [repr(scenario.subject.stiffness).encode(), season.hidden.digest.encode()]
    everything = b"\n".join(contents(board))
    assert [each for each in hidden if each in everything] == []


def test_no_word_of_the_policy_from_hidden_episodes_is_in_what_is_published(published):
    board, _ = published
    assert b"MARK" not in b"\n".join(contents(board))


def test_no_trace_or_score_of_a_hidden_episode_is_in_what_is_published(published):
    board, entry = published
    everything = b"\n".join(contents(board))
    errors = hidden_errors(board, entry.submission)
    assert len(errors) == 2
    assert [each for each in errors if repr(each).encode() in everything] == []
    from colift.agents.loading.policy_spec import PolicySpec

    episode = run_suite(PolicySpec(text="copy"), board.season.hidden).episodes[0]
    for series in (episode.trace.target, episode.trace.human_end[:50]):
        assert series.tobytes() not in everything


def test_only_the_owner_can_read_what_is_private(published):
    board, _ = published
    private = (board.folder / "private").rglob("*")
    for path in (*private, *board.folder.glob("board.sqlite*")):
        assert path.stat().st_mode & 0o077 == 0, path


def test_what_is_published_can_be_read_by_others(published):
    board, _ = published
    for path in (board.folder / "public").rglob("*"):
        assert path.stat().st_mode & 0o044 == 0o044, path
