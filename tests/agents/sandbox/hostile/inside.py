"""Policies that have seen a lift, and try to leave or to find something: each way is refused."""

from .policy import REFUSED, Hostile


def _inside(name, act, **more):
    return Hostile(name=f"in a lift, {name}", act=act, reason=REFUSED, **more)


INSIDE = [
    _inside("a file is read", "open(__file__).read()"),
    _inside(
        "a page is read",
        "os.pread(self.file.fileno(), 1, 0)",
        init="self.file = open(__file__)",
    ),
    _inside("a file is written", "open('/tmp/kept', 'w')"),
    _inside("a name is asked for", "os.stat('/usr/lib/missing')"),
    _inside("a link is read", "os.readlink('/proc/self/exe')"),
    _inside("a folder is listed", "os.listdir('/')"),
    _inside("a module is imported", "import smtplib"),
    _inside("a pipe is made", "os.pipe()"),
    _inside("a process is made", "os.fork()"),
    _inside("a program is run", "subprocess.run(['/bin/true'])"),
    _inside("a thread is made", "threading.Thread(target=int).start()"),
    _inside("a socket is made", "socket.socket(socket.AF_UNIX)"),
    _inside("its memory is read through /proc", "open('/proc/self/smaps').read()"),
    _inside("resources are read", "resource.getrusage(0)", top="import resource"),
    _inside("memory is shared", "mmap.mmap(-1, 4096)"),
    _inside("its processors are asked for", "os.sched_getaffinity(0)"),
    _inside("a clock of others is read", "time.clock_gettime(~1 << 3 | 2)"),
    _inside("a timer is set", "signal.setitimer(signal.ITIMER_REAL, 1)"),
    _inside("a signal is sent", "os.kill(os.getppid(), 0)"),
    _inside("another file is written", "os.write(0, b'x')"),
    _inside(
        "others are woken",
        "zero(min(ctypes.CDLL(None, use_errno=True).syscall(NUMBER, bytes(8), 1, 1, 0, 0, 0), 0))",
        top="NUMBER = {'x86_64': 202, 'aarch64': 98}[os.uname().machine]",
    ),
]
