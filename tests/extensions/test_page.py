"""The package of ``docs/guides/extending.md``, installed as it stands there."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "extending.md"


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """Return a function that runs Python where the package is installed."""
    site = tmp_path_factory.mktemp("site")
    page = PAGE.read_text()
    for name, source in re.findall(r"^```python\n# (\S+)\n(.*?)^```", page, re.DOTALL | re.M):
        (site / name).parent.mkdir(exist_ok=True)
        (site / name).write_text(source)
    (groups,) = re.findall(r"^```toml\n(.*?)^```", page, re.DOTALL | re.M)
    about = site / "my_package-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: my_package\nVersion: 1.0\n")
    entries = re.sub(r'\[project\.entry-points\."(.+?)"\]', r"[\1]", groups).replace('"', "")
    (about / "entry_points.txt").write_text(entries)

    def run(*arguments):
        return subprocess.run(
            [sys.executable, *arguments],
            env={**os.environ, "PYTHONPATH": str(site)},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )

    return run


def test_it_conforms(python):
    code = "from my_package.test_conformance import *; test_everything_conforms()"
    done = python("-c", code)
    assert done.returncode == 0, done.stderr


def test_the_command_of_the_page_uses_all_of_it(python):
    command = ("run", "follow", "--suite", "twice-v1")
    assert f"`colift {' '.join(command)}`" in PAGE.read_text()
    done = python("-m", "colift", *command, "--isolation", "none", "--json")
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)["summary"]
    assert summary["episodes"] == 4
    assert 0.0 < summary["within_10_mm"]["mean"] < 1.0
