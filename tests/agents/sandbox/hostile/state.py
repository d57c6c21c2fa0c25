"""Policies that keep something from one episode to the next."""

from .policy import NUMBERS, Hostile

STATE = [
    Hostile(
        name="state in modules",
        act="""
        time.kept = getattr(time, "kept", 0) + 1
        self.count = getattr(self, "count", 0) + 1
        return [0.0 if time.kept == self.count else 0.01]
        """,
    ),
    Hostile(
        name="state in builtins",
        reset="""
        import builtins
        if hasattr(builtins, "kept"): raise Through("kept")
        builtins.kept = 1
        """,
    ),
    Hostile(
        name="state in the environment",
        reset="""
        if "KEPT" in os.environ: raise Through("kept")
        os.environ["KEPT"] = "1"
        """,
    ),
    Hostile(
        name="state in files",
        reset="""
        place = os.environ["TMPDIR"] + "/kept"
        if os.path.exists(place): raise Through("kept")
        touch(place)
        """,
    ),
    Hostile(
        name="state in shared memory",
        reset="""
        if os.path.exists("/dev/shm/kept"): raise Through("kept")
        try:
            touch("/dev/shm/kept")
        except PermissionError:
            pass
        """,
    ),
    Hostile(
        name="state in System V shared memory",
        reset="""
        shared = libc().shmget(4711, 4096, 0o1666)
        denied(lambda: zero(min(shared, 0)))
        """,
    ),
    Hostile(
        name="state in the keyring",
        reset="""
        added = libc().syscall(248 if os.uname().machine == "x86_64" else 217, b"user", b"kept",
                               b"1", 1, -3)
        denied(lambda: zero(min(added, 0)))
        """,
    ),
    Hostile(
        name="state in a process",
        reset="""
        try:
            seen = {int(name) for name in os.listdir("/proc") if name.isdigit()}
        except OSError:
            seen = set()
        if seen - {1, os.getpid()}: raise Through(str(seen))
        denied(os.fork)
        """,
    ),
    Hostile(
        name="patched numpy",
        reset="np.asarray = np.array = np.zeros = lambda *a, **k: 1 / 0",
        reason="ZeroDivisionError.*|" + NUMBERS + ".*",
    ),
    Hostile(
        name="patched time",
        reset="time.monotonic = time.perf_counter = time.time = lambda: 0.0",
    ),
    Hostile(
        name="patched random",
        reset="""
        import random
        np.random.default_rng = random.random = lambda *a: 1 / 0
        """,
    ),
]
