"""A real PostgreSQL server for a test run: its own data, reached by a socket of its own."""

import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

WITHOUT = "COLIFT_TESTS_WITHOUT_POSTGRESQL"
"""Environment variable; set, the tests on PostgreSQL are skipped."""

SETTINGS = "-c fsync=off -c listen_addresses='' -c max_connections=60"


def binaries() -> Path:
    """Return the folder of initdb and pg_ctl."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/pg_ctl"))
    on_path = shutil.which("pg_ctl")
    if found:
        return found[-1].parent
    if on_path:
        return Path(on_path).resolve().parent
    raise RuntimeError(
        "no PostgreSQL server is installed, and the board's tests need one: "
        f"apt-get install postgresql; or set {WITHOUT}=1 to go without"
    )


@contextmanager
def server() -> Iterator[str]:
    """Yield the URL of a new server; it ends with the body."""
    folder = Path(tempfile.mkdtemp(prefix="pg-"))  # A socket's path must be short.
    user = pwd.getpwnam("nobody") if os.getuid() == 0 else pwd.getpwuid(os.getuid())
    os.chown(folder, user.pw_uid, user.pw_gid)

    def run(program: str, *arguments: str) -> None:
        """Run a program of PostgreSQL; it refuses to be root."""
        command = [binaries() / program, "-D", folder / "data", *arguments]
        identity = {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
        subprocess.run(
            command,
            check=True,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            env={**os.environ, "LC_ALL": "C.UTF-8"},
            **(identity if os.getuid() == 0 else {}),
        )

    try:
        run("initdb", "-U", "colift", "-A", "trust", "--no-sync")
        log = str(folder / "log.txt")
        run("pg_ctl", "start", "-w", "-l", log, "-o", f"{SETTINGS} -k {folder}")
        try:
            yield f"postgresql://colift@/postgres?host={folder}"
        finally:
            run("pg_ctl", "stop", "-m", "immediate")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
