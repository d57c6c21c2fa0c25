"""Systems other than Linux: a module in place of the one that needs the GNU C library."""

import importlib.util
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Final

REPLACED: Final = "colift.benchmark.world.bullet"


def replace_what_needs_linux() -> None:
    """Let ``bullet_elsewhere`` be imported in place of ``bullet``, unless this is Linux."""
    if sys.platform != "linux":
        sys.meta_path.insert(0, _Elsewhere())


class _Elsewhere(MetaPathFinder):
    """A finder of this one module, in another file."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != REPLACED or not path:
            return None
        return importlib.util.spec_from_file_location(name, Path(path[0], "bullet_elsewhere.py"))
