"""``colift nao calibrate``: estimates of a laboratory's properties from trials."""

import dataclasses
import math
from pathlib import Path
from typing import Annotated

import typer
from colift.agents.hardware.trial_log import read_trial
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.scenario import LATENCY
from colift.benchmark.hardware.estimates import Estimates, estimate_setup
from colift.benchmark.tables.printing import show, table
from colift.benchmark.world.servo import SERVO
from colift.cli.document import print_json
from colift.cli.options import AsJson
from rich.table import Table


def calibrate_setup(
    recordings: Annotated[
        list[Path], typer.Argument(metavar="CSV...", help="Trials of 'nao run --record'.")
    ],
    as_json: AsJson = False,
) -> None:
    """Estimate latency, sag and noise from trials, as numbers for the simulated world.

    Example: colift nao calibrate trials/lift-01.csv trials/lift-02.csv
    """
    found = estimate_setup([read_trial(path) for path in recordings])
    if as_json:
        plain = {
            name: value if math.isfinite(value) else None
            for name, value in dataclasses.asdict(found).items()
        }
        print_json(plain)
        return
    show(_table(found))
    print(f"To simulate this laboratory: colift run POLICY --latency {found.latency:.2f}")


def _table(found: Estimates) -> Table:
    ms, mm = 1000.0, 1000.0
    return table(
        "",
        ("", "measured", "simulated"),
        (
            ("age of the newest frame", f"{ms * found.capture_age:.0f} ms", ""),
            ("latency", f"{ms * found.latency:.0f} ms", f"{ms * LATENCY:.0f} ms"),
            ("table end behind its commands", f"{ms * found.follow_delay:.0f} ms", ""),
            (
                "servo's time constant",
                f"{ms * found.servo_time:.0f} ms",
                f"{ms * SERVO.time:.0f} ms",
            ),
            (
                "servo's stiffness",
                f"{found.stiffness:.1f} Nm/rad",
                f"{SERVO.stiffness:.1f} Nm/rad",
            ),
            ("mean sag", f"{mm * found.sag:.1f} mm", ""),
            (
                "motion-capture noise",
                f"{mm * found.capture_noise:.2f} mm",
                f"{mm * MOCAP_NOISE:.2f} mm",
            ),
        ),
    )
