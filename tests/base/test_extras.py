"""How an extra is had: from the sources that colift was installed from."""

import json
import subprocess
import sys

import pytest
from colift.base.extras import how_to_install


def installed(folder, told):
    """Return what is said where colift was installed so: its metadata is the first found."""
    info = folder / "site" / "colift-0.1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: colift\nVersion: 0.1.0\n")
    if told is not None:
        (info / "direct_url.json").write_text(json.dumps(told))
    code = (
        "import sys; from colift.base import extras\n"
        f"sys.path[:] = [{str(folder / 'site')!r}]\n"
        "print(extras.how_to_install('board'))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.stderr == ""
    return done.stdout.strip()


@pytest.fixture
def clone(tmp_path):
    made = tmp_path / "my clone"
    made.mkdir()
    (made / "pyproject.toml").touch()
    return made


def test_a_wheel_of_a_clone_is_installed_from_it_again(tmp_path, clone):
    told = installed(tmp_path, {"url": clone.as_uri(), "dir_info": {}})
    assert told == f"pip install '{clone}[board]'"


def test_uvs_own_environment_is_synchronised(tmp_path, clone):
    (clone / "uv.lock").touch()
    told = installed(tmp_path, {"url": clone.as_uri(), "dir_info": {"editable": True}})
    assert told == f"uv sync --all-extras --project '{clone}'"


@pytest.mark.parametrize("told", [None, {"url": "https://host/colift.whl"}, {"url": "file:///no"}])
def test_what_is_not_known_is_left_to_the_reader(tmp_path, told):
    assert installed(tmp_path, told).startswith("pip install 'CLONE[board]', where CLONE is")


def test_the_name_alone_is_never_asked_of_a_registry():
    assert "'colift[" not in how_to_install("nao")
