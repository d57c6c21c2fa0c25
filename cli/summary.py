"""``colift summary``: results on several suites side by side, and no mean over suites."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.base.errors import InputError
from colift.benchmark.channels import channel_name
from colift.benchmark.comparison.formatting import between, digits
from colift.benchmark.comparison.stored import Stored, read_stored
from colift.benchmark.comparison.tables import policy_cell
from colift.benchmark.results.summary import plain_estimate
from colift.benchmark.tables.printing import Cell, left, show, table
from colift.cli.bundles import mention_others
from colift.cli.document import print_json
from colift.cli.options import AsJson

NONE: Final = "none"


def summarise_bundles(
    bundles: Annotated[
        list[Path],
        typer.Argument(metavar="BUNDLE...", help="Result bundles of 'colift run --out'."),
    ],
    as_json: AsJson = False,
) -> None:
    """Print the results of policies on several suites: on each, the error relative to two people.

    There is no mean over suites, since they measure different things.

    Example: colift summary bundle bundle-of-robust-v1
    """
    found: dict[tuple[str, str], Stored] = {}
    for folder in bundles:
        stored = read_stored(folder)
        mention_others(folder)
        place = stored.policy.name, _column(stored)
        if place in found:
            raise InputError(
                f"{folder} and {found[place].origin} are both of {place[0]} on {place[1]}"
            )
        found[place] = stored
    if as_json:
        print_json([_plain(stored) for stored in found.values()])
        return
    suites = list(dict.fromkeys(suite for _, suite in found))
    show(
        table(
            "RMSE divided by that of two people, on each suite",
            (left("policy"), *suites),
            _rows(found, suites),
            caption="With 95 % intervals. Below 1 is better than two people on the same lifts."
            " There is no mean over suites, since they measure different things.",
        )
    )


def _rows(found: Mapping[tuple[str, str], Stored], suites: Sequence[str]) -> list[tuple[Cell, ...]]:
    policies = dict.fromkeys(policy for policy, _ in found)
    return [
        (policy_cell(policy), *(_cell(found.get((policy, suite))) for suite in suites))
        for policy in policies
    ]


def _cell(stored: Stored | None) -> str:
    ratio = None if stored is None else stored.vs_human
    if ratio is None:
        return NONE
    width = between(ratio.ci95, digits(ratio.mean))
    return f"{ratio.mean:.2f}" + (f"\n{width}" if width else "")


def _column(stored: Stored) -> str:
    """Return the name of a suite, with the channel if there was one."""
    over = "" if stored.channel is None else f"\nover {channel_name(stored.channel)}"
    return stored.suite.name + over


def _plain(stored: Stored) -> dict[str, object]:
    ratio = stored.vs_human
    return {
        "policy": stored.policy.name,
        "suite": stored.suite.name,
        "suite_digest": stored.suite.digest,
        "channel": None if stored.channel is None else channel_name(stored.channel),
        "vs_human": None if ratio is None else plain_estimate(ratio),
    }
