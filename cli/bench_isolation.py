"""``colift bench --isolation``: what each way to isolate a policy costs."""

import dataclasses
import json

from rich import box
from rich.console import Console
from rich.table import Table

from ..benchmark.isolation_speed import (
    EPISODE_MS,
    ROUNDS,
    STEP_US,
    IsolationCost,
    isolated,
    isolation_cost,
)
from .progress import progress_bar


def print_isolation(as_json: bool) -> None:
    """Print what each way that works here costs, over the same policy in this process."""
    found: dict[str, IsolationCost] = {}
    with isolated() as (plain, ways), progress_bar("bench", ROUNDS * len(ways)) as progress:
        for name, policy in ways.items():
            found[name] = isolation_cost(plain, policy, progress=progress)
    if as_json:
        content = {
            "aim": {"step_us": STEP_US, "episode_ms": EPISODE_MS},
            "isolation": {
                name: {**dataclasses.asdict(cost), "within_aim": cost.within_aim}
                for name, cost in found.items()
            },
        }
        print(json.dumps(content, indent=2))
        return
    table = Table(
        title="cost of isolation",
        caption=f"over in-process; aim: {STEP_US:g} us a step, {EPISODE_MS:g} ms an episode",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("isolation")
    for heading in ("us a step", "ms an episode", "aim"):
        table.add_column(heading, justify="right", no_wrap=True)
    for name, cost in found.items():
        reached = "reached" if cost.within_aim else "missed"
        table.add_row(name, f"{cost.step_us:.0f}", f"{cost.episode_ms:.1f}", reached)
    Console().print(table)
