"""``--behaviour``: a human behaviour that another package registers."""

import json
import os
import subprocess
import sys

import pytest

SHY = '''
from colift.agents.humans import Smooth

class Shy(Smooth):
    """Lifts smoothly, to a stranger's surprise."""
'''


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """Install a package that registers the behaviour ``shy``; return what runs the command."""
    site = tmp_path_factory.mktemp("site")
    (site / "shy_lab.py").write_text(SHY)
    about = site / "shy_lab-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: shy-lab\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[colift.humans]\nshy = shy_lab:Shy\n")

    def run(*arguments):
        done = subprocess.run(
            [sys.executable, "-m", "colift.cli", *arguments],
            capture_output=True,
            text=True,
            cwd=site,
            env={**os.environ, "PYTHONPATH": str(site)},
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.mark.slow
def test_a_registered_behaviour_is_listed_run_and_verified(lab):
    assert "surprise" in lab("list")
    short = ("--suite", "quick-v1", "--seeds", "0:1", "--behaviour", "shy")
    options = (*short, "--behaviour", "pause", "--jobs", "2", "--out", "bundle")
    content = json.loads(lab("run", "copy", *options, "--json"))
    assert content["suite"] == "quick-v1 (shy, pause)[0:1]"
    assert [(each["behaviour"], each["subject"]) for each in content["groups"]] == [
        (behaviour, subject)
        for behaviour in ("shy", "pause")
        for subject in ("draw-1", "draw-2", "draw-3")
    ]
    assert "bundle is verified" in lab("verify", "bundle", "--jobs", "1")


@pytest.mark.slow
def test_policies_are_compared_on_a_behaviour(lab):
    options = ("--suite", "quick-v1", "--seeds", "0:1", "--behaviour", "shy", "--jobs", "1")
    content = json.loads(lab("compare", "copy", "hold", *options, "--json"))
    assert content["suite"] == "quick-v1 (shy)[0:1]"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--behaviour", "rude"), "unknown human behaviour 'rude'"),
        (("--behaviour", "pause", "--recordings", "x.csv"), "exclude each other"),
        (("--suite", "standard-v1", "--recordings", "x.csv"), "--suite and --recordings exclude"),
    ],
)
def test_a_wrong_behaviour_is_one_line(colift, options, words):
    done = colift("run", "copy", *options)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert words in done.stderr
