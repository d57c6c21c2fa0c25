"""The start of ``colift``: Ctrl-C says nothing while it loads, and while it ends.

It imports next to nothing.
"""

import signal

from colift.cli.loading import Loading


def start() -> None:
    """Load and run the command line."""
    with Loading():
        from colift.cli.main import main
    try:
        main()
    finally:
        # The result is out: what still ends has nothing to say.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
