"""Forgeries of a whole bundle, all hashes mended: each is refused, with its place."""

import csv
import io

import numpy as np
import pytest
from colift.benchmark.verification import verify

from .forging import SUITE, edit_arrays, edit_json, edit_rows, mend, refused

BY_FRAME = ("human_end", "robot_end", "human_velocity", "human_force", "robot_force", "target")
BY_STEP = ("action", "human_action", "state")


def swap_episodes(folder):
    """Exchange all that was recorded of the first two episodes, but for their names."""

    def arrays(all_):
        frames, steps = all_["frames"], all_["steps"]
        for names, counts in ((BY_FRAME, frames), (BY_STEP, steps)):
            one, two = counts[0], counts[0] + counts[1]
            for name in names:
                a = all_[name]
                all_[name] = np.concatenate((a[one:two], a[:one], a[two:]))
        for counts in (frames, steps):
            counts[[0, 1]] = counts[[1, 0]]

    def rows(table):
        names = [(row["behaviour"], row["subject"], row["seed"]) for row in table[:2]]
        table[0], table[1] = table[1], table[0]
        for row, name in zip(table, names, strict=False):
            row["behaviour"], row["subject"], row["seed"] = name

    edit_arrays(folder, arrays)
    edit_rows(folder, rows)


def repeat_the_last_episode(place):
    """Return what adds the last episode once more, as the one at a place."""

    def repeat(folder):
        def arrays(all_):
            frames, steps = all_["frames"][-1], all_["steps"][-1]
            for name in BY_FRAME:
                all_[name] = np.concatenate((all_[name], all_[name][-frames:]))
            for name in BY_STEP:
                all_[name] = np.concatenate((all_[name], all_[name][-steps:]))
            for name, last in (("frames", frames), ("steps", steps), ("places", place)):
                all_[name] = np.append(all_[name], last)

        edit_arrays(folder, arrays)
        edit_rows(folder, lambda rows: [*rows, rows[-1]])

    return repeat


def one_more_seed(folder):
    """Add an episode, and make a suite that has it."""
    repeat_the_last_episode(8)(folder)
    edit_json(folder, "manifest.json", lambda m: m["recipe"].update(seeds=[3, 4, 5]))


def score(name, value):
    """Return what writes a value into the table of episodes."""

    def change(folder):
        def rows(table):
            table[2][name] = value

        edit_rows(folder, rows)

    return change


def first_column(value):
    def change(folder):
        path = folder / "episodes.csv"
        rows = list(csv.reader(io.StringIO(path.read_text())))
        rows[3][0] = value
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(rows)
        path.write_text(text.getvalue())

    return change


def recipe(**changes):
    """Return what changes the recipe of the suite."""
    return lambda folder: edit_json(folder, "manifest.json", lambda m: m["recipe"].update(changes))


def first_scenario(name):
    """Return what makes the first scenario of the suite another."""
    return recipe(scenarios=[name, *(scenario.name for scenario in SUITE.scenarios[1:])])


def truncate_traces(folder):
    path = folder / "traces.npz"
    path.write_bytes(path.read_bytes()[:-100])


def cut_series(folder):
    edit_arrays(folder, lambda arrays: arrays.update(action=arrays["action"][:-1]))


PAUSE = "pause/S2 seed 3"

