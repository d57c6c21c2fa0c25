"""What a machine without namespaces says, in one sentence with the cure."""

import os
import shutil
import subprocess
import sys

import pytest
from colift.agents.sandbox.host.levels import Choice
from colift.agents.sandbox.host.refusals import in_words

NO_SPACE = "user.max_user_namespaces"
APPARMOR = "kernel.apparmor_restrict_unprivileged_userns=0"
FORBIDDEN = "--security-opt seccomp=unconfined --security-opt systempaths=unconfined"
HIDDEN = "hides parts of /proc"


@pytest.mark.parametrize(
    ("reason", "cure"),
    [
        ("no namespaces by user: fault OSError: [Errno 28] unshare 0x30000000: No space", NO_SPACE),
        ("bwrap: Creating new namespace failed: No space left on device", NO_SPACE),
        (
            "no namespaces by root: [Errno 1] setns /proc/self/ns/pid: Operation not permitted; "
            "no namespaces by user: fault OSError: [Errno 28] unshare 0x30000000: No space left",
            NO_SPACE,
        ),
        ("no namespaces by user: fault PermissionError: [Errno 1] unshare 0x30000000", FORBIDDEN),
        ("bwrap: No permissions to create new namespace, likely because the kernel", FORBIDDEN),
        ("bwrap: loopback: Failed RTM_NEWADDR: Operation not permitted", FORBIDDEN),
        ("bwrap: Can't mount proc on /newroot/proc: Operation not permitted", HIDDEN),
        ("bwrap: setting up uid map: Permission denied", APPARMOR),
        ("no namespaces by user: fault PermissionError: [Errno 13] unshare", APPARMOR),
    ],
)
def test_a_refusal_of_namespaces_is_one_sentence_with_its_cure(reason, cure):
    told = in_words(reason)
    assert cure in told
    assert "docs/guides/sandbox.md" in told
    assert "Errno" not in told
    assert len(told) < 300


@pytest.mark.parametrize(
    "reason",
    [
        "bwrap is not installed",
        "the kernel has no Landlock",
        "cannot write: No space left on device",
    ],
)
def test_other_reasons_stay_as_they_are(reason):
    assert in_words(reason) == reason


def test_a_reason_of_several_levels_is_told_once():
    told = str(Choice(level="limits", passed={"bubblewrap": "no room", "landlock": "no room"}))
    assert told == "isolation limits; bubblewrap does not work here: no room; nor does landlock"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("walls", "cure"),
    [
        (["sh", "-c", 'echo 0 > /proc/sys/user/max_user_namespaces; exec "$@"', "sh"], NO_SPACE),
        (["sh", "-c", 'exec "$@"', "sh"], "user namespaces"),
    ],
)
def test_a_machine_without_namespaces_says_so(walls, cure):
    """In a user namespace of its own, which forbids others or has no rights."""
    rights = ["--map-root-user"] if cure == NO_SPACE else []
    command = ["unshare", "--user", *rights, *walls]
    if not shutil.which("unshare") or subprocess.run([*command, "true"], check=False).returncode:
        pytest.skip("needs user namespaces to make one without")
    ask = "from colift.agents.sandbox.host.levels import choose; print(choose())"
    done = subprocess.run(
        [*command, sys.executable, "-c", ask],
        capture_output=True,
        text=True,
        check=True,
        env=dict(os.environ),
    )
    assert done.stdout.startswith("isolation limits; ")
    assert cure in done.stdout
    assert "Errno" not in done.stdout
