"""``colift run`` that is killed, goes on, or runs on a cluster: always the same bundle."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from colift.agents.submissions.new import write_template
from colift.base.extras import how_to_install
from colift.benchmark.execution.journal import journal_path
from colift.benchmark.execution.records import records
from colift.benchmark.profiling.loopback import loopback_cluster

pytestmark = pytest.mark.slow

SLOW = """
import time
import numpy as np

class Slow:
    def reset(self, seed): pass
    def act(self, observation):
        time.sleep(0.002)
        return np.array([observation[0] - observation[3]])
"""

FOR_THE_BALL = """
class Policy:
    def reset(self, seed): pass
    def act(self, observation):
        if len(observation) != 10:
            raise ValueError(len(observation))
        return [0.0]
"""

DYING = """
import os
from pathlib import Path
from colift.agents.policies.copy import Copy

class Dying(Copy):
    def act(self, observation):
        once = Path({once!r})
        if observation[0] > 0.05 and not once.exists():
            once.touch()
            os.kill(os.getpid(), 9)
        return super().act(observation)
"""

WITHOUT_DASK = """
import sys
sys.modules["distributed"] = None
from colift.cli.main import main
main()
"""


def begin(*arguments, start=("-m", "colift.cli"), **environment):
    """Start the command, in a group of processes of its own."""
    return subprocess.Popen(
        [sys.executable, *start, "run", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, **environment},
    )


def run(*arguments, **more):
    """Run the command; return its exit code, and what it said on stderr."""
    process = begin(*arguments, **more)
    _, told = process.communicate(timeout=300)
    return process.returncode, besides_isolation(told)


def besides_isolation(told):
    """Return what was said besides why a stronger sandbox than the one used does not work here."""
    lines = told.splitlines(keepends=True)
    return "".join(line for line in lines if " does not work here: " not in line)


def recorded(path):
    """Return the number of records in a file."""
    with path.open("rb") as file:
        return len(list(records(file)))


def wait_for_episodes(bundle, count, process):
    """Wait until so many episodes of a run are in its journal."""
    path, end = journal_path(bundle), time.monotonic() + 240
    while not path.exists() or recorded(path) <= count:
        assert process.poll() is None
        assert time.monotonic() < end
        time.sleep(0.01)


def processor_time(process):
    """Return what a process has had of the processors [s]."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def timeless(bundle):
    """Return a bundle's content without the policy's times, and their hash."""
    files = {path.name: path.read_bytes() for path in bundle.iterdir()}
    results, manifest = (
        json.loads(files.pop("results.json")),
        json.loads(files.pop("manifest.json")),
    )
    for name in ("step_ms", "real_time"):
        del results["summary"][name]
    del manifest["sha256"]["results.json"]
    return files, results, manifest


@pytest.fixture(scope="module")
def slow(tmp_path_factory):
    path = tmp_path_factory.mktemp("policy") / "slow.py"
    path.write_text(SLOW)
    return f"{path}:Slow"


@pytest.fixture(scope="module")
def whole(slow, tmp_path_factory):
    """The bundle of a run that nothing disturbs, in one process."""
    bundle = tmp_path_factory.mktemp("whole") / "bundle"
    assert run(slow, "--suite", "quick-v1", "--jobs", 1, "--out", bundle) == (0, "")
    return timeless(bundle)


@pytest.fixture(scope="module")
def killed(slow, tmp_path_factory):
    """The journal of a run with two workers that was killed in the middle."""
    bundle = tmp_path_factory.mktemp("killed") / "bundle"
    process = begin(slow, "--suite", "quick-v1", "--jobs", 2, "--out", bundle)
    wait_for_episodes(bundle, 2, process)
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    assert not bundle.exists()
    return journal_path(bundle)


@pytest.fixture
def interrupted(killed, tmp_path):
    """A bundle whose run was killed in the middle."""
    shutil.copy(killed, journal_path(tmp_path / "bundle"))
    return tmp_path / "bundle"


