"""What a forger does to a bundle, and what a test asks of its verification."""

import csv
import hashlib
import io
import json

import numpy as np
from colift.benchmark.bundle import read_bundle, write_bundle
from colift.benchmark.bundle.arrays import dump_arrays, parse_arrays
from colift.benchmark.bundle.content import results, with_circumstances
from colift.benchmark.bundle.json_text import dump_json
from colift.benchmark.verification import verify

from ...four import FOUR

SUITE = FOUR.with_seeds(3, 5)

NEW, GONE = "clipped", "wobble_mm"
"""A metric that the other version did not have yet, and one that it had."""


def mend(folder):
    """Do as a clever forger does: put the files' true hashes into the manifest."""

    def change(manifest):
        for name in manifest["sha256"]:
            data = (folder / name).read_bytes()
            manifest["sha256"][name] = hashlib.sha256(data).hexdigest()

    edit_json(folder, "manifest.json", change)


def edit_json(folder, name, change):
    content = json.loads((folder / name).read_text())
    change(content)
    (folder / name).write_bytes(dump_json(content))


def edit_rows(folder, change):
    path = folder / "episodes.csv"
    rows = list(csv.DictReader(io.StringIO(path.read_bytes().decode(), newline="")))
    rows = change(rows) or rows
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    path.write_bytes(text.getvalue().encode())


def edit_arrays(folder, change):
    path = folder / "traces.npz"
    arrays = {name: a.copy() for name, a in parse_arrays(path.read_bytes(), "traces.npz").items()}
    change(arrays)
    path.write_bytes(dump_arrays(arrays))


def flip(array, index):
    """Change the last bit of one number."""
    array.view(np.uint64)[index] ^= 1


def rewrite(folder, run, platform=None):
    """Write a bundle of another run, with the step times that it had."""
    told = read_bundle(folder).results
    content = with_circumstances(results(run, {}), told, run.suite)
    write_bundle(folder, run, content.plain(), platform=platform)


def refused(folder, **place):
    """Assert that a bundle is refused for a place, and return what is wrong there."""
    verdict = verify(folder)
    assert not verdict.ok
    for finding in verdict.findings:
        if all(getattr(finding, name) == value for name, value in place.items()):
            return finding.message
    raise AssertionError([str(finding) for finding in verdict.findings])


def first_row(folder, place):
    """Return the row of the arrays with the first step of the episode at a place."""
    bundle = read_bundle(folder)
    return sum(len(episode.trace.action) for episode in bundle.episodes[:place])


def edit_table(folder, change):
    """Change the rows of episodes.csv, each a list of texts; the first is that of the names."""
    path = folder / "episodes.csv"
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    change(rows)
    with path.open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def with_other_metrics(scores):
    """Return a part of results.json as a colift with other metrics writes it."""
    others = {name: value for name, value in scores.items() if name != NEW}
    return {**others, GONE: {"mean": 3.5, "missing": 0}}


def outdate_metrics(folder, scoring):
    """Make a bundle that of a colift with other metrics: files, order of columns and numbers."""

    def change_results(content):
        content.update(scoring=scoring, suite_digest="0" * 16)
        content["summary"] = with_other_metrics(content["summary"])
        content["groups"] = [with_other_metrics(each) for each in content["groups"]]
        content["summary"]["sparc"]["mean"] = -7.0

    def change_rows(rows):
        place = rows[0].index(NEW)
        for number, row in enumerate(rows):
            del row[place]
            row.insert(4, "3.5" if number else GONE)

    edit_json(folder, "results.json", change_results)
    edit_table(folder, change_rows)
    mend(folder)
