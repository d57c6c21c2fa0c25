"""Hostile policies, as data: one more is one more entry.

Each is the source of a class ``Policy``. Those with a ``reason`` must end with it. Those without
must fail at what they try, without doing harm: they raise ``Through`` if they get through, and
otherwise act like the good policy.
"""

from dataclasses import dataclass
from textwrap import dedent, indent

HEAD = """
import ctypes, gc, os, signal, socket, stat, struct, subprocess, sys, threading, time
import numpy as np

class Through(Exception):
    pass

def denied(attempt):
    try:
        attempt()
    except (OSError, ImportError, subprocess.SubprocessError):
        return
    raise Through("got through")

def end():
    for handle in range(3, 64):
        try:
            if stat.S_ISSOCK(os.fstat(handle).st_mode):
                return handle
        except OSError:
            pass

def frame(content):
    import msgpack
    body = msgpack.packb(content)
    return struct.pack(">I", len(body)) + body

def libc():
    return ctypes.CDLL(None, use_errno=True)

def zero(result):
    if result != 0:
        raise OSError(ctypes.get_errno(), "refused")

def touch(path):
    with open(path, "w") as file:
        file.write("x")
"""

NO_WALLS = "resource limits do not hide files"
NO_NETWORK = "resource limits do not close the network"
NO_PROCESSES = "resource limits do not hide processes"
NO_FILTER = "resource limits do not filter system calls"
NO_COUNT = "without a user namespace, the superuser's processes are not counted by the kernel"


@dataclass(frozen=True, kw_only=True)
class Hostile:
    """A policy that does harm, or tries to."""

    name: str
    top: str = ""
    init: str = "pass"
    reset: str = "pass"
    act: str = "return [0.0]"
    more: str = ""
    reason: str = ""
    """Regular expression of the whole reason."""
    output: str = ""
    """Regular expression that is found in the output."""
    needs_walls: str = ""
    """Why resource limits alone cannot contain it."""
    needs_namespaces: str = ""
    """Why Landlock alone cannot contain it either."""

    @property
    def escapes(self):
        """The ways of isolation that cannot contain it."""
        both = ("limits", "landlock alone")
        return both if self.needs_namespaces else both[:1] if self.needs_walls else ()

    @property
    def needs(self):
        """Why they cannot."""
        return self.needs_namespaces or self.needs_walls

    @property
    def hurried(self):
        """Whether it is a budget of time that stops it."""
        return "within" in self.reason or "took more" in self.reason

    def source(self, **values):
        """Return the file; ``@name@`` stands for a value."""
        body = "\n".join(
            [
                "class Policy:",
                indent(f"def __init__(self):\n{indent(dedent(self.init), '    ')}", "    "),
                indent(f"def reset(self, seed):\n{indent(dedent(self.reset), '    ')}", "    "),
                indent(f"def act(self, observation):\n{indent(dedent(self.act), '    ')}", "    "),
                indent(dedent(self.more), "    "),
            ]
        )
        text = f"{HEAD}\n{dedent(self.top)}\n{body}\n"
        for name, value in values.items():
            text = text.replace(f"@{name}@", str(value))
        return text


ENDED = r"ended its process \(exit code \d+\)"
LATE = r"no answer within 0.3 s"
MANY = r"had more than 24 processes and threads"
MEMORY = r"used more than 150 MiB of memory"
NO_ACTION = r"sent an action that is not 1 finite number\(s\)"
NUMBERS = r"robot's action must be 1 number\(s\), got "