@pytest.mark.parametrize("torn", [0, 10])
def test_a_killed_run_goes_on_to_the_same_bundle(slow, whole, interrupted, torn):
    path = journal_path(interrupted)
    os.truncate(path, path.stat().st_size - torn)
    assert 1 < recorded(path) < 13
    told = run(slow, "--suite", "quick-v1", "--jobs", 2, "--out", interrupted, "--resume")
    assert told == (0, "")
    assert timeless(interrupted) == whole
    assert not path.exists()


@pytest.mark.parametrize(
    ("policy", "options", "difference"),
    [
        ("copy", (), "policy 'Slow', this one has 'copy'"),
        (None, ("--seeds", "0:2"), "suite 'quick-v1', this one has 'quick-v1[0:2]'"),
        (None, ("--latency", "0.05"), "this one has 'quick-v1 (latency 0.05 s)'"),
        (None, ("--isolation", "none"), "', this one has 'none'"),
    ],
)
def test_another_run_does_not_go_on(colift, slow, interrupted, policy, options, difference):
    before = journal_path(interrupted).read_bytes()
    suite = ("--suite", "quick-v1", *options)
    code, _, told = colift("run", policy or slow, *suite, "--out", interrupted, "--resume")
    assert code == 2
    assert "--resume: the interrupted run had " in told
    assert difference in told
    assert besides_isolation(told).count("\n") == 1
    assert journal_path(interrupted).read_bytes() == before


def test_another_version_does_not_go_on(slow, interrupted, another_colift):
    options = ("--suite", "quick-v1", "--out", interrupted, "--resume")
    code, told = run(slow, *options, PYTHONPATH=str(another_colift))
    assert code == 2
    assert "the interrupted run had colift '" in told


def test_an_interrupted_run_is_not_begun_anew(colift, slow, interrupted):
    code, _, told = colift("run", slow, "--suite", "quick-v1", "--out", interrupted)
    assert code == 2
    assert "lifts of an interrupted run; resume it, name another folder" in told
    assert told.endswith("(--resume continues it)\n")


def test_ctrl_c_in_the_baselines_keeps_the_run(tmp_path):
    bundle = tmp_path / "bundle"
    # So many that the baselines, thrice as many, take a second on any machine.
    options = ("copy", "--suite", "quick-v1", "--seeds", "0:4", "--jobs", 1, "--out", bundle)
    process = begin(*options)
    wait_for_episodes(bundle, 48, process)
    end = processor_time(process.pid) + 0.2  # Out of the run, into the baselines.
    while processor_time(process.pid) < end:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=300)
    assert process.returncode == 130
    assert told.startswith("interrupted before the baselines were played")
    assert "--resume" in told
    assert json.loads((bundle / "results.json").read_text())["complete"]
    assert run(*options, "--resume") == (0, "")
    assert set(json.loads((bundle / "results.json").read_text())["baselines"]) == {
        "human_human",
        "hold",
        "copy",
    }
    code, told = run(*options, "--resume")
    assert code == 2
    assert "holds a finished result bundle" in told
    assert told.endswith("nothing is left to resume\n")


def test_a_cluster_gives_the_same_bundle(slow, whole, dask_address, tmp_path):
    bundle = tmp_path / "bundle"
    options = ("--suite", "quick-v1", "--dask", dask_address, "--out", bundle)
    assert run(slow, *options) == (0, "")
    assert timeless(bundle) == whole


