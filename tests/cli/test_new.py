"""``colift new``, as a user meets it."""


def test_a_template_is_written_once_and_the_next_step_told(colift, tmp_path):
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
