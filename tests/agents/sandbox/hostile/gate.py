"""Policies that try to get past the gate, or to keep something in the process that is forked."""

from .policy import Hostile

_SERVER = "import colift.agents.sandbox.guest.server as server"

_LATE = {
    "x86_64": "57 b823000000 31f6 0f05 5f 488b4710 488b4f18 488908 31c0 c3",
    "aarch64": "e90300aa e1031faa a80c80d2 010000d4 2a0940f9 2b0d40f9 4b0100f9 e0031faa c0035fd6",
}
"""A thread that waits, changes eight bytes and ends: its code, as it shares Python with another."""

GATE = [
    Hostile(
        name="gate left open",
        top=f"{_SERVER}; server.install = lambda *arguments: 0",
        act="open(__file__); return [0.0]",
        reason="took more than .* to start|did not start in time",
    ),
    Hostile(
        name="gate of its own",
        top=f"""
        {_SERVER}
        from colift.agents.sandbox.guest import filters
        server.FORKING = server.LIFT = filters.LOADING
        """,
        act="open(__file__); return [0.0]",
        reason=r"ended its process \(exit code 0\)|did not start in time",
    ),
    Hostile(
        name="gate of nothing",
        reset="""
        import ctypes
        program = struct.pack("HBBI", 0x06, 0, 0, 0x7FFF0000)
        buffer = ctypes.create_string_buffer(program, 8)
        head = ctypes.create_string_buffer(struct.pack("HxxxxxxQ", 1, ctypes.addressof(buffer)))
        number = 317 if os.uname().machine == "x86_64" else 277
        denied(lambda: zero(libc().syscall(number, 1, 0, head)))
        """,
    ),
    Hostile(
        name="thread left behind",
        reset="threading.Thread(target=time.sleep, args=(600,), daemon=True).start()",
        reason="has a thread that still runs after its reset: .*",
    ),
    Hostile(name="process left behind", reset="os.fork()", reason="PermissionError: .*"),
    Hostile(
        name="process of a program left behind",
        reset="subprocess.Popen(['/bin/sleep', '600'])",
        reason="(PermissionError|FileNotFoundError): .*",
    ),
    Hostile(
        name="output into a file",
        reset="os.dup2(os.open('/tmp/kept', os.O_RDWR | os.O_CREAT), 1)",
        reason="has put other files in the place of its connection or its output .*",
        needs_namespaces="without namespaces, there is no /tmp",
    ),
    Hostile(
        name="file in the place of nothing",
        reset="os.dup2(os.open(__file__, os.O_RDONLY), 0)",
        reason="has put other files in the place of its connection or its output .*",
    ),
    Hostile(
        name="mapping of its own file",
        reset="""
        with open("/tmp/kept", "w+b") as file:
            file.truncate(1 << 20)
            self.kept = mmap.mmap(file.fileno(), 0, mmap.MAP_PRIVATE, mmap.PROT_READ)
        """,
        reason="has mapped a file that is not in its folder .*",
        needs_namespaces="without namespaces, there is no /tmp",
    ),
    Hostile(
        name="mapping that is shared",
        reset="denied(lambda: mmap.mmap(open(__file__).fileno(), 0, access=mmap.ACCESS_READ))",
    ),
    Hostile(
        name="files kept open",
        top="kept = open(__file__)",
        reset="self.pages = open('/usr/lib/os-release')",
    ),
    Hostile(
        name="forks more than a lift",
        top="""
        fork = os.fork
        def more():
            made = fork()
            if made:
                denied(fork)
                denied(fork)
            return made
        os.fork = more
        """,
        reason=r"did not start in time|could not be closed in .*|ended its process .*",
    ),
    Hostile(
        name="lift that shares memory with what it is forked from",
        top="""
        fork = os.fork
        def sharing():
            denied(lambda: zero(min(clone(0x100 | 0x4000 | signal.SIGCHLD, shared, 0), 0)))
            return fork()
        shared = libc()._exit
        os.fork = sharing
        """,
    ),
    Hostile(
        name="lift whose filter changes after it was read",
        top=f"""
        {_SERVER}
        from colift.agents.sandbox.guest.filters import LIFT
        installed = server.install
        content = LIFT.program()
        CODE = {_LATE}
        program = ctypes.create_string_buffer(content, len(content))
        head = struct.pack("HxxxxxxQ", len(content) // 8, ctypes.addressof(program))
        number = 317 if os.uname().machine == "x86_64" else 277

        # nanosleep(argument, NULL); *argument[2] = argument[3]; return
        code = mmap.mmap(-1, 4096, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS, 7)
        code.write(bytes.fromhex(CODE[os.uname().machine]))
        change = ctypes.addressof(ctypes.c_char.from_buffer(code))
        late = struct.pack("qqQHBBI", 0, 300_000_000, ctypes.addressof(program),
                           0x06, 0, 0, 0x7FFF0000)
        late = ctypes.create_string_buffer(late, len(late))

        def changing(due):
            if due is not LIFT:
                return installed(due)
            # A thread: it shares everything with the process that asks for the filter.
            zero(min(clone(0x50F00, ctypes.c_void_p(change), ctypes.addressof(late)), 0))
            zero(libc().syscall(number, 1, 0, head))

        server.install = changing
        """,
        act="os.dup2(1, 2); return [0.0]",
        reason=r"ended its process .*|did not start in time",
    ),
    Hostile(
        name="lift whose parent is what it is forked from",
        top="""
        fork, inside = os.fork, []
        def as_parent():
            if inside:
                return 0
            between = fork()
            if between == 0:
                os._exit(0)
            os.waitpid(between, 0)
            made = fork()
            if made == 0:
                inside.append(made)
            return made
        os.fork = as_parent
        """,
        reason=r"ended its process .*|did not start in time|could not be closed in .*",
    ),
    Hostile(
        name="keeps the connection of a lift",
        top="""
        close = os.close
        os.close = lambda number: None if number > 3 else close(number)
        """,
        reason=r"has put other files .*|did not start in time",
    ),
    Hostile(
        name="ends where lifts are forked from",
        top="""
        received = socket.recv_fds
        def ended(*arguments):
            received(*arguments)
            os._exit(5)
        socket.recv_fds = ended
        """,
        reason=r"ended its process \(exit code 5\)",
    ),
    Hostile(
        name="answers nobody where lifts are forked from",
        top="""
        received = socket.recv_fds
        def deaf(*arguments):
            received(*arguments)
            time.sleep(600)
        socket.recv_fds = deaf
        """,
        reason="did not start in time",
    ),
]
