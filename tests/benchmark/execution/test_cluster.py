"""A real Dask cluster on loopback: the same bits as here, whatever dies there."""

import os
import signal
import socket
import subprocess
import sys
from contextlib import contextmanager

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.sandbox.host.levels import strongest
from colift.agents.sandbox.host.policy import SandboxedPolicy
from colift.agents.submissions.new import write_template
from colift.agents.submissions.submission import open_submission
from colift.base.errors import EvaluatorFault, InputError
from colift.base.extras import how_to_install
from colift.benchmark.bundle.table import table_row
from colift.benchmark.execution import cluster as cluster_module
from colift.benchmark.execution import connecting
from colift.benchmark.execution.connecting import dask_pool
from colift.benchmark.execution.packaging import packaged
from colift.benchmark.execution.pool import process_pool
from colift.benchmark.execution.provenance import origin
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.profiling.loopback import loopback_cluster

from ...four import FOUR

pytestmark = pytest.mark.slow

distributed = pytest.importorskip("distributed", reason="needs Dask: uv sync --all-extras")

SUITE = FOUR.with_seeds(0, 1)
LONGER = FOUR
COPY = PolicySpec(text="copy")
SANDBOXED = SandboxedPolicy(name="copy", origin="colift.agents.policies.copy:Copy")

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
from colift.base.errors import InputError
from colift.benchmark.execution.connecting import dask_pool
try:
    with dask_pool("tcp://127.0.0.1:8786"):
        pass
except InputError as error:
    print(error)
