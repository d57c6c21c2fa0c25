"""Landlock, by which a process gives up rights to files, TCP and signals.

See https://docs.kernel.org/userspace-api/landlock.html for the calls and their versions (ABI).
"""

import ctypes
import os
import struct
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from colift.agents.sandbox.guest.linux import syscall

_CREATE, _ADD_RULE, _RESTRICT = 444, 445, 446
_VERSION_FLAG: Final = 1
_PATH_BENEATH: Final = 1

EXECUTE: Final = 1
WRITE_FILE: Final = 2
READ_FILE: Final = 4
READ_DIR: Final = 8
TRUNCATE: Final = 1 << 14
IOCTL: Final = 1 << 15
READ: Final = EXECUTE | READ_FILE | READ_DIR
ALL: Final = (1 << 16) - 1
_OF_FILES: Final = EXECUTE | WRITE_FILE | READ_FILE | TRUNCATE | IOCTL

_FILES_BY_ABI: Final = {1: (1 << 13) - 1, 2: (1 << 14) - 1, 3: (1 << 15) - 1, 4: (1 << 15) - 1}
_NETWORK, _SCOPES = 3, 3


def version() -> int:
    """Return the ABI of the running kernel, 0 if it has no Landlock."""
    try:
        return syscall(_CREATE, 0, 0, _VERSION_FLAG, what="landlock")
    except OSError:
        return 0


def restrict(rules: Iterable[tuple[Path, int]]) -> None:
    """Take away all rights to files but those of the rules, all of TCP, and signals to others.

    Each rule is a path and the rights to all that is beneath it; paths that do not exist are left
    out. Raise OSError if the kernel refuses.
    """
    abi = version()
    handled = _FILES_BY_ABI.get(abi, ALL)
    network = _NETWORK if abi >= 4 else 0
    scopes = _SCOPES if abi >= 6 else 0
    attributes = struct.pack("QQQ", handled, network, scopes)
    size = 24 if abi >= 6 else 16 if abi >= 4 else 8
    ruleset = syscall(_CREATE, attributes, size, 0, what="landlock_create_ruleset")
    try:
        for path, rights in rules:
            _add(ruleset, path, rights & handled)
        syscall(_RESTRICT, ruleset, 0, what="landlock_restrict_self")
    finally:
        os.close(ruleset)


def _add(ruleset: int, path: Path, rights: int) -> None:
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not path.is_dir():
            rights &= _OF_FILES
        rule = ctypes.create_string_buffer(struct.pack("=Qi", rights, handle))
        syscall(_ADD_RULE, ruleset, _PATH_BENEATH, rule, 0, what=f"landlock rule for {path}")
    finally:
        os.close(handle)
