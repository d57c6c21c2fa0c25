"""Submissions as policies: what is run is what was read."""

import os
import pickle
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from colift.agents.submissions.new import write_template
from colift.agents.submissions.snapshot import KEPT_DAYS, snapshot_file
from colift.agents.submissions.submission import open_submission, read_submission
from colift.base.errors import InputError

OBSERVATION = [0.1, 0.0, 0.0, 0.0, 0.0]


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "colift" / "submissions"


@pytest.fixture
def mine(tmp_path):
    folder = tmp_path / "mine"
    write_template(folder)
    return folder


def policy_py(folder, helper="1.0"):
    """Write a policy that uses a module beside it, and a file by two ways to name it."""
    (folder / "helper.py").write_text(f"GAIN = {helper}\n")
    (folder / "weights.txt").write_text("2.0")
    (folder / "policy.py").write_text(
        "from pathlib import Path\n"
        "import helper\n"
        "OFFSET = float((Path(__file__).parent / 'weights.txt').read_text())\n"
        "COUNT = []\n"
        "class Policy:\n"
        "    def __init__(self): self.scale = float(Path('weights.txt').read_text())\n"
        "    def reset(self, seed): COUNT.append(seed)\n"
        "    def act(self, observation): return [helper.GAIN, OFFSET, self.scale, len(COUNT)]\n"
    )


def act(policy):
    with policy.agent() as agent:
        agent.reset(1)
        return [float(number) for number in np.atleast_1d(agent.act(OBSERVATION))]


def test_the_template_is_a_submission_that_moves(mine):
    policy = open_submission(mine).trusted()
    assert policy.name == "mine"
    assert policy.isolation == "none"
    assert act(policy) == [pytest.approx(0.18)]


def test_modules_and_weights_beside_the_policy_are_found(mine):
    policy_py(mine)
    assert act(open_submission(mine).trusted()) == [1.0, 2.0, 2.0, 1.0]


def test_nothing_is_left_for_the_next_episode_or_submission(mine, tmp_path):
    policy_py(mine)
    other = tmp_path / "other"
    write_template(other)
    policy_py(other, helper="5.0")
    before, modules, here = sys.path[:], set(sys.modules), Path.cwd()
    policies = [open_submission(each).trusted() for each in (mine, other, mine)]
    assert [act(policy)[0] for policy in policies] == [1.0, 5.0, 1.0]
    assert [act(policy)[3] for policy in policies] == [1.0, 1.0, 1.0]
    assert (sys.path, Path.cwd()) == (before, here)
    assert not {"policy", "helper"} & (set(sys.modules) - modules)


def test_what_is_edited_later_is_not_run(mine):
    policy_py(mine)
    submission = open_submission(mine)
    policy_py(mine, helper="9.0")
    (mine / "policy.toml").unlink()
    assert act(submission.trusted())[0] == 1.0
    assert pickle.loads(pickle.dumps(submission.sandboxed())) == submission.sandboxed()


def test_equal_folders_have_equal_copies_and_digests(mine, tmp_path):
    other = tmp_path / "elsewhere" / "mine"
    write_template(other)
    one, two = open_submission(mine), open_submission(other)
    assert (one.folder, one.digest) == (two.folder, two.digest)
    assert one.digest == one.trusted().digest() == one.sandboxed().digest()
    (other / "policy.py").write_text((other / "policy.py").read_text() + "#")
    assert open_submission(other).digest != one.digest


def test_a_spoilt_copy_is_made_again(mine):
    place = open_submission(mine).folder
    (place / "policy.py").write_text("raise SystemExit\n")
    (place / "numpy.py").touch()
    assert open_submission(mine).folder == place
    assert act(open_submission(mine).trusted()) == [pytest.approx(0.18)]
    assert not (place / "numpy.py").exists()


def test_copies_that_nobody_uses_go(mine, tmp_path, cache):
    old = open_submission(mine).folder
    long_ago = time.time() - (KEPT_DAYS + 1) * 24 * 3600
    os.utime(old, (long_ago, long_ago))
    other = tmp_path / "other"
    write_template(other)
    new = open_submission(other).folder
    assert list(cache.iterdir()) == [new]


