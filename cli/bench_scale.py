"""``colift bench --scale``: what a cluster costs, and verification, against the local pool."""

import json
from typing import Final

from rich import box
from rich.console import Console
from rich.table import Table

from ..benchmark.scale import scale
from ..benchmark.suite import make_suite
from .progress import progress_bar

SUITE: Final = "standard-v1"
ROUNDS: Final = 5

MEANING: Final = {
    "dask_ratio": "throughput of a Dask cluster of this machine (at least 0.9)",
    "verify_ratio": "throughput of verification (at least 1)",
}


def print_scale(as_json: bool) -> None:
    """Print throughputs over that of a run in the local pool, each with two worker processes."""
    with progress_bar("bench", 3 * ROUNDS * make_suite(SUITE).size) as progress:
        figures = scale(SUITE, ROUNDS, progress)
    if as_json:
        print(json.dumps(figures, indent=2))
        return
    table = Table(
        title="scale",
        caption=f"over a run of {SUITE} in the local pool; two worker processes each",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("figure")
    table.add_column("value", justify="right")
    table.add_column("meaning")
    for name, value in figures.items():
        table.add_row(name, f"{value:.3g}", MEANING[name])
    Console().print(table)
