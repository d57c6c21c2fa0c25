"""``colift play``: real people lift with policies, and with each other, in a browser."""

import ipaddress
import os
import sys
import webbrowser
from pathlib import Path
from typing import Annotated, Final

import typer
from colift.agents.spec import AUTO
from colift.base.errors import InputError
from colift.base.extras import how_to_install
from colift.benchmark.robots.robot import DEFAULT_ROBOT, make_robot
from colift.cli.completion import policies
from colift.cli.listening import LOOPBACK, Host, Port, listening_at, url_of
from colift.cli.options import PolicyIsolation, RobotName, check_folder
from colift.cli.partners import FIRST, partners
from colift.cli.signals import until_signalled
from colift.leaderboard.logs import write_log

PORT: Final = 8100
"""The default port: not a board's, which may run beside it."""

SECURE: Final = (
    "Other machines reach this page without HTTPS: their browsers then give only 60 samples a "
    "second, and no raw mouse movement. A reverse proxy with TLS removes both limits."
)
"""Printed if the page is served to other machines."""

HOSTS: Final = frozenset({"localhost", "127.0.0.1", "::1"})
"""Names by which only this machine reaches itself."""


def play(
    policy: Annotated[
        str,
        typer.Argument(
            metavar="POLICY",
            help="The first partner: a name from 'colift list', module:Class, file.py:Class or a "
            "submission's folder. All registered policies can be chosen on the page.",
            autocompletion=policies,
        ),
    ] = FIRST,
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder for the lifts, with a folder per session.")
    ] = Path("live"),
    host: Host = LOOPBACK,
    port: Port = PORT,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address without opening a browser.")
    ] = False,
    rooms: Annotated[
        int, typer.Option(metavar="N", min=1, max=64, help="Largest number of sessions at a time.")
    ] = 8,
    robot: RobotName = None,
    isolation: PolicyIsolation = AUTO,
    root: Annotated[
        str,
        typer.Option(metavar="/PATH", help="Path of the page behind a reverse proxy."),
    ] = "",
) -> None:
    """Lift a table with a policy, or with another person, in the browser.

    Your hand moves one end of a simulated table; a policy or a second person holds the other.

    'colift verify' verifies the saved lifts, 'colift run POLICY --recordings' plays them again.

    Example: colift play blend
    """
    try:
        from colift.play.web.keeper import PlayConfig
        from colift.play.web.processes import keep_serving
    except ModuleNotFoundError as error:
        raise InputError(
            f"{error.name} is not installed; lifting in a browser needs: {how_to_install('board')}"
        ) from error
    check_folder("--out", out)
    make_robot(robot or DEFAULT_ROBOT)
    named, lines = partners(policy, isolation)
    config = PlayConfig(
        folder=out.absolute(),
        policies=named,
        robot=robot or DEFAULT_ROBOT,
        descriptions=lines,
        rooms=rooms,
        hosts=frozenset() if root or not _is_loopback(host) else HOSTS,
    )
    write_log()
    with until_signalled(), listening_at(host, port) as listener:
        address = url_of(listener)
        if not _is_loopback(listener.getsockname()[0]):
            print(SECURE, file=sys.stderr, flush=True)
        print(f"Lift with {next(iter(named))} at {address} (Ctrl-C ends it)", flush=True)
        print(f"Each lift is saved in {out}", flush=True)
        if not no_browser and _has_display():
            webbrowser.open(address.replace("//0.0.0.0:", "//127.0.0.1:"))
        keep_serving(config, listener, root.rstrip("/"))


def _is_loopback(address: str) -> bool:
    if address == "localhost":
        return True
    try:
        return ipaddress.ip_address(address.partition("%")[0]).is_loopback
    except ValueError:
        return False  # Another name.


def _has_display() -> bool:
    """Return whether there is a browser with a window; others would take the terminal."""
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"))
