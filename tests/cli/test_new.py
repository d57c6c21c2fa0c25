"""``colift new``, as a user meets it."""

import subprocess
import sys


def colift(*arguments, **settings):
    return subprocess.run(
        [sys.executable, "-m", "colift.cli", *arguments],
        capture_output=True,
        text=True,
        timeout=300,
        **settings,
    )


def test_a_template_is_written_once_and_the_next_step_told(tmp_path):
    done = colift("new", "mine", cwd=tmp_path)
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "wrote mine/policy.toml",
        "wrote mine/policy.py",
        "Next: edit them, then colift check mine",
    ]
    assert "def act" in (tmp_path / "mine" / "policy.py").read_text()
    again = colift("new", "mine", cwd=tmp_path)
    assert again.returncode == 2
    assert again.stderr == "error: mine is not empty; name a new folder\n"
