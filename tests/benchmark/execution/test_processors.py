"""The default number of workers: no more than a container may have processors."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from colift.benchmark.execution.processors import processor_quota, usable_processors

V2 = "30 23 0:27 {top} /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw,nsdelegate\n"
V1 = (
    "31 23 0:28 / /sys/fs/cgroup rw - tmpfs tmpfs rw,mode=755\n"
    "33 31 0:30 {top} /sys/fs/cgroup/cpu,cpuacct rw - cgroup cgroup rw,cpu,cpuacct\n"
    "34 31 0:31 {top} /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
)
OWN_V1 = "5:cpuset:{own}\n4:cpu,cpuacct:{own}\n"


@pytest.fixture
def system(tmp_path):
    """Return a function that writes what the kernel shows, and returns the quota that is read."""

    def quota(mounts, groups, files):
        content = {"proc/self/mountinfo": mounts, "proc/self/cgroup": groups}
        content |= {f"sys/fs/cgroup/{name}": text for name, text in files.items()}
        for name, text in content.items():
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return processor_quota(tmp_path)

    return quota


@pytest.mark.parametrize(
    ("top", "own", "files", "expected"),
    [
        ("/", "/", {"cpu.max": "200000 100000\n"}, 2),
        ("/", "/", {"cpu.max": "max 100000\n"}, None),
        ("/", "/", {}, None),
        ("/", "/a/b", {"a/b/cpu.max": "max 100000\n", "a/cpu.max": "50000 100000\n"}, 0.5),
        ("/", "/a/b", {"a/b/cpu.max": "150000 100000\n", "a/cpu.max": "400000 100000\n"}, 1.5),
        # A container: the mount shows a part, and the path of the group is that of the host.
        ("/docker/f00", "/docker/f00", {"cpu.max": "300000 100000\n"}, 3),
        ("/../..", "/", {"cpu.max": "300000 100000\n"}, 3),
    ],
)
def test_the_quota_of_version_2_is_the_least_of_all_groups(system, top, own, files, expected):
    assert system(V2.format(top=top), f"0::{own}\n", files) == expected


@pytest.mark.parametrize(
    ("own", "files", "expected"),
    [
        ("/", {"cpu.cfs_quota_us": "-1\n", "cpu.cfs_period_us": "100000\n"}, None),
        ("/", {"cpu.cfs_quota_us": "250000\n", "cpu.cfs_period_us": "100000\n"}, 2.5),
        ("/x", {"x/cpu.cfs_quota_us": "50000\n", "x/cpu.cfs_period_us": "50000\n"}, 1),
    ],
)
def test_the_quota_of_version_1_is_read(system, own, files, expected):
    files = {f"cpu,cpuacct/{name}": text for name, text in files.items()}
    assert system(V1.format(top="/"), OWN_V1.format(own=own), files) == expected


@pytest.mark.parametrize(("mounts", "groups"), [("", ""), ("nonsense", "0::/\n"), (V1, "no\n")])
def test_what_cannot_be_read_limits_nothing(system, mounts, groups):
    assert system(mounts, groups, {}) is None


def test_a_machine_without_control_groups_has_no_quota(tmp_path):
    assert processor_quota(tmp_path) is None


def test_the_affinity_counts():
    code = (
        "import os; from colift.benchmark.execution.processors import usable_processors;"
        "os.sched_setaffinity(0, [min(os.sched_getaffinity(0))]); print(usable_processors())"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "1\n"


def test_a_real_quota_counts():
    if usable_processors() < 2:
        pytest.skip("one processor")
    folder, limits = _group()
    try:
        for name, text in limits.items():
            (folder / name).write_text(text)
        code = (
            "from colift.benchmark.execution.processors import usable_processors as it;print(it())"
        )
        enter = f'echo 0 >"{folder}/cgroup.procs" && exec "$0" -c "$1"'
        done = subprocess.run(
            ["/bin/sh", "-c", enter, sys.executable, code], capture_output=True, text=True
        )
        assert done.stdout == "1\n", done.stderr
    finally:
        folder.rmdir()


def _group():
    """Return a new control group below the top one, and how to limit it to one processor."""
    name = f"colift-test-{os.getpid()}"
    for top, limits in (
        (Path("/sys/fs/cgroup/cpu"), {"cpu.cfs_period_us": "100000", "cpu.cfs_quota_us": "90000"}),
        (Path("/sys/fs/cgroup"), {"cpu.max": "90000 100000"}),
    ):
        folder = top / name
        try:
            folder.mkdir()
        except OSError:
            continue
        if all((folder / each).exists() for each in limits):
            return folder, limits
        folder.rmdir()
    pytest.skip("no control group can be made here")
