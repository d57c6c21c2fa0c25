"""The comparison as one HTML file that needs nothing else."""

from collections.abc import Sequence
from html import escape
from importlib.metadata import version
from typing import Final

from ..rendering.page import cell, page, row, table
from ..rendering.palette import FAINT, HUMAN, INK, LINE, PAPER, ROBOT, SKY
from .comparison import Comparison
from .contest import Entry
from .picture import comparison_figure, svg
from .standing import Estimate, Scope, Standing
from .words import (
    AGAINST_CAPTION,
    HOW_TO_READ,
    PICTURE_CAPTION,
    RANKS_CAPTION,
    between,
    failures,
    p_value,
    parts_caption,
    probability,
    provenance,
    title,
    verdict,
)

COLOURS: Final = {
    INK: "--ink",
    FAINT: "--faint",
    LINE: "--line",
    PAPER: "--paper",
    SKY: "--sky",
    HUMAN: "--human",
    ROBOT: "--robot",
}
"""The page's name for each colour of a picture: it is another in the dark."""

RANKS: Final = ("policy", "rank", "RMSE mm", "vs_human", "SPARC", "human force N", "step ms")
AGAINST: Final = ("policy", "behind the best mm", "p", "better than the best", "better than humans")


def html_page(comparison: Comparison) -> str:
    """Return the page: picture, ranks, differences, tables by behaviour and by subject."""
    name = f"{title(comparison)}, compared"
    sentences = "".join(f"<li>{escape(sentence)}</li>" for sentence in HOW_TO_READ)
    failed = "".join(f"<p>{escape(sentence)}</p>" for sentence in failures(comparison))
    parts = "".join(
        f"<h2>By {kind}</h2>\n<p>{escape(parts_caption(kind))}</p>\n{_parts(comparison, scopes)}\n"
        for kind, scopes in (
            ("behaviour", comparison.behaviours),
            ("subject", comparison.subjects),
        )
    )
    body = f"""<h1>{escape(name)}</h1>
<p>{escape(verdict(comparison))}</p>
{failed}
{_picture(comparison)}
<h2>Ranks</h2>
<p>{escape(RANKS_CAPTION)}</p>
{_ranks(comparison)}
<h2>Against the best, and against people</h2>
<p>{escape(AGAINST_CAPTION)}</p>
{_against(comparison)}
{parts}
<h2>How to read it</h2>
<ul>{sentences}</ul>
<p class="faint">{escape(provenance(comparison, version("colift")))}</p>"""
    return page(name, body)


def _picture(comparison: Comparison) -> str:
    """Return the picture twice, for wide and for narrow pages; the page shows one of them."""
    sizes = (("wide", 8.4, 5.6), ("narrow", 4.0, 5.2))
    drawn = []
    for kind, width, height in sizes:
        text = svg(comparison_figure(comparison, width=width, height=height), kind)
        for colour, name in COLOURS.items():
            text = text.replace(colour.lower(), f"var({name})")
        label = f'<svg class="{kind}" role="img" aria-label="{escape(PICTURE_CAPTION)}"'
        drawn.append(text.replace("<svg", label, 1))
    caption = f"<figcaption>{escape(PICTURE_CAPTION)}</figcaption>"
    return f"<figure>{''.join(drawn)}{caption}</figure>"


def _ranks(comparison: Comparison) -> str:
    entries = {entry.name: entry for entry in comparison.contest.entries}
    rows = [_rank_row(s, entries[s.name]) for s in comparison.overall.standings]
    rows += [_reference_row(comparison, name) for name in comparison.contest.references]
    return table(RANKS, rows)


def _reference_row(comparison: Comparison, name: str) -> str:
    reference, overall = comparison.contest.references[name], comparison.overall
    rmse = overall.references_rmse_mm[name]
    cells = [
        cell(""),
        _estimate(rmse, ".2f"),
        cell(f"{rmse.mean / overall.team_rmse_mm.mean:.2g}"),
        cell("none" if reference.sparc is None else f"{reference.sparc:.2f}"),
        cell(f"{reference.human_force_n:.2f}"),
        cell(""),
    ]
    return row(name, cells, kind="reference")


def _rank_row(standing: Standing, entry: Entry) -> str:
    force, steps = standing.human_force_n, entry.step_ms
    return row(
        standing.name,
        [
            cell(str(standing.rank), best=standing.rank == 1),
            _estimate(standing.rmse_mm, ".2f"),
            _estimate(standing.vs_human, ".2f"),
            _smoothness(standing),
            cell("none" if force is None else f"{force:.2f}"),
            cell("none") if steps is None else cell(f"{steps[0]:.3f}", f"{steps[1]:.3f}"),
        ],
    )


def _smoothness(standing: Standing) -> str:
    if standing.sparc is None:
        return cell("none")
    if standing.sparc_missing:
        return cell(f"{standing.sparc.mean:.2f}", f"none in {standing.sparc_missing} lifts")
    return _estimate(standing.sparc, ".2f")


def _against(comparison: Comparison) -> str:
    rows = []
    for standing in comparison.overall.standings:
        behind, better = standing.to_best, cell(probability(standing.better_than_human))
        if behind is None:
            cells = [cell("best", best=True), cell(""), cell("")]
        else:
            cells = [
                cell(f"{behind.mean:+.2f}", between(behind.ci95, "+.2f")),
                cell(p_value(behind.p)),
                cell(f"{behind.share_better:.0%}"),
            ]
        rows.append(row(standing.name, [*cells, better]))
    return table(AGAINST, rows)


def _parts(comparison: Comparison, scopes: Sequence[Scope]) -> str:
    header = ("policy", *(scope.name for scope in scopes))
    columns = [{standing.name: standing for standing in scope.standings} for scope in scopes]
    rows = [
        row(standing.name, [_part(column[standing.name]) for column in columns])
        for standing in comparison.overall.standings
    ]
    for name in scopes[0].references_rmse_mm:
        errors = [_estimate(scope.references_rmse_mm[name], ".1f") for scope in scopes]
        rows.append(row(name, errors, kind="reference"))
    return table(header, rows)


def _part(standing: Standing) -> str:
    behind = standing.to_best
    under = "best"
    if behind is not None:
        interval = between(behind.ci95, "+.1f")
        under = f"{behind.mean:+.1f}" + (f" ({interval})" if interval else "")
    return cell(f"{standing.rmse_mm.mean:.1f}", under, best=standing.rank == 1)


def _estimate(estimate: Estimate, digits: str) -> str:
    return cell(f"{estimate.mean:{digits}}", between(estimate.ci95, digits))
