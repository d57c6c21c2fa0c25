"""``colift channels``: the price of a network between the robot and its policy."""

import dataclasses
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.agents.submissions.choice import checked_policy
from colift.benchmark.channels import CHANNELS
from colift.benchmark.comparison.formatting import between
from colift.benchmark.comparison.over_channels import OverChannel, over_channels
from colift.benchmark.comparison.tables import policy_cell
from colift.benchmark.execution.fitting import check_fits
from colift.benchmark.execution.progress import workers
from colift.benchmark.rendering.layout import PAGE
from colift.benchmark.tables.printing import Cell, show, table
from colift.cli.completion import channels as channel_names
from colift.cli.completion import policies as named
from colift.cli.document import print_json
from colift.cli.interrupts import reported_interrupt
from colift.cli.options import (
    AsJson,
    AsTheyWere,
    Behaviours,
    Jobs,
    LayoutName,
    Recordings,
    Seeds,
    SuiteName,
    check_figure,
    chosen_channel,
    chosen_layout,
    chosen_suite,
)
from colift.cli.tables.recordings import recordings_json, show_recordings
from rich.table import Column, Table

MEASURED: Final = ("copy", "extrapolate", "blend", "minimum_jerk", "anticipate", "learned")
"""The policies that are measured by default: from no prediction to the best."""


def measure_channels(
    policies: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="POLICY",
            help=f"Policies as for 'colift run'; default: {', '.join(MEASURED)}.",
            autocompletion=named,
        ),
    ] = None,
    channels: Annotated[
        list[str] | None,
        typer.Option(
            "--channel",
            metavar="NAME|FILE",
            help=f"Channel, or a .toml file; repeatable. Default: {', '.join(CHANNELS)}.",
            autocompletion=channel_names,
        ),
    ] = None,
    suite: SuiteName = None,
    behaviour: Behaviours = None,
    seeds: Seeds = None,
    recordings: Recordings = None,
    as_recorded: AsTheyWere = False,
    jobs: Jobs = None,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Figure (.png, .svg, .pdf).")
    ] = None,
    layout: LayoutName = PAGE.name,
    as_json: AsJson = False,
) -> None:
    """Measure policies with and without a network that delays and loses messages.

    Example: colift channels blend anticipate --channel satellite
    """
    episodes = chosen_suite(suite, seeds, recordings, behaviour, as_recorded=as_recorded)
    chosen = {text: chosen_channel(text) for text in channels or CHANNELS}
    networks = {text: channel for text, channel in chosen.items() if channel is not None}
    specs = {text: checked_policy(text) for text in policies or MEASURED}
    for spec in specs.values():
        check_fits(spec, episodes.scenarios[0], episodes.seeds[0])
    check_figure(out)
    size = chosen_layout(layout)
    total = len(specs) * (1 + len(networks)) * episodes.size
    with (
        reported_interrupt("policies are measured on all lifts or not at all"),
        workers("channels", total, jobs) as (pool, progress),
    ):
        show_recordings(episodes, as_json)
        found = list(over_channels(specs, networks, episodes, executor=pool, progress=progress))
    if out is not None:
        # matplotlib is slow to load.
        from colift.benchmark.comparison.channels_figure import channels_figure
        from colift.benchmark.rendering.figures import drawn_for, write_figure

        with drawn_for(size):
            figure = channels_figure(found, size)
        write_figure(out, figure, f"The price of a channel on {episodes.name}")
    if as_json:
        content = {
            "suite": episodes.name,
            "suite_digest": episodes.digest,
            **recordings_json(episodes),
            "channels": {text: channel.plain() for text, channel in networks.items()},
            "policies": [dataclasses.asdict(each) for each in found],
        }
        print_json(content)
        return
    show(
        _errors_table(found, f"RMSE mm on {episodes.name}"),
        _prices_table(found, [*networks]),
        "\n".join(f"{text}: {channel}" for text, channel in networks.items()),
    )
    failed = [each for each in found if each.failed]
    for each in failed:
        where = f"{each.policy} over {each.channel or 'no channel'}"
        print(f"{where}: {each.failed} of {episodes.size} lifts failed", file=sys.stderr)
    if failed:
        raise typer.Exit(1)


def _errors_table(found: Sequence[OverChannel], title: str) -> Table:
    columns = dict.fromkeys(each.channel for each in found)
    return table(
        title,
        ("policy", *(name or "no channel" for name in columns)),
        (
            (policy_cell(policy), *(f"{each.rmse_mm.mean:.2f}" for each in row))
            for policy, row in _rows(found).items()
        ),
    )


def _prices_table(found: Sequence[OverChannel], columns: Sequence[str]) -> Table:
    rows: list[list[Cell]] = [
        [policy_cell(policy), *(_price(each) for each in row if each.channel is not None)]
        for policy, row in _rows(found).items()
    ]
    return table(
        "More than without a channel, mm",
        (Column("policy", no_wrap=True), *columns),
        rows,
        caption="In brackets the 95 % interval of the paired difference.",
    )


def _price(each: OverChannel) -> str:
    interval = between(each.price_mm.ci95, ".1f")
    return f"{each.price_mm.mean:+.1f}" + (f" ({interval})" if interval else "")


def _rows(found: Sequence[OverChannel]) -> dict[str, list[OverChannel]]:
    """Return the errors of each policy, in the order of the channels."""
    rows: dict[str, list[OverChannel]] = {}
    for each in found:
        rows.setdefault(each.policy, []).append(each)
    return rows
