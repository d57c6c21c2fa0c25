"""Policies that turn on other processes, the network and the kernel."""

from .policy import Hostile

OTHERS = [
    Hostile(
        name="environment of others",
        reset="denied(lambda: open('/proc/@process@/environ').read())",
    ),
    Hostile(
        name="memory of others",
        reset="denied(lambda: open('/proc/@process@/mem', 'rb').read(1))",
    ),
    Hostile(
        name="environment of who watches",
        reset="""
        denied(lambda: open(f'/proc/{os.getppid()}/environ').read())
        denied(lambda: open(f'/proc/{os.getppid()}/mem', 'rb').read(1))
        for number in range(16):
            denied(lambda: os.readlink(f'/proc/{os.getppid()}/fd/{number}'))
            denied(lambda: open(f'/proc/{os.getppid()}/fd/{number}', 'wb'))
        """,
    ),
    Hostile(
        name="memory through the kernel",
        top="""
        def peek():
            size = libc().process_vm_readv(os.getppid(), None, 0, None, 0, 0)
            zero(min(size, 0))
        """,
        reset="denied(peek)",
    ),
    Hostile(
        name="environment",
        reset="""
        if set(os.environ) & {"COLIFT_SECRET", "PYTHONPATH", "VIRTUAL_ENV", "USER"}:
            raise Through(str(set(os.environ)))
        """,
    ),
    Hostile(
        name="signal to who scores",
        reset="denied(lambda: os.kill(@process@, 0))",
    ),
    Hostile(
        name="signal to who watches",
        reset="""
        watcher = os.getppid()
        for number in (signal.SIGSTOP, signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            try:
                os.kill(watcher, number)
            except PermissionError:
                pass
        time.sleep(0.1)
        if os.getppid() != watcher:
            raise Through("the watcher is gone")
        """,
    ),
    Hostile(
        name="trace",
        reset="denied(lambda: zero(libc().ptrace(16, os.getppid(), None, None)))",
    ),
    Hostile(
        name="user namespace",
        reset="denied(lambda: zero(libc().unshare(0x10000000)))",
    ),
    Hostile(
        name="mount",
        reset="denied(lambda: zero(libc().mount(b'x', b'/tmp', b'tmpfs', 0, None)))",
    ),
    Hostile(
        name="TCP to loopback",
        reset="denied(lambda: socket.create_connection(('127.0.0.1', @port@), 0.3))",
    ),
    Hostile(
        name="TCP out",
        reset="denied(lambda: socket.create_connection(('192.0.2.1', 80), 0.3))",
    ),
    Hostile(
        name="UDP",
        top="""
        def send():
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b"x", ("127.0.0.1", @port@))
        """,
        reset="denied(send)",
    ),
    Hostile(
        name="socket of who scores",
        reset="denied(lambda: connect('\\0@abstract@'))",
    ),
    Hostile(name="imports the benchmark", reset="denied(lambda: __import__('colift.benchmark'))"),
    Hostile(
        name="imports humans",
        reset="denied(lambda: __import__('colift.agents.humans.plan'))",
    ),
    Hostile(name="imports the board", reset="denied(lambda: __import__('colift.leaderboard'))"),
    Hostile(
        name="rebuilds generators",
        reset="""
        found = [each for each in gc.get_objects() if isinstance(each, np.random.Generator)]
        entropy = np.random.default_rng(seed).bit_generator.seed_seq.entropy
        if found or entropy != seed:
            raise Through(f"{found} {entropy}")
        """,
    ),
    Hostile(
        name="imports the scenario's seeds",
        reset="denied(lambda: __import__('colift.benchmark.episode.seeding'))",
    ),
    Hostile(
        name="finds colift's sources",
        reset="""
        import colift.agents
        root = os.path.dirname(os.path.dirname(colift.agents.__file__))
        for place in ("benchmark", "leaderboard", "play", "cli", "robots", "agents/humans"):
            try:
                seen = os.listdir(f"{root}/{place}")
            except OSError:
                continue
            if seen: raise Through(f"{place}: {seen}")
        """,
    ),
    Hostile(
        name="more rights to itself",
        top="""
        import resource
        def raised():
            hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
            try:
                resource.setrlimit(resource.RLIMIT_DATA, (hard, 2 * hard))
            except ValueError as error:
                raise OSError(error)
        """,
        reset="denied(raised); denied(lambda: os.setuid(0) or open('/etc/shadow'))",
    ),
]
