"""A season on a few lifts, entrants, and submissions in folders."""

from collections.abc import Callable
from pathlib import Path

import pytest
from colift.agents.policies.loading import PolicySpec
from colift.agents.submissions.new import write_template
from colift.benchmark.references import Reference
from colift.benchmark.suite import make_suite
from colift.leaderboard.evaluation import Entrant, play_team
from colift.leaderboard.season import Season

SECRET = bytes(range(32))
WriteSubmission = Callable[..., Path]


def make_season(secret: bytes = SECRET) -> Season:
    return Season(name="test", suite=make_suite("quick-v1"), secret=secret)


def make_entrant(policy, fresh=None) -> Entrant:
    return Entrant(
        name="mine",
        authors=("Ada", "Grace"),
        description="Lifts.",
        link="",
        digest="d" * 64,
        policy=policy,
        fresh=fresh or policy,
    )


@pytest.fixture(scope="session")
def season() -> Season:
    return make_season()


@pytest.fixture(scope="session")
def team(season: Season) -> Reference:
    return play_team(season)


@pytest.fixture
def copy() -> Entrant:
    return make_entrant(PolicySpec(text="copy"))


@pytest.fixture
def write_submission(tmp_path: Path) -> WriteSubmission:
    """Return what writes the template into a folder, with another policy if one is given."""

    def write(code: str = "", name: str = "mine", manifest: tuple[str, str] = ("", "")) -> Path:
        folder = tmp_path / name
        write_template(folder)
        if code:
            (folder / "policy.py").write_text(code)
        told = folder / "policy.toml"
        told.write_text(told.read_text().replace(*manifest) if manifest[0] else told.read_text())
        return folder

    return write
