"""The ``colift`` command."""

import sys

import typer

from ..agents.errors import InputError
from . import (
    bench,
    calibrate,
    check,
    compare,
    demonstrate,
    learn,
    listing,
    new,
    paper,
    references,
    render,
    run,
    submit,
    verify,
)

app = typer.Typer(
    name="colift",
    help="A benchmark for human-robot cooperative lifting.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(run.run)
app.command("list")(listing.list_all)
app.command()(new.new)
app.command()(check.check)
app.command()(submit.submit)
app.command()(verify.verify)
app.command()(compare.compare)
app.command()(paper.paper)
app.command()(render.render)
app.command()(demonstrate.demonstrate)
app.add_typer(learn.app, name="learn")
app.command()(calibrate.calibrate)
app.command()(references.references)
app.command()(bench.bench)


def main() -> None:
    """Run the command line; what a user gave wrong ends in one line on stderr and exit code 2."""
    try:
        app()
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:
        # The reader of a pipe has seen enough; Python would complain when it flushes stdout.
        sys.stderr.close()
        sys.exit(0)
