"""The ``colift`` command."""

import sys
from importlib.metadata import version
from typing import Annotated, Final, NoReturn

import typer

from ..agents.errors import EvaluatorFault, InputError
from .commands import Commands
from .remedies import explained

app = typer.Typer(
    name="colift",
    cls=Commands,
    help="A benchmark for human-robot cooperative lifting.",
    invoke_without_command=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

LONGEST: Final = 2000
"""Longest error that is shown in full; names in it may have any length."""

START: Final = """\
A benchmark for human-robot cooperative lifting.

  colift run blend                evaluate a policy on the standard suite
  colift list                     policies, behaviours, subjects, suites
  colift compare blend copy       compare policies, lift by lift
  colift play                     lift with a policy yourself, in the browser
  colift new mine                 start a policy of your own in a folder
  colift check mine               check that it works, and score it
  colift submit mine --board DIR  get a verified row on a board
  colift serve                    show a board in the browser

colift --help shows all commands, colift COMMAND --help one of them;
colift --install-completion completes commands, policies and suites."""
"""The text of ``colift`` without a command."""


def _show_version(asked: bool) -> None:
    if asked:
        print(f"colift {version('colift')}")
        raise typer.Exit


@app.callback()
def colift(
    context: typer.Context,
    _: Annotated[
        bool,
        typer.Option(
            "--version", help="Show the version and exit.", is_eager=True, callback=_show_version
        ),
    ] = False,
) -> None:
    """Handle the options before a command; without a command, print how to start."""
    if context.invoked_subcommand is None:
        print(START)


def main() -> None:
    """Run the command line; an error is one line on stderr.

    The exit code is 2 after wrong input, and 1 after a failure of the machine.
    """
    try:
        app(prog_name="colift")
    except InputError as error:
        _end(explained(error), 2)
    except EvaluatorFault as fault:
        _end(str(fault), 1)
    except BrokenPipeError:
        # The pipe is closed: without this, flushing stdout fails again at exit.
        sys.stderr.close()
        sys.exit(0)
    except OSError as error:
        if error.filename is None:
            raise
        _end(f"{error.filename}: {error.strerror}", 2)


def _end(message: str, code: int) -> NoReturn:
    """Print an error as one line of limited length, and exit."""
    line = " ".join(message.split())
    shown = line if len(line) <= LONGEST else f"{line[: LONGEST // 2]}...{line[-LONGEST // 2 :]}"
    print(f"error: {shown}", file=sys.stderr)
    sys.exit(code)
