"""Policies that end, or seem to."""

from .policy import ENDED, LATE, Hostile

ENDS = [
    Hostile(name="exits", act="os._exit(3)", reason=r"ended its process \(exit code 3\)"),
    Hostile(name="exits on import", top="os._exit(0)", reason=ENDED),
    Hostile(
        name="segmentation fault",
        act="ctypes.string_at(0)",
        reason="its process was ended by SIGSEGV",
        output="Segmentation fault",
    ),
    Hostile(name="aborts", act="os.abort()", reason="its process was ended by SIG(ABRT|ILL|SEGV)"),
    Hostile(
        name="kills itself",
        reset="os.kill(os.getpid(), signal.SIGKILL)",
        reason="its process was ended by SIGKILL",
    ),
    Hostile(
        name="overflows the stack",
        act="sys.setrecursionlimit(10**9)\nf = lambda: f()\nf()",
        reason=f"RecursionError.*|MemoryError.*|its process was ended by SIGSEGV|{LATE}",
    ),
    Hostile(
        name="raises on import",
        top="raise ValueError('top')",
        reason=r".*ValueError: top \(raises_on_import.py, line \d+\)",
    ),
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
