"""Policies that try to get past the gate, or to keep something in the process that is forked."""

from .policy import Hostile

_SERVER = "import colift.agents.sandbox.guest.server as server"

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
