"""Result bundles that commands read."""

import sys
from pathlib import Path
from typing import Final

from colift.benchmark.bundle import one_line
from colift.benchmark.bundle.files import other_files

MOST: Final = 3
"""Number of other files that are named."""


def mention_others(folder: Path) -> None:
    """Report on stderr the files in a bundle's folder that do not belong to the bundle.

    Raises
    ------
    InputError
        If there is no such folder.
    """
    others = other_files(folder)
    if others:
        named = ", ".join(one_line(each) for each in others[:MOST])
        more = f" and {len(others) - MOST} more" if len(others) > MOST else ""
        print(
            f"note: {folder} also contains {named}{more}: not part of the bundle, not checked",
            file=sys.stderr,
        )
