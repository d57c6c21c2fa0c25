"""``colift bench --scale``: what a cluster costs, and verification, against the local pool."""

import json
from typing import Final

from rich import box
from rich.console import Console
from rich.table import Table

from ..benchmark.scale import scale
from ..benchmark.suite import make_suite
from .progress import progress_bar

POLICY: Final = "blend"
SUITE: Final = "standard-v1"
ROUNDS: Final = 5

MEANING: Final = {
    "dask_ratio": "throughput of Dask on this machine over the local pool's (at least 0.9)",
    "verify_ratio": "throughput of verification over that of the run (at least 1)",
}


def print_scale(as_json: bool) -> None:
    """Print how fast a cluster and verification are, over a run in the local pool."""
    with progress_bar("bench", 3 * ROUNDS * make_suite(SUITE).size) as progress:
        figures = scale(POLICY, SUITE, ROUNDS, progress)
    if as_json:
        print(json.dumps(figures, indent=2))
        return
    table = Table(
        title="scale",
        caption=f"{POLICY} on {SUITE}, two worker processes each; median of {ROUNDS} rounds",
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
