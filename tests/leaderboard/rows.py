"""Entries and rows with made-up numbers, for tests of what is done with them."""

import dataclasses

import numpy as np
from colift.benchmark.statistics import Estimate, MeanWithMissing
from colift.leaderboard.records.row import BoardRow, HiddenScores, PublicScores
from colift.leaderboard.records.season import BoardEntry


def digest(name):
    return (name.encode().hex() * 64)[:64]


def make_row(name="mine", mean=10.0, season="1", sparc=-1.9):
    estimate = Estimate(mean=mean, ci95=(mean - 1.0, mean + 1.0))
    ratio = Estimate(mean=mean / 10, ci95=(mean / 10 - 0.1, mean / 10 + 0.1))
    public = PublicScores(
        episodes=12,
        failed=0,
        rmse_mm=estimate,
        vs_human=ratio,
        metrics={
            "sparc": MeanWithMissing(mean=sparc, missing=0),
            "human_force_n": MeanWithMissing(mean=0.3, missing=0),
        },
        step_ms_p50=0.2,
        step_ms_p99=0.5,
        real_time=True,
    )
    hidden = HiddenScores(
        episodes=12,
        failed=0,
        failures={},
        real_time=True,
        rmse_mm=estimate,
        vs_human=ratio,
        better_than_human=0.5,
    )
    return BoardRow(
        season=season,
        commitment="c" * 64,
        suite="quick-v1",
        suite_digest="s" * 16,
        name=name,
        authors=("Ada Lovelace", "Grace Höpper"),
        description="Lifts.",
        link="",
        licence="MIT",
        trained_on="nothing",
        submission=digest(name),
        public=public,
        hidden=hidden,
        gap=Estimate(mean=1.02, ci95=(0.9, 1.15)),
        isolation="bubblewrap",
        verified=True,
        scoring=1,
        versions={"colift": "0.1.0"},
    )


def make_entry(board, name="mine", mean=10.0, season="1", refusal=None):
    row = None if refusal else make_row(name, mean, season)
    return BoardEntry(
        season=season,
        submission=digest(name),
        name=name,
        submitter="Ada",
        at=board.clock(),
        row=row,
        refusal=refusal,
    )


def make_errors(mean, episodes=12):
    """Return the RMSE of hidden episodes: the same ups and downs for everybody, as on a suite."""
    return tuple(mean + np.random.default_rng(0).normal(0.0, 0.3, episodes))


def slow(row):
    """Return the row of a policy whose steps took too long for a robot, on hidden lifts."""
    return dataclasses.replace(row, hidden=dataclasses.replace(row.hidden, real_time=False))


def unverified(row):
    """Return the row of a policy that ran without a sandbox."""
    return dataclasses.replace(row, isolation="limits", verified=False)


def add(board, name, mean, season="1", episodes=12, change=lambda row: row):
    """Put a row on a board, as the queue does."""
    from colift.leaderboard.database.queries import record_entry

    entry = make_entry(board, name, mean, season)
    entry = dataclasses.replace(entry, row=change(entry.row))
    with board.database.writing() as connection:
        record_entry(connection, entry, make_errors(mean, episodes))
    return entry


def rescored(row, mean):
    estimate = Estimate(mean=mean, ci95=(mean - 1.0, mean + 1.0))
    return dataclasses.replace(row, hidden=dataclasses.replace(row.hidden, rmse_mm=estimate))


def outcome(job, refusal=None):
    return BoardEntry(
        season=job.season,
        submission=job.submission,
        name=job.name,
        submitter=job.submitter,
        at=job.started_at,
        row=None if refusal else make_row(job.name, 10.0, job.season),
        refusal=refusal,
    )
