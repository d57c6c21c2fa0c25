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
"""Characters of an error that are shown: a name that is given may be of any length."""

START: Final = """\
A benchmark for human-robot cooperative lifting.

  colift run blend                evaluate a policy on the standard suite
  colift list                     policies, behaviours, people, suites
  colift compare blend copy       set policies against each other, lift by lift
  colift new mine                 begin a policy of your own, in a folder
  colift check mine               does it work, and how good is it
  colift submit mine --board DIR  a verified row on a board
  colift serve                    a board in the browser

colift --help shows all commands, colift COMMAND --help one of them;
colift --install-completion completes commands, policies and suites."""
"""What ``colift`` alone says."""


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
    """Take the options that come before a command; without one, say how to begin."""
    if context.invoked_subcommand is None:
        print(START)


def main() -> None:
    """Run the command line; an error ends in one line on stderr.

    The exit code is 2 if a user gave something wrong, and 1 if the machine failed.
    """
    try:
        app(prog_name="colift")
    except InputError as error:
        _end(explained(error), 2)
    except EvaluatorFault as fault:
        _end(str(fault), 1)
    except BrokenPipeError:
        # The reader of a pipe has seen enough; Python would complain when it flushes stdout.
        sys.stderr.close()
        sys.exit(0)
    except OSError as error:
        if error.filename is None:
            raise
        _end(f"{error.filename}: {error.strerror}", 2)


def _end(told: str, code: int) -> NoReturn:
    """End with one line, of what a terminal can take."""
    line = " ".join(told.split())
    shown = line if len(line) <= LONGEST else f"{line[: LONGEST // 2]}...{line[-LONGEST // 2 :]}"
    print(f"error: {shown}", file=sys.stderr)
    sys.exit(code)