@pytest.mark.parametrize("where", ["pool", "cluster"])
def test_a_worker_that_dies_is_said_and_not_charged(where, tmp_path, request):
    path = tmp_path / "dying.py"
    path.write_text(DYING.format(once=str(tmp_path / "once")))
    options = ["--suite", "quick-v1", "--isolation", "none", "--out", tmp_path / "bundle"]
    if where == "pool":
        options += ["--jobs", 2]
    else:
        options += ["--dask", request.getfixturevalue("dask_address")]
    code, told = run(f"{path}:Dying", *options)
    assert (code, told.count("\n")) == (0, 1)
    assert "played again because a worker died" in told
    results = json.loads((tmp_path / "bundle" / "results.json").read_text())
    assert results["evaluator_faults"] >= 1
    assert results["summary"]["failed"] == 0


def test_a_run_whose_scheduler_dies_goes_on_elsewhere(slow, whole, tmp_path):
    distributed = pytest.importorskip("distributed", reason="needs Dask: uv sync --all-extras")
    bundle = tmp_path / "bundle"
    options = (slow, "--suite", "quick-v1", "--out", bundle)
    with loopback_cluster(1) as address:
        with distributed.Client(address, set_as_default=False) as client:
            pid = client.run_on_scheduler(os.getpid)
        process = begin(*options, "--dask", address)
        wait_for_episodes(bundle, 1, process)
        os.kill(pid, signal.SIGKILL)
        _, told = process.communicate(timeout=300)
    assert process.returncode == 1
    assert told.startswith("error: ")
    assert f"lost the Dask scheduler {address}" in told
    assert told.endswith("resume with the same command and --resume\n")
    assert told.count("\n") == 1
    assert run(*options, "--resume") == (0, "")
    assert timeless(bundle) == whole


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--resume",), "--resume needs the --out of the run"),
        (("--resume", "--out", "new"), "there is no interrupted run of new"),
        (("--dask", "tcp://127.0.0.1:1", "--jobs", "2"), "--jobs and --dask exclude each other"),
        (("--dask", "nonsense"), "should be such as tcp://host:8786"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(colift, options, words):
    code, _, told = colift("run", "copy", "--suite", "quick-v1", *options)
    assert code == 2
    assert words in told
    assert told.count("\n") == 1


@pytest.mark.parametrize(
    "command",
    [
        ("run", "mine", "--out", "kept"),
        ("compare", "copy", "mine", "--out", "kept"),
        ("channels", "copy", "mine"),
    ],
)
def test_a_submission_for_another_task_is_refused_before_the_first_lift(colift, tmp_path, command):
    write_template(tmp_path / "mine")
    (tmp_path / "mine" / "policy.py").write_text(FOR_THE_BALL)
    code, told, errors = colift(*command, "--suite", "quick-v1")
    assert (code, told) == (2, "")
    assert errors.splitlines()[-1].endswith(
        "is for the task 'ball', not for 'level', where it fails at once: step 0: ValueError: 5"
    )
    assert not (tmp_path / "kept").exists()


def test_a_missing_dask_names_the_extra():
    code, told = run("copy", "--dask", "tcp://127.0.0.1:1", start=("-c", WITHOUT_DASK))
    assert (code, told) == (
        2,
        f"error: --dask: Dask is not installed: {how_to_install('cluster')}\n",
    )


def test_a_finished_bundle_is_replaced_only_when_that_is_asked_for(colift, tmp_path):
    command = ("run", "hold", "--suite", "quick-v1", "--seeds", "0:1", "--jobs", 1, "--out", "kept")
    assert colift(*command).returncode == 0
    before = (tmp_path / "kept" / "results.json").read_bytes()
    for again, option in (
        (command, "--out"),
        (("verify", "kept", "--rescore", "kept"), "--rescore"),
    ):
        error = (
            f"error: {option}: kept holds a finished result bundle; name a new folder; "
            "--force replaces it\n"
        )
        assert colift(*again) == (2, "", error)
    assert (tmp_path / "kept" / "results.json").read_bytes() == before
    other = ("copy" if word == "hold" else word for word in command)
    assert colift(*other, "--force").returncode == 0
    assert json.loads((tmp_path / "kept" / "results.json").read_text())["policy"]["name"] == "copy"
