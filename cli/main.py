"""The ``colift`` command: its streams, its signals and its exit code."""

import sys
from typing import NoReturn

from colift.cli.loading import Loading
from colift.cli.signals import interruptible
from colift.cli.streams import complete_streams


def main() -> NoReturn:
    """Run the command line, and exit; an error is one line on stderr.

    The exit code is 2 after wrong input, 1 after a failure, 130 after Ctrl-C, and 143 after
    SIGTERM.
    """
    complete_streams()
    with interruptible() as ending:
        try:
            with Loading():
                from colift.cli.program import execute
            code = execute()
        except KeyboardInterrupt:
            code = None
    sys.exit(ending.code if code is None else code)
