"""Policies that use up memory, processes, files or the disk."""

from .policy import LATE, MANY, MEMORY, Hostile

RESOURCES = [
    Hostile(
        name="memory bomb",
        act="bytearray(1 << 33)",
        reason="MemoryError",
    ),
    Hostile(
        name="memory bomb in pieces",
        act="kept = [bytearray(1 << 20) for _ in range(1000)]",
        reason=f"MemoryError|{MEMORY}",
    ),
    Hostile(
        name="shared memory",
        reset="""
        kept = [mmap.mmap(-1, 1 << 26) for _ in range(4)]
        for each in kept:
            each.write(b"x" * (1 << 26))
        """,
        reason="PermissionError: .*",
    ),
    Hostile(
        name="memory of files",
        reset="""
        for place in ("/tmp", "/dev/shm"):
            with open(place + "/big", "wb") as file:
                for _ in range(90):
                    file.write(bytes(1 << 20))
        time.sleep(60)
        """,
        reason=MEMORY,
        sparing=True,
        needs_namespaces="without a private /tmp only the size of each file is limited",
    ),
    Hostile(
        name="processor time of many threads",
        top="""
        def spin():
            while True: pass
        """,
        reset="""
        for _ in range(3): threading.Thread(target=spin, daemon=True).start()
        while True: time.sleep(1)
        """,
        reason=r"used more than 1 s of processor time",
        sparing=True,
    ),
    Hostile(
        name="processor time of a lift",
        act="while True: pass",
        reason=r"used more than 1 s of processor time",
        sparing=True,
    ),
    Hostile(
        name="memory of a lift",
        init="self.kept = []",
        act="""
        for _ in range(200): self.kept.append(b"x" * (1 << 20))
        time.sleep(60)
        """,
        reason=f"MemoryError|{MEMORY}",
    ),
    Hostile(
        name="thread bomb",
        reset="""
        # Small ones: else memory may run out before their number does.
        import _thread
        threading.stack_size(1 << 16)
        while True:
            _thread.start_new_thread(time.sleep, (60,))
        """,
        reason=rf"RuntimeError: can't start new thread|{MANY}",
    ),
    Hostile(
        name="2 GB file",
        reset="""
        with open(os.environ["TMPDIR"] + "/big", "wb") as file:
            for _ in range(2048):
                file.write(bytes(1 << 20))
        """,
        reason=r"OSError: \[Errno 2[78]\].*",
    ),
    Hostile(
        name="2 GB file by truncate",
        reset="""
        with open(os.environ["TMPDIR"] + "/big", "wb") as file:
            file.truncate(2 << 30)
        """,
        reason=r"OSError: \[Errno 27\].*",
    ),
    Hostile(
        name="many files",
        reset="""
        for number in range(4000):
            with open(os.environ["TMPDIR"] + f"/{number}", "wb") as file:
                file.write(bytes(1 << 16))
        """,
        reason=r"OSError: \[Errno 28\].*",
        needs_namespaces="without a private /tmp only the size of each file is limited",
    ),
    Hostile(
        name="many open files",
        reset="kept = [open('/dev/null') for _ in range(10_000)]",
        reason=r"OSError: \[Errno 24\].*",
    ),
    Hostile(
        name="memory without a process",
        act="denied(lambda: os.memfd_create('x')); return [0.0]",
    ),
    Hostile(
        name="flood of stdout", act="while True: print('x' * 100_000)", reason=LATE, output="x"
    ),
    Hostile(
        name="flood of stderr",
        act="while True: os.write(2, b'y' * 100_000)",
        reason=LATE,
        output="y",
    ),
    Hostile(
        name="flood, then act",
        act="os.write(1, b'z' * 200_000); return [0.0]",
        output="z",
    ),
]
