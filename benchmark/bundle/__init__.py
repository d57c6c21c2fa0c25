"""The result bundle: a folder with a policy's scores, and everything from which they follow.

================== ===============================================================================
file               content
================== ===============================================================================
``results.json``   the summary; see :func:`.results`
``episodes.csv``   one row per episode: human, seed, scores, reason of a failure
``traces.npz``     both agents' actions, a hash of each step's state, the heights and forces
``manifest.json``  the recipe of the suite, the platform, the SHA-256 of every other file
``recordings.csv`` the recordings, if recorded lifts were played
``logs.json``      the output of failed policies, if any
================== ===============================================================================
"""

from colift.benchmark.bundle.content import Results, results
from colift.benchmark.bundle.differences import Difference, differences
from colift.benchmark.bundle.files import (
    FILES,
    check_bundle_folder,
    check_unfinished,
    is_bundle,
    read_files,
)
from colift.benchmark.bundle.reading import Bundle, parse, read_bundle
from colift.benchmark.bundle.recipe import Recipe
from colift.benchmark.bundle.table import one_line
from colift.benchmark.bundle.writing import write_bundle
from colift.benchmark.execution.provenance import fingerprint

__all__ = [
    "FILES",
    "Bundle",
    "Difference",
    "Recipe",
    "Results",
    "check_bundle_folder",
    "check_unfinished",
    "differences",
    "fingerprint",
    "is_bundle",
    "one_line",
    "parse",
    "read_bundle",
    "read_files",
    "results",
    "write_bundle",
]
