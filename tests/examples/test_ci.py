"""The workflow and the image that a laboratory copies: what they say, and what they run."""

import os
import re
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

import pytest
from colift.agents.sandbox.host.refusals import in_words
from colift.agents.submissions.new import write_template

ROOT = Path(__file__).parents[2]
CI = ROOT / "examples" / "ci"


@pytest.fixture(scope="module")
def workflow():
    yaml = pytest.importorskip("yaml", reason="needs PyYAML")
    return yaml.safe_load((CI / "colift.yml").read_text())


@pytest.fixture
def runner(tmp_path):
    """An environment like that of a runner: an empty Python with pip, and colift as a wheel.

    The libraries are those of this environment, since a test needs no network.
    """
    python = tmp_path / "python"
    subprocess.run([sys.executable, "-m", "venv", python], check=True)
    site = python / "lib" / f"python{sysconfig.get_python_version()}" / "site-packages"
    (site / "zz_libraries.pth").write_text(sysconfig.get_path("purelib"))
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel"]
    subprocess.run([*build, "--directory", tmp_path / "built"], cwd=ROOT, check=True)
    (wheel,) = (tmp_path / "built").iterdir()
    return {
        "PATH": f"{python / 'bin'}:{os.environ['PATH']}",
        "HOME": str(tmp_path),
        "PIP_NO_DEPS": "1",
        "PIP_NO_INDEX": "1",
        "COLIFT": str(wheel),
    }


@pytest.mark.slow
def test_a_push_checks_and_scores_the_policy_of_a_repository(workflow, runner, tmp_path):
    repository = tmp_path / "repository"
    write_template(repository / "policy")
    manifest = repository / "policy" / "policy.toml"
    manifest.write_text(manifest.read_text().replace("Your Name", "Ada Lovelace"))
    (job,) = workflow["jobs"].values()
    commands = [step["run"] for step in job["steps"] if "run" in step]
    said = []
    for command in commands:
        if command.startswith("sudo "):
            continue  # It prepares the machine, which is here as it is.
        done = subprocess.run(
            ["bash", "-e", "-c", command],
            cwd=repository,
            env=runner,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, f"{command}: {done.stdout}{done.stderr}"
        said.append(done.stdout)
    assert "RMSE" in said[-1]
    (upload,) = (step["with"] for step in job["steps"] if "upload-artifact" in step.get("uses", ""))
    assert (repository / upload["path"] / "results.json").is_file()


def test_machines_are_prepared_as_the_sandbox_says_when_it_is_refused(workflow):
    steps = "\n".join(
        step.get("run", "") for job in workflow["jobs"].values() for step in job["steps"]
    )
    cure = in_words("unshare: [Errno 13] Permission denied").partition(": ")[2].split(" (")[0]
    assert cure in steps
    image = (CI / "Dockerfile").read_text()
    cure = in_words("unshare: [Errno 1] Operation not permitted").partition("docker run ")[2]
    for option in re.findall(r"--security-opt \S+", cure.split(" (")[0]):
        assert option in image
    assert "bubblewrap" in steps
    assert "bubblewrap" in image


def test_both_have_a_python_that_colift_is_developed_on(workflow):
    versions = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["classifiers"]
    (job,) = workflow["jobs"].values()
    (setup,) = (step["with"] for step in job["steps"] if "setup-python" in step.get("uses", ""))
    image = re.search(r"^FROM python:([\d.]+)", (CI / "Dockerfile").read_text(), re.MULTILINE)[1]
    for version in (setup["python-version"], image):
        assert f"Programming Language :: Python :: {version}" in versions
