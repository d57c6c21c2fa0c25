"""The session of a page: a folder, a Python environment, and servers until the page ends."""

import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import time
import venv
from pathlib import Path
from typing import Final

WIDTH: Final = 88
"""Columns of the terminal that commands print for."""

LONGEST: Final = 600
"""Time that a command may take [s]."""

ADDRESS: Final = "http://127.0.0.1:8000"
"""Address of a board on a page."""

TERMINAL: Final = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
"""Control sequences of a terminal."""


class Session:
    """The folder of a page, and the servers that run there until the page ends."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="colift-docs-")
        self.path = Path(self._folder.name) / "lab"
        self.path.mkdir()
        cache = Path(self._folder.name) / "cache"
        own, shared = _python(Path(self._folder.name) / "python"), Path(sys.executable).parent
        self._environment = os.environ | {
            "PATH": os.pathsep.join(map(str, (own / "bin", shared, os.environ["PATH"]))),
            "VIRTUAL_ENV": str(own),
            "UV_OFFLINE": "1",
            "UV_CACHE_DIR": str(cache / "uv"),
            "COLUMNS": str(WIDTH),
            "NO_COLOR": "1",
            "TERM": "dumb",
            "MPLBACKEND": "agg",
            "XDG_CACHE_HOME": str(cache),
        }
        self._servers: list[subprocess.Popen[bytes]] = []
        self._free: str | None = None

    def real(self, text: str) -> str:
        """Return a text with the address of the page's board instead of :data:`ADDRESS`."""
        return text.replace(ADDRESS, self._free) if self._free else text

    def run(self, command: str) -> tuple[str, int]:
        """Run a command and return what a terminal shows of it, and its exit code."""
        done = subprocess.run(
            ["bash", "-c", self.real(command)],
            cwd=self.path,
            env=self._environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=LONGEST,
        )
        return self._shown(done.stdout), done.returncode

    def serve(self, command: str, ready: str) -> str:
        """Start a command that runs until the page ends; return its output until ``ready``.

        A board listens on any free port: pages are built in parallel. They show :data:`ADDRESS`.
        """
        if command.startswith("colift serve") and "--port" not in command:
            command += " --port 0"
        log = Path(self._folder.name) / f"server-{len(self._servers)}.log"
        with log.open("w") as output:
            server = subprocess.Popen(
                ["bash", "-c", f"exec {command}"],
                cwd=self.path,
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        self._servers.append(server)
        running = True
        while running:
            running = server.poll() is None
            printed = log.read_text()
            begin, found, rest = printed.partition(ready)
            if found and "\n" in rest:
                address = re.search(r"http://127\.0\.0\.1:\d+", printed)
                self._free = address[0] if address else self._free
                return self._shown(begin + found + rest.partition("\n")[0])
            time.sleep(0.05)
        raise RuntimeError(f"{command!r} ended before it printed {ready!r}:\n{printed}")

    def _shown(self, output: str) -> str:
        """Return an output without control sequences, with the folder's name as ``~/lab``."""
        plain = TERMINAL.sub("", output).replace(str(self.path), "~/lab")
        if self._free:
            plain = plain.replace(self._free, ADDRESS)
        return "\n".join(line.rsplit("\r", 1)[-1].rstrip() for line in plain.splitlines()).strip(
            "\n"
        )

    def close(self) -> None:
        """End the servers and remove the folder."""
        for server in self._servers:
            server.terminate()
            server.wait(30)
        self._folder.cleanup()


def _python(folder: Path) -> Path:
    """Make an environment that has the packages of this one: a page may install its own there."""
    venv.create(folder, symlinks=True)
    (installed,) = folder.glob("lib/python*/site-packages")
    shared = sysconfig.get_path("purelib")
    (installed / "shared.pth").write_text(f"import site; site.addsitedir({shared!r})\n")
    program = folder / "bin" / "colift"
    program.write_text(
        f"#!{folder}/bin/python\n"
        "from colift.cli.main import main\n\n"
        "if __name__ == '__main__':\n    main()\n"
    )
    program.chmod(0o755)
    return folder
