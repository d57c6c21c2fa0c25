"""The program: its options, its commands, and its errors."""

import sys
from typing import Annotated, Any, Final

import typer
from colift.base.engine import ENGINE, NO_ENGINE
from colift.base.errors import EvaluatorFault, InputError
from colift.cli.commands import Commands
from colift.cli.document import begin, print_json_error
from colift.cli.loading import INTERRUPTED
from colift.cli.remedies import explained
from colift.cli.streams import give_up_stdout

app = typer.Typer(
    name="colift",
    cls=Commands,
    help="A benchmark for human-robot cooperative lifting.",
    invoke_without_command=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)

LONGEST: Final = 2000
"""Longest error that is shown in full; names in it may have any length."""

UsageError: Final[Any] = typer.BadParameter.__base__
"""An error in the options of a command. Typer has its class under different names."""

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
        from importlib.metadata import version  # Slow to import, as seen from a completion.

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


def execute() -> int | None:
    """Run the command of this process's arguments, and return its exit code; None after Ctrl-C.

    An error is one line on stderr.
    """
    begin()
    try:
        # Typer's own way to end would print usage errors in a box, and hide an interrupt.
        code: Any = app(prog_name="colift", standalone_mode=False)
        sys.stdout.flush()
    except InputError as error:
        return _failed(explained(error), 2)
    except ModuleNotFoundError as error:
        if error.name != ENGINE:
            raise
        return _failed(NO_ENGINE, 2)
    except EvaluatorFault as fault:
        return _failed(str(fault), 1)
    except typer.Abort:  # Some versions of Typer turn Ctrl-C into this.
        return None
    except UsageError as error:
        return _failed(_usage(error), 2)
    except BrokenPipeError:
        give_up_stdout()
        return 0
    except SystemExit as end:
        # Rich and Typer end the process by themselves if nobody reads on.
        if not isinstance(end.__context__, BrokenPipeError):
            raise
        give_up_stdout()
        return 0
    except OSError as error:
        if error.filename is None:
            give_up_stdout()  # It may be the file that is full.
            return _failed(str(error), 1)
        return _failed(f"{error.filename}: {error.strerror}", 2)
    return None if code == INTERRUPTED else code or 0


def _failed(message: str, code: int) -> int:
    """Print an error as one line of limited length, and return the exit code.

    With --json it is also an object on stdout, where a program awaits one.
    """
    line = " ".join(message.split())
    shown = line if len(line) <= LONGEST else f"{line[: LONGEST // 2]}...{line[-LONGEST // 2 :]}"
    if "--json" in sys.argv:
        print_json_error(shown)
    print(f"error: {shown}", file=sys.stderr)
    return code


def _usage(error: Any) -> str:
    """Return an error in options, and the command that shows those that there are."""
    if type(error).__name__ == "NoArgsIsHelpError":
        return f"a command is missing; '{error.ctx.command_path} --help' lists them"
    message = str(error.format_message()).rstrip(".")
    message = message[:1].lower() + message[1:]
    if error.ctx is None:
        return message
    return f"{message} ('{error.ctx.command_path} --help' explains the usage)"