def test_hidden_files_are_not_seen_by_the_policy(mine):
    (mine / ".env").write_text("PASSWORD=1")
    (mine / "__pycache__").mkdir()
    (mine / "__pycache__" / "policy.cpython-311.pyc").write_bytes(b"x")
    assert sorted(path.name for path in open_submission(mine).folder.iterdir()) == [
        "policy.py",
        "policy.toml",
    ]


def test_the_cache_is_private(mine, cache):
    open_submission(mine)
    assert cache.stat().st_mode & 0o077 == 0


def test_a_cache_that_cannot_be_written_is_named(mine, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", "/proc/nowhere")
    with pytest.raises(InputError, match=r"cannot write to /proc/nowhere.*set XDG_CACHE_HOME"):
        open_submission(mine)


def test_a_file_alone_is_copied_alone(tmp_path):
    (tmp_path / "secret.txt").write_text("secret")
    path = tmp_path / "policy.py"
    path.write_text("x = 1\n")
    folder, contents = snapshot_file(path)
    assert contents.paths == ("policy.py",)
    assert [each.name for each in folder.iterdir()] == ["policy.py"]


@pytest.mark.parametrize(
    ("name", "told"), [("nowhere.py", "no such file"), ("my policy.py", "a name may have at most")]
)
def test_a_file_that_cannot_be_a_policy_is_refused(tmp_path, name, told):
    (tmp_path / "my policy.py").touch()
    with pytest.raises(InputError, match=told):
        snapshot_file(tmp_path / name)


@pytest.mark.parametrize("read", [open_submission, read_submission])
class TestWrong:
    def refused(self, read, folder):
        with pytest.raises(InputError) as caught:
            read(folder)
        return str(caught.value)

    def test_no_folder(self, read, mine):
        assert self.refused(read, mine / "nowhere") == f"{mine}/nowhere: no such folder"
        assert self.refused(read, mine / "policy.py") == (
            f"{mine}/policy.py is a file; a submission is a folder"
        )
        assert self.refused(read, mine / "policy.toml") == (
            f"{mine}/policy.toml is a file; a submission is a folder"
        )

    def test_no_manifest(self, read, mine):
        (mine / "policy.toml").unlink()
        assert self.refused(read, mine) == (
            f"{mine} has no policy.toml; a submission is a folder with policy.toml and policy.py"
        )

    def test_a_manifest_that_is_a_folder(self, read, mine):
        (mine / "policy.toml").unlink()
        (mine / "policy.toml").mkdir()
        assert "has no policy.toml" in self.refused(read, mine)

    def test_a_manifest_that_is_a_link(self, read, mine):
        (mine / "policy.toml").unlink()
        (mine / "policy.toml").symlink_to("/etc/passwd")
        assert "policy.toml: a symbolic link" in self.refused(read, mine)

    def test_a_wrong_value(self, read, mine):
        manifest = mine / "policy.toml"
        manifest.write_text(manifest.read_text().replace('["numpy"]', "yes"))
        assert self.refused(read, mine).startswith(f"{mine}/policy.toml: ")

    def test_no_such_file_for_the_entry_point(self, read, mine):
        (mine / "policy.py").rename(mine / "main.py")
        assert self.refused(read, mine) == (
            f"{mine}/policy.toml: entry_point 'policy:Policy' needs a file policy.py; "
            "the folder has main.py"
        )
        (mine / "main.py").unlink()
        assert self.refused(read, mine).endswith("the folder has no Python file")


@pytest.mark.parametrize("file", ["nets/main.py", "nets/main/__init__.py"])
def test_the_class_may_be_in_a_package(mine, file):
    (mine / file).parent.mkdir(parents=True)
    (mine / "policy.py").rename(mine / file)
    manifest = mine / "policy.toml"
    manifest.write_text(manifest.read_text().replace("policy:Policy", "nets.main:Policy"))
    assert act(open_submission(mine).trusted()) == [pytest.approx(0.18)]


def test_a_class_that_is_missing_is_told_with_those_there_are(mine):
    manifest = mine / "policy.toml"
    manifest.write_text(manifest.read_text().replace("policy:Policy", "policy:Polcy"))
    with pytest.raises(InputError, match="policy has no class 'Polcy'; it has Policy"):
        open_submission(mine).trusted().check()
