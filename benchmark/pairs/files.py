"""The measures of pairs as files: JSON, CSV and a picture."""

import csv
import io
import json
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

from colift.base.errors import InputError
from colift.benchmark.pairs.coordination import measure_of
from colift.benchmark.pairs.recorded import RecordedPairs
from colift.benchmark.pairs.summary import Averaged, PairsSummary
from colift.benchmark.rendering.layout import SUFFIXES

NAME: Final = "pairs"
"""Name of all files, without its suffix."""


def pairs_json(summary: PairsSummary) -> dict[str, Any]:
    """Return the content of ``pairs.json``.

    Of each measure, ``recorded`` and ``simulated`` have their intervals over lifts, ``over_pairs``
    has that of ``recorded`` over pairs, and ``difference`` is recorded minus simulated. ``lifts``
    has the measures of every lift, None where there is none.
    """
    simulated = summary.simulated
    return {
        "colift": version("colift"),
        "source": summary.source,
        "movements_digest": simulated.digest,
        "pairs": summary.people,
        "measures": {name: _averaged(name, each) for name, each in summary.averages.items()},
        "lifts": [
            {
                "trial": trial,
                "pair": summary.pairs[trial],
                "recorded": each.plain(),
                "simulated": simulated.lifts[trial].plain() if trial in simulated.lifts else None,
            }
            for trial, each in summary.lifts.items()
        ],
        "not_simulated": dict(simulated.left_out),
        "without_far_end": list(summary.without),
    }


def _averaged(name: str, each: Averaged) -> dict[str, Any]:
    return {"unit": measure_of(name).unit, **asdict(each)}


def pairs_csv(summary: PairsSummary) -> str:
    """Return the content of ``pairs.csv``: a row per lift, empty fields where there is no value."""
    text = io.StringIO()
    names = list(summary.averages)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("trial", "pair", *names, *(f"simulated_{name}" for name in names)))
    for trial, recorded in summary.lifts.items():
        simulated = summary.simulated.lifts.get(trial)
        beside = {} if simulated is None else simulated.plain()
        values = [*map(recorded.plain().get, names), *map(beside.get, names)]
        writer.writerow((trial, summary.pairs[trial], *values))
    return text.getvalue()


def check_pairs_folder(folder: Path) -> None:
    """Refuse a folder with a file that :func:`write_pairs` would replace.

    Raises
    ------
    InputError
        If there is one: the recordings themselves may be called ``pairs.csv``.
    """
    for suffix in (".json", ".csv", *SUFFIXES):
        path = folder / f"{NAME}{suffix}"
        if path.exists():
            raise InputError(f"{path} exists; name a new folder")


def write_pairs(folder: Path, pairs: RecordedPairs, summary: PairsSummary) -> None:
    """Write ``pairs.json``, ``pairs.csv``, and the picture as PNG, SVG and PDF into a folder.

    Raises
    ------
    OSError
        If it cannot be written to.
    """
    # matplotlib is slow to load.
    from colift.benchmark.pairs.picture import pairs_figure
    from colift.benchmark.rendering.figures import drawn_for, write_all
    from colift.benchmark.rendering.layout import PAGE

    folder.mkdir(parents=True, exist_ok=True)
    content = json.dumps(pairs_json(summary), indent=2, allow_nan=False) + "\n"
    (folder / f"{NAME}.json").write_text(content, encoding="utf-8")
    (folder / f"{NAME}.csv").write_text(pairs_csv(summary), encoding="utf-8")
    with drawn_for(PAGE):
        figure = pairs_figure(pairs, summary)
    write_all(folder, NAME, figure, f"Recorded pairs of {summary.source}, and simulated ones")
