"""The command line with one more suite, ``tiny``: two lifts, so that an evaluation takes seconds.

As a program, ``tiny.py --fork`` starts one for every line of its input, at once: its own loading is
done by then. It answers with the process id.
"""

import dataclasses
import os
import signal
import sys
from importlib.metadata import EntryPoint

from colift.base.registry import SUITES, entries
from colift.benchmark.suites import suite
from colift.cli.main import main


def tiny() -> suite.Suite:
    quick = suite.make_suite("quick-v1")
    return dataclasses.replace(quick, name="tiny", scenarios=quick.scenarios[:1], seeds=(0, 1))


ENTRY = EntryPoint(name="tiny", value=f"{__name__}:tiny", group=SUITES)


def fork_each() -> None:
    import colift.cli.worker  # noqa: F401

    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    for line in sys.stdin:
        process = os.fork()
        if process == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            os.dup2(os.open(os.devnull, os.O_RDWR), 1)
            sys.argv[1:] = line.split()
            main()
            sys.exit()
        print(process, flush=True)


if __name__ == "__main__":
    entries(SUITES)["tiny"] = ENTRY
    if sys.argv[1:] == ["--fork"]:
        fork_each()
    else:
        main()
