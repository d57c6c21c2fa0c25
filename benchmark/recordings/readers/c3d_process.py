"""The points of a C3D file, read by ezc3d in a process of their own.

It is run as a program: ``python c3d_process.py FILE`` writes arrays to stdout. On some damaged
files ezc3d ends its process, or asks for memory without limit.
"""

import io
import struct
import sys
from pathlib import Path
from typing import Any, Final

import numpy as np

MEMORY: Final = 8 << 30
"""Most memory of the process [bytes]."""

BLOCK: Final = 512
"""Bytes of a block of the format; the header is the first."""

MIPS: Final = 86
"""Processor whose numbers begin with their highest byte."""


def arrays(path: str) -> dict[str, Any]:
    """Return points, shape (4, points, frames), with the header and parameters about them."""
    import ezc3d

    content = ezc3d.c3d(path)
    group = content["parameters"]["POINT"]
    texts = {
        name: np.array([str(value) for value in group[name]["value"]], dtype=np.str_)
        for name in group
        if name in ("UNITS", "Y_SCREEN") or name.startswith("LABELS")
    }
    rate = [*group["RATE"]["value"], 0.0][0] if "RATE" in group else 0.0
    first, last = said_frames(Path(path).read_bytes())
    return {
        **texts,
        "points": content["data"]["points"],
        "rate": float(rate) or float(content["header"]["points"]["frame_rate"]),
        "first": first,
        "last": last,
    }


def said_frames(data: bytes) -> tuple[int, int]:
    """Return the numbers of the first and the last frame by the header, which ezc3d corrects."""
    processor = BLOCK * (data[0] - 1) + 3
    order = ">" if processor < len(data) and data[processor] == MIPS else "<"
    first, last = struct.unpack_from(f"{order}2H", data, 6)
    return int(first), int(last)


def limit_memory() -> None:
    """Limit the memory of this process, where the system can."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


if __name__ == "__main__":
    limit_memory()
    made = io.BytesIO()
    try:
        np.savez(made, **arrays(sys.argv[1]))
    except (OSError, RuntimeError, ValueError, IndexError, KeyError, MemoryError) as error:
        sys.exit(f"{error or type(error).__name__}")
    sys.stdout.buffer.write(made.getvalue())