"""

WITHOUT_COLIFT = "import sys; sys.modules['colift'] = None; from dask.__main__ import main; main()"


@pytest.fixture
def cluster(dask_address):
    with dask_pool(dask_address) as connected:
        yield connected


@pytest.fixture(scope="module")
def alone():
    return run_suite(COPY, SUITE)


@pytest.fixture(scope="module")
def bare_address():
    """Start a scheduler that has no worker."""
    with loopback_cluster(0) as address:
        yield address


@contextmanager
def worker(address, *options, code=None, path=()):
    """Run a worker of another kind for a scheduler, and return its process once it is there."""
    start = ("-m", "dask") if code is None else ("-c", code)
    paths = os.pathsep.join([*map(str, path), *filter(None, [os.environ.get("PYTHONPATH")])])
    process = subprocess.Popen(
        [
            *(sys.executable, *start, "worker", address, "--no-nanny", "--no-dashboard"),
            *("--host", "127.0.0.1", *options),
        ],
        env={**os.environ, "PYTHONPATH": paths},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(1, timeout=60)
        yield process
    finally:
        process.kill()
        process.wait()


def told(run):
    return [(e.trace.digest(), repr(table_row(e, run.suite.metrics)), e.log) for e in run.episodes]


def test_the_cluster_gives_the_same_bits(alone, cluster):
    run = run_suite(COPY, SUITE, executor=cluster)
    assert (told(run), run.faults, run.isolation) == (told(alone), 0, "none")
    assert cluster.origin == origin()
    assert cluster.idle_threads == 0


def test_the_cluster_gives_the_same_bits_in_the_sandbox(alone, cluster):
    run = run_suite(SANDBOXED, SUITE, executor=cluster)
    assert (told(run), run.faults, run.isolation) == (told(alone), 0, strongest())


@pytest.mark.parametrize(("spec", "jobs"), [(COPY, 2), (SANDBOXED, 1), (SANDBOXED, 2)])
def test_the_local_pool_gives_the_same_bits(alone, spec, jobs):
    with process_pool(jobs) as pool:
        run = run_suite(spec, SUITE, executor=pool)
    assert (told(run), run.faults) == (told(alone), 0)


def test_a_submission_with_many_weights_gives_the_same_bits(cluster, tmp_path):
    write_template(tmp_path / "heavy")
    (tmp_path / "heavy" / "weights.bin").write_bytes(os.urandom(20_000_000))
    spec = open_submission(tmp_path / "heavy").sandboxed(None)
    run = run_suite(packaged(spec), SUITE, executor=cluster)
    assert (told(run), run.faults) == (told(run_suite(spec, SUITE)), 0)


def test_a_worker_that_dies_in_an_episode_changes_nothing_but_the_count(alone, cluster, tmp_path):
    path = tmp_path / "dying.py"
    path.write_text(DYING.format(once=str(tmp_path / "once")))
    run = run_suite(packaged(PolicySpec(text=f"{path}:Dying")), SUITE, executor=cluster)
    assert told(run) == told(alone)
    assert run.faults >= 1


def test_all_workers_may_be_killed_in_mid_run(cluster, dask_address):
    with distributed.Client(dask_address, set_as_default=False) as client:
        pids = list(client.run(os.getpid).values())

    def kill(episodes):
        while pids:
            os.kill(pids.pop(), signal.SIGKILL)

    run = run_suite(packaged(SANDBOXED), LONGER, executor=cluster, progress=kill)
    assert pids == []
    assert told(run) == told(run_suite(COPY, LONGER))
    assert run.faults >= 1


def test_a_cluster_that_stays_without_workers_ends_the_run(bare_address, monkeypatch):
    monkeypatch.setattr(cluster_module, "LONELY_SECONDS", 0.5)
    with (
        worker(bare_address, "--nthreads", "1") as process,
        dask_pool(bare_address) as connected,
        pytest.raises(EvaluatorFault, match=r"cannot continue: .* had no worker for"),
    ):
        run_suite(packaged(COPY), LONGER, executor=connected, progress=lambda _: process.kill())


def test_a_lost_scheduler_ends_the_run():
    with loopback_cluster(1) as address, dask_pool(address) as connected:
        with distributed.Client(address, set_as_default=False) as client:
            pid = client.run_on_scheduler(os.getpid)
        with pytest.raises(EvaluatorFault, match=f"lost the Dask scheduler {address}"):
            run_suite(
                packaged(COPY),
                LONGER,
                executor=connected,
                progress=lambda _: os.kill(pid, signal.SIGKILL),
            )


def test_a_scheduler_without_workers_is_refused_and_the_way_out_is_told(bare_address, monkeypatch):
    monkeypatch.setattr(connecting, "CONNECT_SECONDS", 1.0)
    told = f"has no worker; start some: dask worker {bare_address} --nworkers auto --nthreads 1"
    with pytest.raises(InputError, match=told), dask_pool(bare_address):
        pass


def test_a_worker_with_another_colift_is_refused(bare_address, another_colift):
    with (
        worker(bare_address, path=[another_colift]),
        pytest.raises(
            InputError, match=r"colift is '[0-9a-f]{16}' on worker tcp://\S+ and '.* here"
        ),
        dask_pool(bare_address),
    ):
        pass


def test_a_worker_without_colift_is_refused(bare_address):
    with (
        worker(bare_address, code=WITHOUT_COLIFT),
        pytest.raises(InputError, match=r"worker tcp://\S+ cannot run colift: .*No module"),
        dask_pool(bare_address),
    ):
        pass


def test_idle_threads_are_counted_and_the_address_of_a_worker_is_refused(bare_address):
    with worker(bare_address, "--nthreads", "3"), dask_pool(bare_address) as connected:
        assert connected.idle_threads == 2
        (address,) = connected._alive
        with (
            pytest.raises(InputError, match="the address of a Dask Worker; name the"),
            dask_pool(address),
        ):
            pass


@pytest.mark.parametrize(
    "address", ["nonsense", "tcp://localhost", "http://127.0.0.1:80", "tls://127.0.0.1:1", ""]
)
def test_what_is_no_address_is_refused(address):
    told = f"no Dask scheduler answers at {address!r} .* should be such as tcp://host:8786"
    with pytest.raises(InputError, match=told), dask_pool(address):
        pass


@pytest.mark.parametrize("listening", [False, True])
def test_an_address_without_a_scheduler_is_refused(listening, monkeypatch):
    monkeypatch.setattr(connecting, "CONNECT_SECONDS", 0.5)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        if listening:
            other.listen()
        address = f"tcp://127.0.0.1:{other.getsockname()[1]}"
        with pytest.raises(InputError, match="no Dask scheduler answers"), dask_pool(address):
            pass


def test_a_missing_dask_names_the_extra():
    done = subprocess.run([sys.executable, "-c", WITHOUT_DASK], capture_output=True, text=True)
    assert done.stdout == f"Dask is not installed: {how_to_install('cluster')}\n"
