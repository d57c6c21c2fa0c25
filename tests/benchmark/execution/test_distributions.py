"""Which PyBullet plays: the original or the fork, whatever else is installed."""

import hashlib
import json
import os
import subprocess
import sys
from base64 import urlsafe_b64encode
from importlib.metadata import version

import pytest
from colift.base.errors import InputError
from colift.benchmark.execution import distributions
from colift.benchmark.execution.distributions import ENGINES, engine, library_versions
from colift.benchmark.execution.provenance import fingerprint
from colift.leaderboard.evaluation.evaluate import versions

SHOW = (
    "import json; from colift.benchmark.execution import distributions as found; "
    "print(json.dumps([found.engine().name, found.library_versions()['pybullet']]))"
)


def install(site, name, number, content):
    """Leave what an installer does: the record of a module, which may be another's by now."""
    digest = urlsafe_b64encode(hashlib.sha256(content.encode()).digest()).decode().rstrip("=")
    info = site / f"{name.replace('-', '_')}-{number}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {number}\n")
    (info / "RECORD").write_text(f"pybullet.py,sha256={digest},{len(content)}\n")


def seen_from(site):
    done = subprocess.run(
        [sys.executable, "-c", SHOW],
        env={**os.environ, "PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def test_one_of_both_is_installed_and_everything_names_it():
    name = engine().name
    assert name in ENGINES
    expected = version(name) if name == "pybullet" else f"{name} {version(name)}"
    assert library_versions() == {"numpy": version("numpy"), "pybullet": expected}
    assert fingerprint()["pybullet"] == versions()["pybullet"] == expected


def test_the_original_plays_where_it_has_a_wheel():
    original = sys.version_info < (3, 12) and fingerprint()["machine"] == "Linux x86_64"
    assert engine().name == ENGINES[not original]


@pytest.mark.parametrize(("left", "shown"), [(0, "1"), (1, "pybullet-arm64 1")])
def test_of_two_it_is_the_one_whose_file_is_there(tmp_path, left, shown):
    for name, content in zip(ENGINES, ("a = 1\n", "b = 2\n"), strict=True):
        install(tmp_path, name, "1", content)
    (tmp_path / "pybullet.py").write_text(("a = 1\n", "b = 2\n")[left])
    assert seen_from(tmp_path) == [ENGINES[left], shown]


def test_none_is_told_in_words(monkeypatch):
    monkeypatch.setattr(distributions, "distributions", lambda **_: [])
    engine.cache_clear()
    with pytest.raises(
        InputError, match="PyBullet is not installed: neither pybullet nor pybullet"
    ):
        engine()
