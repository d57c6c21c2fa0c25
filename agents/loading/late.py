"""Late imports of colift's own modules, made at once where there will be no imports any more.

The library of filters takes more than a second to import. What uses it imports it with the first
filter, so that listing policies stays fast.
"""

import importlib
import sys
from typing import Final

LATE: Final = {
    "colift.agents.estimators.minimum_jerk_filter": "filterpy.kalman",
    "colift.agents.estimators.motion_filter": "filterpy.kalman",
}
"""Modules, and what they import when they are used."""


def import_late() -> None:
    """Import what the loaded modules of :data:`LATE` will need."""
    for module, needed in LATE.items():
        if module in sys.modules:
            importlib.import_module(needed)