TIME = [
    Hostile(name="infinite loop", act="while True: pass", reason=LATE),
    Hostile(name="sleep", act="time.sleep(60)", reason=LATE),
    Hostile(name="sleep in reset", reset="time.sleep(60)", reason="no answer within 2 s"),
    Hostile(name="sleep on import", top="time.sleep(60)", reason="no answer within 2 s"),
    Hostile(name="stops itself", act="os.kill(os.getpid(), signal.SIGSTOP)", reason=LATE),
    Hostile(
        name="deaf to signals",
        act="""
        for number in set(signal.Signals) - {signal.SIGKILL, signal.SIGSTOP}:
            signal.signal(number, signal.SIG_IGN)
        while True: pass
        """,
        reason=LATE,
    ),
    Hostile(
        name="slow in all",
        act="time.sleep(0.1); return [0.0]",
        reason="took more than 3 s in all",
    ),
    Hostile(
        name="burns processor time",
        top="signal.signal(signal.SIGXCPU, signal.SIG_DFL)",
        act="while time.process_time() < 30: pass",
        reason=LATE,
    ),
]

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
        name="memory of many processes",
        act="""
        for _ in range(4):
            if os.fork() == 0:
                kept = b"x" * (60 << 20)
                time.sleep(60)
        time.sleep(60)
        """,
        reason=MEMORY,
    ),
    Hostile(
        name="memory that hides",
        act="""
        for _ in range(4):
            if os.fork() == 0:
                libc().prctl(4, 0, 0, 0, 0)
                kept = b"x" * (60 << 20)
                time.sleep(60)
        time.sleep(60)
        """,
        reason=MEMORY,
    ),
    Hostile(
        name="shared memory",
        act="""
        import mmap
        kept = [mmap.mmap(-1, 1 << 26) for _ in range(4)]
        for each in kept:
            each.write(b"x" * (1 << 26))
        """,
        reason=f"MemoryError|OSError: .*|{MEMORY}",
    ),
    Hostile(
        name="many processes",
        act="""
        for _ in range(500):
            if os.fork() == 0:
                time.sleep(60)
        time.sleep(60)
        """,
        reason=rf"BlockingIOError: .*|{MANY}",
    ),
    Hostile(
        name="fork bomb",
        act="""
        while True:
            try:
                os.fork()
            except OSError:
                pass
        """,
        reason=f"{LATE}|{MANY}|more than one answer to a request",
        needs_namespaces=NO_COUNT,
    ),
    Hostile(
        name="thread bomb",
        act="""
        while True:
            threading.Thread(target=time.sleep, args=(60,), daemon=True).start()
        """,
        reason=rf"RuntimeError: can't start new thread|{MANY}",
    ),
    Hostile(
        name="2 GB file",
        act="""
        with open(os.environ["TMPDIR"] + "/big", "wb") as file:
            for _ in range(2048):
                file.write(bytes(1 << 20))
        """,
        reason=r"OSError: \[Errno 2[78]\].*",
    ),
    Hostile(
        name="2 GB file by truncate",
        act="""
        with open(os.environ["TMPDIR"] + "/big", "wb") as file:
            file.truncate(2 << 30)
        """,
        reason=r"OSError: \[Errno 27\].*",
    ),
    Hostile(
        name="many files",
        act="""
        for number in range(4000):
            with open(os.environ["TMPDIR"] + f"/{number}", "wb") as file:
                file.write(bytes(1 << 16))
        """,
        reason=r"OSError: \[Errno 28\].*",
        needs_namespaces="without a private /tmp only the size of each file is limited",
    ),
    Hostile(
        name="many open files",
        act="kept = [open('/dev/null') for _ in range(10_000)]",
        reason=r"OSError: \[Errno 24\].*",
    ),
    Hostile(
        name="memory without a process",
        act="denied(lambda: os.memfd_create('x')); return [0.0]",
        needs_walls=NO_FILTER,
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

ENDS = [
    Hostile(name="exits", act="os._exit(3)", reason=r"ended its process \(exit code 3\)"),
    Hostile(name="exits on import", top="os._exit(0)", reason=ENDED),
    Hostile(
        name="segmentation fault",
        act="ctypes.string_at(0)",
        reason="its process was ended by SIGSEGV",
        output="Segmentation fault",
    ),
    Hostile(name="aborts", act="os.abort()", reason="its process was ended by SIGABRT"),
    Hostile(
        name="kills itself",
        act="os.kill(os.getpid(), signal.SIGKILL)",
        reason="its process was ended by SIGKILL",
    ),
    Hostile(
        name="overflows the stack",
        act="sys.setrecursionlimit(10**9)\nf = lambda: f()\nf()",
        reason=f"RecursionError.*|MemoryError.*|its process was ended by SIGSEGV|{LATE}",
    ),
    Hostile(
        name="daemon left behind",
        reset="""
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                os.closerange(0, 64)
                while True: time.sleep(1)
            os._exit(0)
        """,
    ),
    Hostile(
        name="daemon holds the connection",
        act="""
        if os.fork() == 0:
            os.setsid()
            while True: time.sleep(1)
        os._exit(0)
        """,
        reason=ENDED,
    ),
    Hostile(name="raises on import", top="raise ValueError('top')", reason=".*ValueError: top"),
    Hostile(name="raises in init", init="raise ValueError('x')", reason="ValueError: x"),
    Hostile(name="raises in reset", reset="raise ValueError('x')", reason="ValueError: x"),
    Hostile(
        name="raises in act",
        act="raise ValueError('x')",
        reason="ValueError: x",
        output="Traceback",
    ),
    Hostile(name="system exit", act="sys.exit('bye')", reason="SystemExit: bye"),
    Hostile(name="interrupt", act="raise KeyboardInterrupt", reason="KeyboardInterrupt"),
    Hostile(
        name="error that cannot be shown",
        top="""
        class Bad(BaseException):
            def __str__(self): raise Bad()
            __repr__ = __str__
        """,
        act="raise Bad()",
        reason="Bad",
    ),
    Hostile(
        name="error that is endless",
        act="raise ValueError('x' * 10_000_000)",
        reason="ValueError: x{400,500}",
    ),
    Hostile(
        name="error that paints",
        act=r"raise ValueError('\x1b[31mred\x1b[0m\r\x00\x9b')",
        reason="ValueError: red",
    ),
    Hostile(name="no class", top="del os\n", more="x = 1 / 0", reason=".*ZeroDivisionError.*"),
]

ACTIONS = [
    Hostile(name="NaN", act="return [float('nan')]", reason="robot's action must be finite, .*"),
    Hostile(name="infinity", act="return [np.inf]", reason="robot's action must be finite, .*"),
    Hostile(name="none", act="return None", reason=NUMBERS + "None"),
    Hostile(name="text", act="return 'up'", reason=NUMBERS + "'up'"),
    Hostile(name="number as text", act="return '0.01'", reason=NUMBERS + "'0.01'"),
    Hostile(name="huge array", act="return np.zeros(10_000_000)", reason=NUMBERS + "array.*"),
    Hostile(name="endless list", act="return [0.0] * 10**6", reason=NUMBERS + r"\[0.0.*"),
    Hostile(name="wrong shape", act="return np.zeros((1, 1))", reason=NUMBERS + ".*"),
    Hostile(name="too many", act="return [0.0, 0.0]", reason=NUMBERS + r"\[0.0, 0.0\]"),
    Hostile(name="too few", act="return []", reason=NUMBERS + r"\[\]"),
    Hostile(name="complex", act="return [1j]", reason=NUMBERS + ".*"),
    Hostile(
        name="hostile __array__",
        top="""
        class Bad:
            def __array__(self, *arguments, **keywords): raise KeyError("no")
            def __repr__(self): raise KeyError("no")
        """,
        act="return Bad()",
        reason=NUMBERS + "a Bad that cannot be shown",
    ),
    Hostile(
        name="__array__ without end",
        top="""
        class Bad:
            def __array__(self, *arguments, **keywords):
                while True: pass
        """,
        act="return Bad()",
        reason=LATE,
    ),
    Hostile(
        name="hostile __float__",
        top="""
        class Bad:
            def __float__(self): os._exit(9)
        """,
        act="return [Bad()]",
        reason=r"ended its process \(exit code 9\)",
    ),
    Hostile(
        name="array of objects",
        act="return np.array([object()])",
        reason=NUMBERS + ".*",
    ),
    Hostile(
        name="internals that are none",
        more="def internals(self): return None",
        reason="TypeError: .*",
    ),
    Hostile(
        name="internals without end",
        more="def internals(self): return {str(i): 0.0 for i in range(10**5)}",
        reason="ValueError: more than 64 internals.*",
    ),
    Hostile(
        name="infinite internals",
        more="def internals(self): return {'role': float('inf')}",
        reason="its internals are not names and finite numbers",
    ),
    Hostile(
        name="internals that raise",
        more="def internals(self): raise ValueError('inside')",
        reason="ValueError: inside",
    ),
]

FRAMES = [
    Hostile(
        name="malformed frame",
        act="os.write(end(), struct.pack('>I', 4) + bytes([0xC1] * 4)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without a list",
        act="os.write(end(), frame(7)); time.sleep(60)",
        reason="a int instead of a list",
    ),
    Hostile(
        name="frame with a map",
        act="os.write(end(), frame([1, {'a': 1}])); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame without end inside",
        act="os.write(end(), struct.pack('>I', 60_000) + bytes([0x91] * 60_000)); time.sleep(60)",
        reason=r"not msgpack \(.*\)",
    ),
    Hostile(
        name="frame of other things",
        act="os.write(end(), frame([[], []])); time.sleep(60)",
        reason="an answer that is not serial number, word and content",
    ),
    Hostile(
        name="oversized frame",
        act="os.write(end(), struct.pack('>I', 1 << 31)); time.sleep(60)",
        reason="a message of 2147483648 bytes; at most 65536 are allowed",
    ),
    Hostile(
        name="truncated frame",
        act="os.write(end(), struct.pack('>I', 100) + bytes(10)); time.sleep(60)",
        reason="sent 14 bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="truncated frame, then closed",
        act="os.write(end(), struct.pack('>I', 100) + bytes(10)); os.close(end()); time.sleep(60)",
        reason="sent 14 bytes of an answer, then no more",
    ),
    Hostile(
        name="closed connection",
        act="os.close(end()); time.sleep(60)",
        reason="closed the connection",
    ),
    Hostile(
        name="connection found by gc",
        act="""
        for each in gc.get_objects():
            if isinstance(each, socket.socket):
                each.shutdown(socket.SHUT_RDWR)
        time.sleep(60)
        """,
        reason=f"closed the connection|{ENDED}",
    ),
    Hostile(
        name="duplicated frame",
        act="os.write(end(), 2 * frame([3, 'action', [0.0]])); time.sleep(60)",
        reason="more than one answer to a request",
    ),
    Hostile(
        name="answer before the answer",
        act="os.write(end(), frame([3, 'action', [0.0]])); return [0.0]",
        reason=r"more than one answer to a request|answer 3 to request 4",
    ),
    Hostile(
        name="late frame",
        top="""
        def late():
            time.sleep(0.1)
            os.write(end(), frame([3, "action", [0.0]]))
        """,
        act="""
        if not hasattr(self, "sent"):
            self.sent = threading.Thread(target=late)
            self.sent.start()
        else:
            time.sleep(0.3)
        return [0.0]
        """,
        reason="answer 3 to request 4",
    ),
    Hostile(
        name="early frame",
        act="os.write(end(), frame([4, 'action', [0.0]])); time.sleep(60)",
        reason="answer 4 to request 3",
    ),
    Hostile(
        name="flood of frames",
        act="while True: os.write(end(), frame([3, 'action', [0.0]]))",
        reason="more than one answer to a request|answer 3 to request 4",
    ),
    Hostile(
        name="words instead of numbers",
        act="os.write(end(), frame([3, 'action', ['up']])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer without numbers",
        act="os.write(end(), frame([3, 'action'])); time.sleep(60)",
        reason=NO_ACTION,
    ),
    Hostile(
        name="answer in drops",
        act="""
        for byte in struct.pack(">I", 60_000) + bytes(60_000):
            os.write(end(), bytes([byte]))
            time.sleep(0.01)
        """,
        reason=r"sent \d+ bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="another answer",
        act="os.write(end(), frame([3, 'made', True])); time.sleep(60)",
        reason="answered 'made' where 'action' was due",
    ),
    Hostile(
        name="a reason that is none",
        act="os.write(end(), frame([3, 'failed', ['x'] * 1000])); time.sleep(60)",
        reason="answered 'failed' where 'action' was due",
    ),
    Hostile(
        name="files sent along",
        act="""
        ours = socket.socket(fileno=os.dup(end()))
        for _ in range(3):
            socket.send_fds(ours, [b"\\0"], [0] * 30)
        time.sleep(60)
        """,
        reason="sent 3 bytes of an answer, then no more within 0.3 s",
    ),
    Hostile(
        name="check taken out",
        top="import colift.agents.isolation.server as server",
        act="server.checked_action = lambda *arguments: [float('nan')]; return [0.0]",
        reason=NO_ACTION,
    ),
]

SECRETS = [
    Hostile(name="board's secret", reset="denied(lambda: open('@secret@').read())"),
    Hostile(name="other submission", reset="denied(lambda: open('@other@').read())"),
    Hostile(
        name="other submissions",
        reset="""
        try:
            seen = os.listdir("@board@")
        except OSError:
            seen = []
        if set(seen) - {"mine"}: raise Through(str(seen))
        """,
    ),
    Hostile(name="suite's seeds", reset="denied(lambda: open('@suite@').read())"),
    Hostile(name="shadow", reset="denied(lambda: open('/etc/shadow').read())"),
    Hostile(name="disk", reset="denied(lambda: os.listdir('/var'))"),
    Hostile(
        name="write beside",
        # In a private /tmp it may: what it writes there is gone, as the files outside show.
        reset="""
        try:
            touch("@board@/written")
        except OSError:
            pass
        """,
    ),
    Hostile(name="write into its folder", reset="denied(lambda: touch('written'))"),
    Hostile(name="write into the system", reset="denied(lambda: touch('/usr/lib/written'))"),
    Hostile(
        name="link out of its folder",
        reset="""
        link = os.environ["TMPDIR"] + "/link"
        os.symlink("@secret@", link)
        denied(lambda: open(link).read())
        denied(lambda: open("../secret").read())
        denied(lambda: open("../other/policy.py").read())
        """,
    ),
    Hostile(
        name="folder of who scores",
        reset="denied(lambda: os.listdir('/proc/@process@/cwd'))",
    ),
    Hostile(name="write into packages", reset="denied(lambda: touch(np.__file__))"),
    Hostile(name="change itself", reset="denied(lambda: open(__file__, 'a'))"),
    Hostile(
        name="rewrite the kernel",
        reset="denied(lambda: os.open('/proc/sys/kernel/core_pattern', os.O_WRONLY))",
    ),
]
SECRETS = [Hostile(**{**vars(each), "needs_walls": NO_WALLS}) for each in SECRETS]

OTHERS = [
    Hostile(
        name="environment of others",
        reset="denied(lambda: open('/proc/@process@/environ').read())",
        needs_walls=NO_PROCESSES,
    ),
    Hostile(
        name="memory of others",
        reset="denied(lambda: open('/proc/@process@/mem', 'rb').read(1))",
        needs_walls=NO_PROCESSES,
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
        needs_walls=NO_PROCESSES,
    ),
    Hostile(
        name="memory through the kernel",
        top="""
        def peek():
            size = libc().process_vm_readv(os.getppid(), None, 0, None, 0, 0)
            zero(min(size, 0))
        """,
        reset="denied(peek)",
        needs_walls=NO_FILTER,
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
        needs_walls=NO_PROCESSES,
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
        needs_walls=NO_PROCESSES,
    ),
    Hostile(
        name="trace",
        reset="denied(lambda: zero(libc().ptrace(16, os.getppid(), None, None)))",
        needs_walls=NO_FILTER,
    ),
    Hostile(
        name="user namespace",
        reset="denied(lambda: zero(libc().unshare(0x10000000)))",
        needs_walls=NO_FILTER,
    ),
    Hostile(
        name="mount",
        reset="denied(lambda: zero(libc().mount(b'x', b'/tmp', b'tmpfs', 0, None)))",
        needs_walls=NO_FILTER,
    ),
    Hostile(
        name="TCP to loopback",
        reset="denied(lambda: socket.create_connection(('127.0.0.1', @port@), 0.3))",
        needs_walls=NO_NETWORK,
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
        needs_walls=NO_NETWORK,
    ),
    Hostile(
        name="socket of who scores",
        top="""
        def connect():
            socket.socket(socket.AF_UNIX).connect("\\0@abstract@")
        """,
        reset="denied(connect)",
        needs_walls=NO_NETWORK,
    ),
    Hostile(name="imports the benchmark", reset="denied(lambda: __import__('colift.benchmark'))"),
    Hostile(
        name="imports humans",
        reset="denied(lambda: __import__('colift.agents.humans.plan'))",
        needs_walls=NO_WALLS,
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
        reset="denied(lambda: __import__('colift.benchmark.seeding'))",
    ),
    Hostile(
        name="finds colift's sources",
        reset="""
        import colift.agents
        root = os.path.dirname(os.path.dirname(colift.agents.__file__))
        for place in ("benchmark", "leaderboard", "cli", "agents/humans"):
            try:
                seen = os.listdir(f"{root}/{place}")
            except OSError:
                continue
            if seen: raise Through(f"{place}: {seen}")
        """,
        needs_walls=NO_WALLS,
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
        needs_walls=NO_FILTER,
    ),
]

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
        needs_walls=NO_WALLS,
    ),
    Hostile(
        name="state in System V shared memory",
        reset="""
        shared = libc().shmget(4711, 4096, 0o1666)
        denied(lambda: zero(min(shared, 0)))
        """,
        needs_walls=NO_FILTER,
    ),
    Hostile(
        name="state in the keyring",
        reset="""
        added = libc().syscall(248 if os.uname().machine == "x86_64" else 217, b"user", b"kept",
                               b"1", 1, -3)
        denied(lambda: zero(min(added, 0)))
        """,
        needs_walls=NO_FILTER,
    ),
    Hostile(
        name="state in a process",
        top="""
        def found():
            place = "\\0kept"
            try:
                socket.socket(socket.AF_UNIX).connect(place)
                return True
            except OSError:
                return False
        """,
        reset="""
        if found(): raise Through("kept")
        if os.fork() == 0:
            os.setsid()
            listening = socket.socket(socket.AF_UNIX)
            listening.bind("\\0kept")
            listening.listen()
            time.sleep(60)
        while not found(): time.sleep(0.01)
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

WALLED = [*TIME, *RESOURCES, *ENDS, *SECRETS, *OTHERS, *STATE]
"""What the walls must contain."""

ANSWERS = [*ACTIONS, *FRAMES]
"""What the scoring side must refuse, whatever the walls."""
