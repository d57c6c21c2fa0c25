"""What a hostile policy is: data, so that one more is one more entry of a list beside.

Each is the source of a class ``Policy``. Those with a ``reason`` must end with it. Those without
must fail at what they try, without doing harm: they raise ``Through`` if they get through, and
otherwise act like the good policy.
"""

from dataclasses import dataclass
from textwrap import dedent, indent

HEAD = """
import ctypes, gc, mmap, os, signal, socket, stat, struct, subprocess, sys, threading, time
import msgpack
import numpy as np

class Through(Exception):
    pass

def denied(attempt):
    try:
        attempt()
    except (OSError, ImportError, subprocess.SubprocessError):
        return
    raise Through("got through")

WIRE = 3

def send(data):
    data = bytes(data)
    if ctypes.CDLL(None).send(WIRE, data, len(data), 0x4000) != len(data):
        raise OSError("not sent")

def connect(address):
    socket.socket(socket.AF_UNIX).connect(address)

def frame(content):
    body = msgpack.packb(content)
    return struct.pack(">I", len(body)) + body

def libc():
    return ctypes.CDLL(None, use_errno=True)

def zero(result):
    if result != 0:
        raise OSError(ctypes.get_errno(), "refused")

stack = mmap.mmap(-1, 1 << 20, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)

def clone(flags, function, argument):
    top = ctypes.addressof(ctypes.c_char.from_buffer(stack)) + len(stack)
    return libc().clone(function, ctypes.c_void_p(top), flags, ctypes.c_void_p(argument))

def touch(path):
    with open(path, "w") as file:
        file.write("x")
"""


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
    sparing: bool = False
    """Whether it has little processor time, and room for files."""
    needs_namespaces: str = ""
    """Why it cannot be contained without namespaces."""

    @property
    def hurried(self):
        """Whether it is a budget of time that stops it."""
        return any(word in self.reason for word in ("within", "took more", "in time"))

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


REFUSED = r"\w+: .*; in a lift a policy has no files, .*"
ENDED = r"ended its process \(exit code \d+\)"
LATE = r"no answer within 0.3 s"
MANY = r"had more than 24 processes and threads"
MEMORY = r"used more than 150 MiB of memory"
NO_ACTION = r"sent an action that is not 1 finite number\(s\)"
NUMBERS = r"robot's action must be 1 number, got "
