"""The platform's fingerprint."""

import json
import subprocess
import sys

from colift.benchmark.execution.provenance import fingerprint


def test_every_process_of_a_platform_has_the_same():
    code = (
        "import json; from colift.benchmark.bundle import fingerprint as f; print(json.dumps(f()))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == fingerprint()


def test_nothing_in_it_is_empty():
    assert all(fingerprint().values())
