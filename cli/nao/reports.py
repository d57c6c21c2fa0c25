"""Hardware reports as a person reads them in a terminal."""

from typing import Any, Final

from rich import box
from rich.table import Table

_ROWS: Final = {
    "sensing_age_ms": "age of the newest frame",
    "state_ms": "reading the robot",
    "policy_ms": "policy",
    "command_ms": "command",
    "period_error_ms": "error of the period",
}


def timing_table(report: dict[str, Any]) -> Table:
    """Return the table of a latency report; see :func:`.timing_report`."""
    held = ", ".join(f"{count} x {reason}" for reason, count in report["held"].items())
    table = Table(
        title="Times in ms",
        caption=f"{report['steps']} steps; {report['late_steps']} periods skipped; "
        f"held: {held or 'never'}",
        title_justify="left",
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    table.add_column("")
    for title in ("median", "p99", "largest"):
        table.add_column(title, justify="right")
    for name, title in _ROWS.items():
        values = (report[name][key] for key in ("p50", "p99", "max"))
        table.add_row(title, *("none" if v is None else f"{v:.2f}" for v in values))
    return table