FORGERIES = {
    "swapped episodes": (swap_episodes, {"file": "traces.npz", "step": 0}, "human's action"),
    "an episode beyond the suite": (repeat_the_last_episode(8), {"file": "traces.npz"}, "place 8"),
    "an episode twice": (repeat_the_last_episode(7), {"file": "traces.npz"}, "increase"),
    "a seed more": (one_more_seed, {"file": "results.json"}, "other episodes"),
    "a score that is none": (score("sparc", "nan"), {"file": "episodes.csv, row 3"}, "finite"),
    "an infinite score": (score("rmse_mm", "-inf"), {"file": "episodes.csv, row 3"}, "finite"),
    "a score left out": (score("rmse_mm", ""), {"file": "episodes.csv, row 3"}, "is missing"),
    "smoothness left out": (score("sparc", ""), {"file": "episodes.csv", "episode": PAUSE}, "nan"),
    "a goal not reached": (score("reached", "False"), {"file": "episodes.csv, line 4"}, "writes"),
    "a formula": (first_column("=1+1"), {"file": "episodes.csv", "episode": PAUSE}, "=1+1"),
    "truncated traces": (truncate_traces, {"file": "traces.npz"}, "damaged"),
    "a series cut short": (cut_series, {"file": "traces.npz"}, "rows, must have"),
    "no seeds": (recipe(seeds=[]), {"file": "manifest.json"}, "1 to 100000 episodes"),
    "too many episodes": (recipe(seeds=[*range(30_000)]), {"file": "manifest.json"}, "1 to 100000"),
    "a huge seed": (recipe(seeds=[3, 2**128]), {"file": "manifest.json"}, "2^128"),
    "a seed of text": (recipe(seeds=[3, "4"]), {"file": "manifest.json"}, "whole number"),
    "the same lift in all places": (
        recipe(scenarios=["smooth/S1"] * 4),
        {"file": "manifest.json"},
        "the scenario 'smooth/S1' twice",
    ),
    "other people in all places": (
        recipe(scenarios=[f"smooth/S{person}" for person in (1, 2, 3, 4)]),
        {"file": "results.json"},
        "other episodes",
    ),
    "a class as behaviour": (
        first_scenario("os:system/S1"),
        {"file": "manifest.json"},
        "there is no behaviour 'os:system'",
    ),
    "a path as behaviour": (
        first_scenario("../../etc/passwd/S1"),
        {"file": "manifest.json"},
        "there is no behaviour",
    ),
    "a path as trial": (
        first_scenario("recorded/S1/../../etc/passwd"),
        {"file": "manifest.json"},
        "no trial '../../etc/passwd'",
    ),
    "no time between decisions": (recipe(control_period=0.0), {"file": "manifest.json"}, "control"),
    "a latency from the future": (recipe(latency=-1.0), {"file": "manifest.json"}, "latency"),
}


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forgery_is_refused_with_its_place(bundle, name):
    forge, place, told = FORGERIES[name]
    forge(bundle)
    mend(bundle)
    assert told in refused(bundle, **place)


@pytest.mark.parametrize(
    "name", ["../../../etc/passwd", "/etc/passwd", "traces.npz/x", "logs.json"]
)
def test_a_file_that_only_the_manifest_names_is_not_looked_for(bundle, name):
    edit_json(bundle, "manifest.json", lambda m: m["sha256"].update({name: "0" * 64}))
    message = refused(bundle, file="manifest.json")
    assert message == f"it has the SHA-256 of {name!r}, which is not there"


def test_a_file_that_the_manifest_does_not_name_is_refused(bundle):
    edit_json(bundle, "manifest.json", lambda m: m["sha256"].pop("traces.npz"))
    assert refused(bundle, file="traces.npz") == "manifest.json does not have its SHA-256"


def test_no_control_sequence_of_a_bundle_is_in_what_is_said_of_it(bundle):
    edit_json(bundle, "results.json", lambda r: r["summary"].update({"\x1b]0;mine\x07": "\x1b[2J"}))
    edit_json(bundle, "manifest.json", lambda m: m["sha256"].update({"\x1b[31m": ""}))
    lines = [str(finding) for finding in verify(bundle).findings]
    assert len(lines) == 3
    assert all(line.isprintable() for line in lines)


def test_a_thousand_mistakes_are_not_all_told(bundle):
    edit_json(
        bundle, "manifest.json", lambda m: m["sha256"].update({f"{i}": "" for i in range(999)})
    )
    assert len(verify(bundle).findings) <= 20
