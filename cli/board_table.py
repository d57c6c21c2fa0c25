"""A season's table as a person reads it in a terminal."""

from collections.abc import Iterator, Sequence

from rich import box
from rich.console import JustifyMethod
from rich.table import Table
from rich.text import Text

from ..benchmark.comparison.standing import Estimate
from ..leaderboard.row import Row
from ..leaderboard.season import SeasonInfo
from ..leaderboard.standing import HumanTeam, Standing

NARROW = 100
"""Below so many columns the table leaves out what is least asked for."""


def board_table(
    season: SeasonInfo, standings: Sequence[Standing], team: HumanTeam | None, width: int
) -> Table:
    """Return a season's table: who cannot be told from each other shares a rank.

    The human-human team stands where it would come by its mean.

    Parameters
    ----------
    season, standings, team
        What the board says of them.
    width
        Columns of the terminal.
    """
    wide = width >= NARROW
    titles = ["rank", "policy", "RMSE mm", "95 % interval", "vs human", "SPARC"]
    titles += ["force N", "ms/step", "gap mm"] if wide else []
    titles += ["verified"]
    lines = list(_lines(standings, team, wide))
    table = Table(
        title=Text(f"Season {season.name} on {season.suite}"),
        caption=Text(_caption(wide)),
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    for place, title in enumerate(titles):
        if title == "policy":
            most = _room(titles, [cells for cells, _ in lines], place, width)
            table.add_column(title, overflow="ellipsis", no_wrap=True, max_width=most)
        else:
            justify: JustifyMethod = "left" if title == "verified" else "right"
            table.add_column(title, justify=justify, no_wrap=True)
    for cells, style in lines:
        table.add_row(*cells, style=style)
    return table


def _room(
    titles: Sequence[str], lines: Sequence[Sequence[str | Text]], place: int, width: int
) -> int:
    """Return how many columns of the terminal are left for one column of the table."""
    widths = [max(map(len, cells)) for cells in zip(titles, *lines, strict=True)]
    between = 2 * len(titles) + 1
    return max(width - between - sum(widths) + widths[place], len(titles[place]))


def _lines(
    standings: Sequence[Standing], team: HumanTeam | None, wide: bool
) -> Iterator[tuple[list[str | Text], str | None]]:
    """Yield the cells of each line, and its style."""
    waiting = team
    for each in standings:
        if waiting is not None and (
            not each.ranked or each.row.hidden.rmse_mm.mean > waiting.rmse_mm.mean
        ):
            yield _team(waiting, wide), "bold"
            waiting = None
        yield _cells(each, wide), None if each.ranked else "dim"
    if waiting is not None:
        yield _team(waiting, wide), "bold"


def _cells(each: Standing, wide: bool) -> list[str | Text]:
    row, hidden, public = each.row, each.row.hidden, each.row.public
    cells: list[str | Text] = [
        str(each.group) if each.ranked else "out",
        Text(row.name),
        f"{hidden.rmse_mm.mean:.2f}",
        _interval(hidden.rmse_mm),
        f"{hidden.vs_human.mean:.2f}",
        _number(public.sparc, ".2f"),
    ]
    if wide:
        cells += [
            _number(public.human_force_n, ".2f"),
            _step(row),
            f"{row.gap_mm.mean:+.2f}",
        ]
    return [*cells, "yes" if row.verified else "no"]


def _team(team: HumanTeam, wide: bool) -> list[str | Text]:
    cells: list[str | Text] = [
        "",
        "human-human team",
        f"{team.rmse_mm.mean:.2f}",
        _interval(team.rmse_mm),
        "1.00",
        _number(team.sparc, ".2f"),
    ]
    return [*cells, *([f"{team.human_force_n:.2f}", "", ""] if wide else []), ""]


def _caption(wide: bool) -> str:
    told = "Who shares a rank cannot be told apart. RMSE: hidden lifts. vs human: 1 is a human team"
    if not wide:
        return f"{told}. SPARC: public lifts."
    return (
        f"{told}, less is better. SPARC (smoothness), force at the human's hands and "
        "time per step: public lifts. Gap: hidden minus public RMSE."
    )


def _interval(estimate: Estimate) -> str:
    low, high = estimate.ci95
    return f"{low:.2f} to {high:.2f}"


def _step(row: Row) -> str:
    told = _number(row.public.step_ms_p50, ".3f")
    return told if row.public.real_time else f"{told}, slow"


def _number(value: float | None, digits: str) -> str:
    return "none" if value is None else format(value, digits)
