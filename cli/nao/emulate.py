"""``colift nao emulate``: an emulated NAO with a motion-capture system."""

import signal
import sys
import time
from typing import Annotated

import typer
from colift.agents.hardware.nao.session import leave
from colift.agents.hardware.operator import StopButton, armed
from colift.benchmark.hardware.emulator import Emulator
from colift.benchmark.hardware.faults import KINDS, parse_fault
from colift.benchmark.hardware.laboratory import CAPTURE_LATENCY, Conditions
from colift.benchmark.suites.catalogue import make_scenario
from colift.cli.completion import behaviours, people
from colift.cli.nao.connections import URL


def emulate(
    human: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="The human's behaviour, from 'colift list'.",
            autocompletion=behaviours,
        ),
    ] = "smooth",
    subject: Annotated[
        str,
        typer.Option(
            metavar="NAME", help="The human's body: S1 to S5, or draw-N.", autocompletion=people
        ),
    ] = "S1",
    url: Annotated[str, typer.Option(metavar="URL", help="Address of the emulated NAOqi.")] = URL,
    stream: Annotated[
        str, typer.Option(metavar="NAME", help="Name of the motion-capture stream.")
    ] = "colift",
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the first lift.", min=0)] = 0,
    capture_latency: Annotated[
        float,
        typer.Option(
            metavar="S", help="Age of a frame when it is sent, in seconds.", min=0.0, max=1.0
        ),
    ] = CAPTURE_LATENCY,
    fault: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KIND@START[:DURATION[:VALUE]]",
            help="A fault, START seconds after the beginning of the first lift; repeatable. "
            f"KIND: {', '.join(KINDS)}.",
        ),
    ] = None,
) -> None:
    """Emulate a laboratory over libqi and Lab Streaming Layer, until Ctrl-C.

    The person begins a lift whenever the robot says "Go".

    Example: colift nao emulate --human pause --subject S3
    """
    conditions = Conditions(
        scenario=make_scenario(human, subject),
        seed=seed,
        capture_latency=capture_latency,
        faults=tuple(map(parse_fault, fault or ())),
    )
    begin = time.monotonic()

    def log(line: str) -> None:
        # One write per line: the services run in threads of their own.
        sys.stdout.write(f"{time.monotonic() - begin:9.3f} {line}\n")
        sys.stdout.flush()

    emulator = Emulator(conditions, url=url, stream=stream, log=log)
    button = StopButton()
    log(f"ready: robot {url}, stream {stream}")
    try:
        with armed(button, (signal.SIGINT, signal.SIGTERM)):
            emulator.run(button)
    finally:
        emulator.close()
    leave(0)
