"""What the tests of several packages share."""

import ctypes
import fcntl
import gc
import importlib.util
import os
import resource
import shutil
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import colift
import pytest
from colift.agents.onnx.libraries import NO_TELEMETRY
from colift.agents.sandbox.host import levels
from colift.benchmark.execution.pool import JOBS
from colift.benchmark.profiling.loopback import loopback_cluster

from .laboratory import emulators

MOST_MEMORY = 1 << 30
"""Memory that no process of the tests may reach [bytes]."""

FIRST = (
    "benchmark/paper/test_claims.py",
    "leaderboard/pages/test_compare_page.py",
    "benchmark/twin/test_twin.py",
    "leaderboard/queue/test_worker_processes.py",
    "agents/sandbox/test_hostile.py",
    "benchmark/training/test_apg.py",
    "benchmark/execution/test_cluster.py",
    "cli/test_nao_vanishing.py",
    "cli/test_nao_stops.py",
    "cli/test_nao.py",
    "benchmark/execution/test_kernels.py",
    "leaderboard/pages/test_accessibility.py",
    "cli/test_submit.py",
    "leaderboard/backup/test_backup.py",
    "cli/test_serve.py",
    "leaderboard/service/test_kills.py",
    "test_packaging.py",
)
"""Files that make what others wait for, that take the longest, and the longest of the last."""

# The tests start hundreds of processes: each would compile all it imports if nobody kept it.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Tests import onnxruntime by themselves, whose reports would open sockets at any time.
os.environ[NO_TELEMETRY] = "1"

# A shell lets what it starts in the background ignore Ctrl-C; so would all that the tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """One more than there are processors: many tests wait. The smoke tests are in one file."""
    smoke = config.getoption("markexpr") == "smoke"
    return 0 if smoke else len(os.sched_getaffinity(0)) + 1


def pytest_xdist_setupnodes():
    """Compile colift once; else each of the processes does, all at the same time."""
    folder = Path(colift.__path__[0])
    subprocess.run([sys.executable, "-m", "compileall", "-qq", "-j", "0", folder], check=False)


def pytest_ignore_collect(collection_path, config):
    """Leave out what has no smoke test when only these are asked for: importing it takes longer."""
    asked = config.getoption("markexpr") == "smoke" and collection_path.name.startswith("test_")
    return True if asked and "mark.smoke" not in collection_path.read_text() else None


def pytest_collection_modifyitems(items):
    """Hand out some files first: no process waits for what another makes, or has not ended."""
    here = Path(__file__).parent
    places = {here / name: place for place, name in enumerate(FIRST)}
    items.sort(key=lambda item: places.get(item.path, len(FIRST)))


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Exempt the half a million objects of the collection from all later garbage collection.

    The search for leaks after each module would otherwise take longer than most modules.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.collect()
        gc.freeze()
        gc.enable()


@pytest.fixture(scope="module")
def chromium():
    """A browser, as long as a module needs it: its event loop keeps others from running."""
    from .browser import browser

    with browser() as opened:
        yield opened


