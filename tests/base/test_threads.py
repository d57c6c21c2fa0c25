"""Linear algebra on one thread, in a process that loads libraries later."""

import subprocess
import sys

CODE = """
import numpy
from colift.base import threads
from threadpoolctl import threadpool_info

def limits():
    with threads.one_thread():
        return [each["num_threads"] for each in threadpool_info()]

first, known = limits(), threads._controller()
assert threads._controller() is known
import scipy.linalg
later = limits()
assert threads._controller() is not known
assert set(first) == set(later) == {1}, (first, later)
assert len(later) > len(first), (first, later)
"""


def test_a_library_that_comes_later_is_limited_too():
    """And as long as none comes, nobody looks for them again."""
    subprocess.run([sys.executable, "-c", CODE], check=True, timeout=60)
