"""Boards with rows of real runs, played on quick-v1."""

import dataclasses
from datetime import UTC, datetime, timedelta
from pathlib import Path

from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import HUMAN_HUMAN, play_baselines, shipped_baselines
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.hidden import commitment
from colift.benchmark.suites.suite import make_suite
from colift.leaderboard.core.seasons import ImportedSeason
from colift.leaderboard.evaluation.evaluate import play_human_human
from colift.leaderboard.evaluation.scoring import gap, hidden_scores, public_scores
from colift.leaderboard.records.row import BoardRow
from colift.leaderboard.records.season import BoardEntry, PlayedEntry, Season, SeasonInfo

SECRET = bytes(range(32))
BEGAN = datetime(2026, 11, 20, 9, tzinfo=UTC)
POLICIES = {
    "copy": ("copy", "Follows the human's end as it was seen last."),
    "blend": ("blend", "The paper's method."),
    "hold": ("hold", "Never moves."),
    "<b>sly</b>": ("proportional", "<script>document.title = 'stolen'</script>"),
}
"""The name, what it plays, and its description."""


def practice(folder: Path, season: str, names: tuple[str, ...] = tuple(POLICIES)) -> ImportedSeason:
    """Play some policies, and return them as a season that a board can take over."""
    played = Season(name=season, suite=make_suite("quick-v1"), secret=SECRET)
    human_human = play_human_human(played)
    info = SeasonInfo(
        name=season,
        suite=played.suite.name,
        suite_digest=played.suite.digest,
        commitment=commitment(SECRET),
        began_at=BEGAN,
        current=True,
        revealed=SECRET.hex(),
    )
    adopted = [_adopted(folder, played, human_human, name, i) for i, name in enumerate(names)]
    return ImportedSeason(info=info, entries=adopted, human_human=human_human)


def renamed(season: ImportedSeason, name: str, began_at: datetime) -> ImportedSeason:
    """Return the same rows as another season."""
    info = dataclasses.replace(season.info, name=name, began_at=began_at)
    entries = [
        dataclasses.replace(
            each,
            entry=dataclasses.replace(
                each.entry, season=name, row=dataclasses.replace(each.entry.row, season=name)
            ),
        )
        for each in season.entries
    ]
    return dataclasses.replace(season, info=info, entries=entries)


def unpacked(played: PlayedEntry, folder: Path) -> Path:
    """Write the public run of an entry into a new folder, and return it."""
    folder.mkdir()
    for name, data in played.files.items():
        (folder / name).write_bytes(data)
    return folder


def digest(name: str) -> str:
    return (name.encode().hex() * 64)[:64]


def _adopted(
    folder: Path, season: Season, human_human: ScoreTable, name: str, number: int
) -> PlayedEntry:
    text, description = POLICIES[name]
    policy, bundle = PolicySpec(text=text), folder / str(number)
    public = run_suite(policy, season.suite)
    hidden = run_suite(policy, season.hidden)
    baselines = shipped_baselines(season.suite) or play_baselines(season.suite)
    content = results(public, baselines)
    write_bundle(bundle, public, content.plain(), human_human=baselines[HUMAN_HUMAN])
    row = BoardRow(
        season=season.name,
        commitment=season.commitment,
        suite=season.suite.name,
        suite_digest=season.suite.digest,
        name=name,
        authors=("Ada Lovelace",) if number % 2 else ("Grace Hopper", "Ada Lovelace"),
        description=description,
        link="https://example.org/lift",
        licence="BSD-2-Clause",
        trained_on="<i>recorded</i> lifts" if name == "<b>sly</b>" else "nothing",
        submission=digest(name),
        public=public_scores(content),
        hidden=hidden_scores(hidden, human_human),
        gap=gap(
            ScoreTable.of(hidden).against(human_human),
            ScoreTable.of(public).against(baselines[HUMAN_HUMAN]),
        ),
        isolation="bubblewrap",
        verified=True,
        scoring=1,
        versions={"colift": "0.1.0"},
    )
    entry = BoardEntry(
        season=season.name,
        submission=row.submission,
        name=name,
        submitter="ada",
        at=BEGAN + timedelta(hours=number),
        row=row,
        refusal=None,
    )
    files = {path.name: path.read_bytes() for path in bundle.iterdir()}
    errors = tuple(episode.scores["rmse_mm"] for episode in hidden.episodes)
    return PlayedEntry(entry=entry, hidden_rmse_mm=errors, files=files)
