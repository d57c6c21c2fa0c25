"""PyBullet prints nothing: not when it loads, nor when a world is made, in any thread."""

import subprocess
import sys

WORLDS = """
import os, threading

from colift.benchmark.world.physics import PHYSICS
from colift.benchmark.world.engine import disconnect, new_client

def make():
    for _ in range(20):
        disconnect(new_client(PHYSICS))

threads = [threading.Thread(target=make) for _ in range(3)]
for thread in threads:
    thread.start()
for _ in range(500):
    os.write(1, b"own ")
for thread in threads:
    thread.join()
"""


def test_making_worlds_prints_nothing_and_swallows_nothing():
    done = subprocess.run([sys.executable, "-c", WORLDS], capture_output=True, check=True)
    assert done.stderr == b""
    assert done.stdout == 500 * b"own "


def test_c_code_prints_again_afterwards():
    code = """
import ctypes
from colift.benchmark.world.bullet import silent
c = ctypes.CDLL(None)
c.puts(b"before")
with silent():
    c.puts(b"within")
c.puts(b"after")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
    assert done.stdout == b"before\nafter\n"
