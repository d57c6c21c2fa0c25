"""A real PostgreSQL server for a test run: its own data, reached by a socket of its own."""

import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

SETTINGS = "-c fsync=off -c listen_addresses='' -c max_connections=60"


def binaries() -> Path:
    """Return the folder of initdb and pg_ctl, or skip the test."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/pg_ctl"))
    on_path = shutil.which("pg_ctl")
    if found:
        return found[-1].parent
    if on_path:
        return Path(on_path).resolve().parent
    pytest.skip("needs a PostgreSQL server: apt-get install postgresql")


def as_its_user(folder: Path) -> dict[str, Any]:
    """Return how a process of the server in a folder is started: PostgreSQL refuses to be root."""
    owner = folder.stat()
    identity = {"user": owner.st_uid, "group": owner.st_gid, "extra_groups": []}
    return {
        "cwd": folder,
        "stdout": subprocess.DEVNULL,
        "env": {**os.environ, "LC_ALL": "C.UTF-8"},
        **(identity if os.getuid() == 0 else {}),
    }


@contextmanager
def server() -> Iterator[str]:
    """Yield the URL of a new server; it ends with the body."""
    programs = binaries()
    folder = Path(tempfile.mkdtemp(prefix="pg-"))  # A socket's path must be short.
    user = pwd.getpwnam("nobody") if os.getuid() == 0 else pwd.getpwuid(os.getuid())
    os.chown(folder, user.pw_uid, user.pw_gid)

    settings = as_its_user(folder)
    data, control = folder / "data", programs / "pg_ctl"
    make = [programs / "initdb", "-D", data, "-U", "colift", "-A", "trust", "--no-sync"]
    begin = [control, "-D", data, "start", "-w", "-l", folder / "log.txt"]
    begin += ["-o", f"{SETTINGS} -k {folder}"]
    try:
        subprocess.run(make, check=True, stdin=subprocess.DEVNULL, **settings)
        # It ends when the pipe does, also if this process is killed.
        end = 'cat; "$0" -D "$1" stop -m immediate; rm -rf "$2"'
        with subprocess.Popen(
            ["sh", "-c", end, control, data, folder],
            stdin=subprocess.PIPE,
            start_new_session=True,
            **settings,
        ):
            subprocess.run(begin, check=True, stdin=subprocess.DEVNULL, **settings)
            yield f"postgresql://colift@/postgres?host={folder}"
    finally:
        shutil.rmtree(folder, ignore_errors=True)
