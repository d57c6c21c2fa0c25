"""Systems that lack what only Linux, or only POSIX, has: all is imported there, and lifts played.

They are not at hand: a process takes away what they lack, once all libraries are loaded.
"""

import json
import subprocess
import sys

import colift
import pytest

pytestmark = pytest.mark.slow

ELSEWHERE = """
import ctypes, importlib, json, os, pkgutil, select, signal, socket, sys

import colift
names = [
    each.name for each in pkgutil.walk_packages(colift.__path__, "colift.")
    if not each.name.endswith("__main__") and ".migrations." not in each.name
]
for name in names:
    importlib.import_module(name)

for name in [name for name in sys.modules if name.partition(".")[0] == "colift"]:
    del sys.modules[name]
WINDOWS = SYSTEM == "win32"
LACKING = {
    os: "memfd_create pidfd_open O_PATH",
    socket: "MSG_NOSIGNAL",
    select: "epoll",
}
if WINDOWS:
    LACKING = {
        os: LACKING[os] + " fork getuid geteuid getgid getegid getpgid killpg setsid nice statvfs "
            "getloadavg uname O_NOFOLLOW O_NONBLOCK O_CLOEXEC O_DIRECTORY WNOHANG",
        signal: "SIGKILL SIGHUP SIGQUIT SIGCHLD SIGPIPE SIGUSR1 SIGALRM SIGXCPU SIGSTOP SIGCONT",
        socket: LACKING[socket] + " AF_UNIX SOCK_SEQPACKET MSG_DONTWAIT",
        select: LACKING[select] + " poll",
    }
    for name in ("fcntl", "grp", "pwd", "resource", "termios", "tty", "pty"):
        sys.modules[name] = None
for module, lacking in LACKING.items():
    for name in lacking.split():
        delattr(module, name)
for name in [name for name in dir(os) if name.startswith(("sched_", "SCHED_", "posix_"))]:
    delattr(os, name)
made = ctypes.CDLL.__init__

def no_handle_of_the_process(self, name, *arguments, **options):
    if name is None and WINDOWS:
        raise TypeError("argument of type 'NoneType' is not iterable")
    made(self, name, *arguments, **options)

def no_proc(event, arguments):
    if importing and event == "open" and str(arguments[0]).startswith("/proc"):
        raise FileNotFoundError(arguments[0])

ctypes.CDLL.__init__ = no_handle_of_the_process
sys.addaudithook(no_proc)
sys.platform = SYSTEM

importing, failed = True, {}
for name in names:
    try:
        importlib.import_module(name)
    except Exception as error:
        failed[name] = f"{type(error).__name__}: {error}"
importing = False
import colift
print(json.dumps([len(names), failed, failed or colift.evaluate("copy").rmse_mm]))
"""


@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_all_is_imported_and_a_policy_scored(system):
    program = ELSEWHERE.replace("SYSTEM", repr(system))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    count, failed, there = json.loads(done.stdout.splitlines()[-1])
    assert failed == {}
    assert count > 500
    assert there == colift.evaluate("copy").rmse_mm
