import subprocess
import sys

import pytest
from colift.agents.loading import loaded
from colift.agents.registry import POLICIES, own_entries


def test_every_policy_is_there():
    for entry in own_entries(POLICIES).values():
        assert getattr(loaded, entry.attr) is entry.load()
    with pytest.raises(AttributeError, match="Nonesuch"):
        _ = loaded.Nonesuch


def test_no_library_is_left_to_import_in_a_lift():
    code = (
        "import sys; import numpy as np; from colift.agents.loading import loaded\n"
        "before = set(sys.modules); policy = loaded.Blend(); policy.reset(0)\n"
        "policy.act(np.zeros(5)); print(*(set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    late = {name.partition(".")[0] for name in done.stdout.split()}
    assert late <= {"colift", *sys.stdlib_module_names}