@pytest.fixture(scope="session", autouse=True)
def own_environment(tmp_path_factory):
    """Keep what is cached from the user's own; one worker is enough where tests share the cores."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        patched.setenv(JOBS, "1")
        yield


@pytest.fixture(scope="module", autouse=True)
def _own_leaks(request):
    """Charge what is left open, and the memory of the process, to the module that took it."""
    before = peak_memory()
    yield
    if "jax" in sys.modules:
        sys.modules["jax"].clear_caches()
    gc.collect()
    gc.freeze()
    give_back()
    peak = peak_memory()
    if before < MOST_MEMORY <= peak:
        pytest.fail(f"{request.module.__name__} took this process to {peak >> 20} MiB of memory")


@pytest.fixture(scope="module", autouse=True)
def _no_jax(request):
    """Keep JAX out of the processes that run many modules: no fork survives its threads."""
    yield
    if "jax" in sys.modules and not request.path.name.startswith("jax_"):
        pytest.fail(f"{request.path.name} imports JAX: its tests belong into jax_*.py, run apart")


@pytest.fixture(scope="session")
def compiling(once):
    """Return the variables of a process in which JAX computes; skip if it is missing.

    It computes on one thread, as the commands do. Compiling takes longer than computing in a test:
    it is quick rather than good, and is done once.
    """
    if importlib.util.find_spec("jax") is None:
        pytest.skip("JAX is not installed")
    # Later versions end the process at a flag that is no more.
    emitters = [int(part) for part in version("jax").split(".")[:2]] < [0, 11]
    return {
        "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false --xla_backend_optimization_level=0 "
        "--xla_llvm_disable_expensive_passes=true --xla_cpu_parallel_codegen_split_count=1"
        + emitters
        * " --xla_cpu_use_fusion_emitters=false",
        "JAX_COMPILATION_CACHE_DIR": str(once("compiled", lambda folder: None)),
        "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0",
        "JAX_PERSISTENT_CACHE_MIN_ENTRY_SIZE_BYTES": "-1",
    }


@pytest.fixture(params=["not slow", pytest.param("slow", marks=pytest.mark.slow)])
def in_own_process(compiling, request):
    """Run the tests of modules ``jax_*.py`` in a process of their own.

    The slow ones of them are a test of their own.
    """

    def run(*modules: Path):
        environment = {
            name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")
        } | compiling
        command = [sys.executable, "-m", "pytest", "-n", "0", "-q", "-p", "no:cacheprovider"]
        command += ["-m", request.param]
        done = subprocess.run(
            [*command, *map(str, modules)], env=environment, capture_output=True, text=True
        )
        none = request.param == "slow" and done.returncode == pytest.ExitCode.NO_TESTS_COLLECTED
        assert none or done.returncode == 0, done.stdout[-10_000:] + done.stderr[-2000:]

    return run


def give_back():
    """Return freed memory to the system, which the C library keeps between what is in use."""
    ctypes.CDLL(None).malloc_trim(0)


def peak_memory():
    """Return the most memory that this process has had at a time [bytes]."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory):
    """The folder that all processes of the tests share."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if "PYTEST_XDIST_WORKER" in os.environ else base


@pytest.fixture(scope="session")
def once(shared_folder):
    """Return what makes a folder once for all processes of the tests, and gives its path."""

    def folder(name, make):
        place, made = shared_folder / name, shared_folder / f"{name}-{os.getpid()}"
        with (shared_folder / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not place.exists():
                made.mkdir()
                make(made)
                made.rename(place)
        return place

    return folder


@pytest.fixture
def another_colift(tmp_path):
    """Return a folder with a colift whose sandboxes are another version."""
    here, there = Path(colift.__file__).parent, tmp_path / "another" / "colift"
    there.mkdir(parents=True)
    for path in here.iterdir():
        if path.name != "agents":
            (there / path.name).symlink_to(path)
    shutil.copytree(here / "agents", there / "agents")
    changed = there / "agents" / "sandbox" / "guest" / "forkserver.py"
    changed.write_text(changed.read_text().replace("os.umask(0o022)", "os.umask(0o077)"))
    return there.parent


@pytest.fixture(scope="session")
def need_level():
    """Return what skips a test if an isolation level does not work here, with the reason."""

    def need(level):
        reason = levels.fault(level)
        if reason is not None:
            remedy = "; apt-get install bubblewrap" if level == "bubblewrap" else ""
            pytest.skip(f"isolation {level} does not work here: {reason}{remedy}")

    return need


STRONGEST = "strongest"


@pytest.fixture(
    scope="module",
    params=[STRONGEST, *(pytest.param(name, marks=pytest.mark.slow) for name in levels.LEVELS)],
)
def each_level(request, need_level):
    """The strongest isolation level that works here; in slow tests, each of the others."""
    strongest = levels.strongest()
    if request.param == STRONGEST:
        return strongest
    if request.param == strongest:
        pytest.skip(f"isolation {strongest} is the strongest here, which is not slow")
    need_level(request.param)
    return request.param


@pytest.fixture(scope="module")
def dask_address():
    """Start a Dask scheduler and two worker processes, and return the scheduler's address.

    They end with the module: they are busy also when nobody uses them.
    """
    pytest.importorskip("distributed", reason="needs Dask: uv sync --all-extras")
    with loopback_cluster(2) as address:
        yield address


@pytest.fixture(scope="session")
def lsl_on_loopback(tmp_path_factory):
    """Keep the streams of the tests on this machine, and away from others."""
    path = tmp_path_factory.mktemp("lsl") / "lsl_api.cfg"
    path.write_text(
        "[lab]\nKnownPeers = {127.0.0.1}\n"
        f"SessionID = colift-tests-{os.getpid()}\n"
        "[multicast]\nResolveScope = machine\n[log]\nlevel = -2\n"
    )
    before = os.environ.get("LSLAPICFG")
    os.environ["LSLAPICFG"] = str(path)
    yield
    if before is None:
        del os.environ["LSLAPICFG"]
    else:
        os.environ["LSLAPICFG"] = before


@pytest.fixture
def emulate(lsl_on_loopback):
    """Start an emulated laboratory for a test, over the real protocols.

    It ends with the test: an idle one takes a fifth of a processor.
    """
    with emulators() as start:
        yield start


@pytest.fixture(scope="module")
def laboratory(lsl_on_loopback):
    """An emulated laboratory that the tests of a module share."""
    with emulators() as start:
        yield start()
