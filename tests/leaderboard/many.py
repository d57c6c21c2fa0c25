"""A board of thousands of rows, made from those of the practice season.

As a program, ``many.py FOLDER ROWS`` makes such a board in a new folder, to be measured.
"""

import dataclasses
import hashlib
import os
import sys
from datetime import timedelta
from pathlib import Path

import numpy as np
from colift.benchmark.statistics import Estimate
from colift.leaderboard.core.board import Board
from colift.leaderboard.database.queries import read_error_numbers, read_errors, record_entry
from colift.leaderboard.practice.season_import import open_with_practice
from colift.leaderboard.records.season import BoardEntry


def add_many(board: Board, first: int, last: int, seed: int = 0) -> None:
    """Add rows to the current season: variants of its own, with their bundles hard-linked.

    Their errors are those of a real row on the same hidden lifts, scaled, with noise of their own.
    """
    season = board.season_info().name
    with board.database.reading() as connection:
        numbers = read_error_numbers(connection, season)
        errors = read_errors(connection, season, numbers)
    real = [each for each in board.standings() if not each.row.name.startswith("policy-")]
    with board.database.writing() as connection:
        for number in range(first, last):
            rng = np.random.default_rng((seed, number))
            found = real[number % len(real)]
            old = errors[found.row.submission]
            made = old * rng.uniform(0.9, 1.6) * rng.lognormal(0.0, 0.3, old.size)
            mean, half = float(made.mean()), float(1.96 * made.std() / made.size**0.5)
            rmse = Estimate(mean=mean, ci95=(mean - half, mean + half)).rounded(2)
            digest = hashlib.sha256(f"{seed} {number}".encode()).hexdigest()
            row = dataclasses.replace(
                found.row,
                name=f"policy-{number:05d}",
                submission=digest,
                authors=("Ada Lovelace", f"Author {number % 97}"),
                hidden=dataclasses.replace(found.row.hidden, rmse_mm=rmse),
            )
            at = found.at + timedelta(seconds=number + 1)
            entry = BoardEntry(
                season=season,
                submission=digest,
                name=row.name,
                submitter="ada",
                at=at,
                row=row,
                refusal=None,
            )
            record_entry(connection, entry, tuple(made))
            bundle = board.bundle(season, found.row.submission)
            place = board.store.bundle(season, digest)
            place.mkdir(parents=True)
            for path in bundle.iterdir() if bundle else ():
                if path.is_file():
                    os.link(path, place / path.name)


if __name__ == "__main__":
    made = open_with_practice(Path(sys.argv[1]))
    add_many(made, 0, int(sys.argv[2]))
    made.close()
