"""The ``colift`` command."""

import sys

import typer

from ..agents.errors import EvaluatorFault, InputError
from .commands import Commands

app = typer.Typer(
    name="colift",
    cls=Commands,
    help="A benchmark for human-robot cooperative lifting.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def colift() -> None:
    """Do nothing before a command; there is one so that Typer makes a group without any."""


def main() -> None:
    """Run the command line; an error ends in one line on stderr.

    The exit code is 2 if a user gave something wrong, and 1 if the machine failed.
    """
    try:
        app(prog_name="colift")
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except EvaluatorFault as fault:
        print(f"error: {fault}", file=sys.stderr)
        sys.exit(1)
    except BrokenPipeError:
        # The reader of a pipe has seen enough; Python would complain when it flushes stdout.
        sys.stderr.close()
        sys.exit(0)
