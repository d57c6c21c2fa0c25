"""Scores of the built-in policies on the public lifts of a practice season."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from colift.benchmark.bundle.files import EPISODES
from colift.benchmark.episode.metric import LEADING
from colift.benchmark.statistics import FloatArray
from colift.benchmark.suites.policies import own_playing_on
from colift.benchmark.suites.suite import Suite
from colift.leaderboard.evaluation.entrant import builtin_entrant
from colift.leaderboard.practice.season_import import DATA, PlayedSeason
from colift.leaderboard.records.season import PlayedEntry


def shipped_scores(suite: Suite, folder: Path = DATA) -> dict[str, FloatArray]:
    """Return the RMSE of each built-in policy in each lift of a suite [mm], by its name.

    They come from the practice season. Policies that have changed since are left out; the result is
    empty if there is no practice season of this suite and its digest.

    Parameters
    ----------
    suite
        The suite.
    folder
        Folder of the practice seasons.
    """
    season = PlayedSeason.read(suite.name, folder)
    if season is None or season.suite_digest != suite.digest:
        return {}
    return dict(_current(season, suite))


def _current(season: PlayedSeason, suite: Suite) -> Iterator[tuple[str, FloatArray]]:
    names = own_playing_on(suite)
    for each in season.played:
        name = each.entry.name
        if name in names and each.entry.submission == builtin_entrant(name).digest:
            errors = _errors(each)
            if len(errors) == suite.size:
                yield name, errors


def _errors(played: PlayedEntry) -> FloatArray:
    table = csv.DictReader(io.StringIO(played.files[EPISODES].decode()))
    return np.array([float(row[LEADING]) for row in table])
