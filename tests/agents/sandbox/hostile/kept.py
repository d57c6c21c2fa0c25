"""Policies that keep something beyond a lift where no file, process or object is left behind.

Each of them gets through where there is no filter, no Landlock and no own root directory: see the
test of that.
"""

from .policy import Hostile

KEPT = [
    Hostile(
        name="state in the page cache",
        top="""
        import pydoc_data
        place = os.path.join(os.path.dirname(pydoc_data.__file__), "topics.py")
        """,
        reset="""
        with open(place, "rb") as file:
            try:
                os.preadv(file.fileno(), [bytearray(1)], 1 << 17, os.RWF_NOWAIT)
            except BlockingIOError:
                raise Through("kept")
            except PermissionError:
                pass
            denied(lambda: os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED))
        """,
    ),
    Hostile(
        name="state in what is in memory",
        reset="""
        number = 27 if os.uname().machine == "x86_64" else 232
        denied(lambda: zero(libc().syscall(number, None, 0, bytes(8))))
        """,
    ),
    Hostile(
        name="state in attributes",
        reset="""
        for place in shared:
            try:
                os.setxattr(place, "user.kept", b"1")
            except OSError:
                continue
            os.removexattr(place, "user.kept")
            raise Through(place)
        """,
        top="shared = ['/', '/dev', '/usr', '/etc', os.path.dirname(__file__), __file__]",
    ),
    Hostile(
        name="state in times",
        reset="""
        for place in shared:
            status = os.stat(place)
            denied(lambda: os.utime(place, ns=(status.st_atime_ns, status.st_mtime_ns)))
        """,
        top="shared = ['/', '/dev', '/usr', '/etc', os.path.dirname(__file__), __file__]",
    ),
    Hostile(
        name="state in rights",
        reset="""
        for place in shared:
            mode = stat.S_IMODE(os.stat(place).st_mode)
            denied(lambda: os.chmod(place, mode))
            denied(lambda: os.chown(place, -1, -1))
        """,
        top="shared = ['/', '/dev', '/usr', '/etc', os.path.dirname(__file__), __file__]",
    ),
    Hostile(
        name="state in times of last access",
        # The time is old at first: see the board of the test.
        reset="""
        place = os.path.join(os.path.dirname(__file__), "accessed")
        if os.stat(place).st_atime != 1: raise Through("kept")
        open(place).read()
        """,
        needs_namespaces="without namespaces, a file that is read notes when",
    ),
    Hostile(
        name="state in times of last access of folders",
        reset="""
        before = os.stat("/dev").st_atime_ns
        os.listdir("/dev")
        if os.stat("/dev").st_atime_ns != before: raise Through("kept")
        """,
        needs_namespaces="without namespaces, a folder that is read notes when",
    ),
    Hostile(
        name="state in locks",
        reset="""
        import fcntl
        with open(sys.executable or __file__, "rb") as file:
            denied(lambda: fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB))
            denied(lambda: fcntl.lockf(file, fcntl.LOCK_SH | fcntl.LOCK_NB))
            denied(lambda: fcntl.fcntl(file, 1024, fcntl.F_RDLCK))
        """,
    ),
    Hostile(
        name="counters of the kernel",
        reset="""
        denied(lambda: open("/proc/stat").read())
        denied(lambda: open("/proc/loadavg").read())
        denied(lambda: os.fstat(os.pidfd_open(os.getpid())).st_ino)
        ours = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM, 0, os.dup(WIRE))
        denied(lambda: ours.getsockopt(socket.SOL_SOCKET, 57))
        """,
    ),
    Hostile(
        name="age of the root directory",
        top="loaded = time.time()",
        reset="""
        if os.stat("/").st_ctime < loaded - 30: raise Through("old")
        """,
        needs_namespaces="without namespaces, the root directory is the machine's",
    ),
    Hostile(
        name="pages that no process has",
        reset="""
        kept = mmap.mmap(-1, 300 << 20)
        for _ in range(300):
            kept.write(b"x" * (1 << 20))
            kept.madvise(mmap.MADV_DONTNEED)
        """,
        reason="PermissionError: .*",
    ),
    Hostile(
        name="pages of the zero device",
        reset="""
        handle = os.open("/dev/zero", os.O_RDWR)
        kept = mmap.mmap(handle, 300 << 20)
        """,
        reason="(PermissionError|FileNotFoundError): .*",
    ),
    Hostile(
        name="memory in sockets",
        reset="""
        kept = [socket.socketpair() for _ in range(20)]
        """,
        reason="PermissionError: .*",
    ),
    Hostile(
        name="sockets in the file system",
        reset="denied(lambda: connect('@local@'))",
    ),
    Hostile(
        name="all processors",
        reset="""
        denied(lambda: os.sched_setaffinity(0, range(@processors@)))
        if len(os.sched_getaffinity(0)) != 1: raise Through(str(os.sched_getaffinity(0)))
        """,
    ),
    Hostile(name="priority", reset="denied(lambda: os.nice(5))"),
    Hostile(
        name="programs",
        reset="denied(lambda: os.execv('/bin/true', ['true']))",
    ),
    Hostile(
        name="terminals",
        reset="denied(lambda: os.open('/dev/ptmx', os.O_RDONLY))",
    ),
]
