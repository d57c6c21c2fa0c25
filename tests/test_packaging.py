"""The wheel, the editable install and the checkout are the same package, from any folder."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]
PACKAGES = ("agents", "base", "benchmark", "cli", "leaderboard", "play", "robots")
KINDS = ("wheel", "wheel of the sdist", "editable", "checkout")

WHERE = """
import json, colift, colift.leaderboard, colift.cli, pathlib
import colift.agents.sandbox.host.view as view, colift.benchmark, colift.robots
seen = list(view.view(None).visible())
parts = (colift.benchmark, colift.leaderboard, colift.cli, colift.robots)
print(json.dumps({
    "version": colift.__version__,
    "package": str(pathlib.Path(colift.__file__).parent),
    "paths": list(colift.__path__),
    "names": sorted(dir(colift)),
    "policies": colift.list_policies(),
    "sandbox": [
        part.__name__ for part in parts for place in seen
        if pathlib.Path(part.__file__).resolve().is_relative_to(place.resolve())
    ],
}))
"""


def hatch(folder, *arguments, source=ROOT):
    """Build with the project's own build system, and return the file."""
    command = [sys.executable, "-m", "hatchling", "build", "--directory", str(folder), *arguments]
    subprocess.run(command, cwd=source, check=True, capture_output=True)
    return next(path for path in folder.iterdir() if path.suffix in (".whl", ".gz"))


def sdist_wheel(folder):
    """Build a wheel of the source distribution."""
    shutil.unpack_archive(hatch(folder / "sdist", "--target", "sdist"), folder / "source")
    source = next((folder / "source").iterdir())
    return hatch(folder / "wheel", "--target", "wheel", source=source)


@pytest.fixture(scope="module")
def wheels(tmp_path_factory):
    """Build the wheels of all kinds of installation."""
    folder = tmp_path_factory.mktemp("built")
    return {
        "wheel": hatch(folder / "wheel", "--target", "wheel"),
        "wheel of the sdist": sdist_wheel(folder / "sdist"),
        "editable": hatch(folder / "editable", "--target", "wheel:editable"),
    }


@pytest.fixture(scope="module", params=KINDS)
def install(request, wheels, tmp_path_factory):
    """Make an environment with colift and what is installed here, and return what runs Python."""
    folder = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    site = folder / "lib" / f"python{sysconfig.get_python_version()}" / "site-packages"
    environment = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
    if request.param == "checkout":
        environment["PYTHONPATH"] = str(ROOT / "src")
    else:
        with zipfile.ZipFile(wheels[request.param]) as wheel:
            wheel.extractall(site)
    # Only the folders: the lines of an editable install of colift there are not read.
    here = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    (site / "zz_libraries.pth").write_text("\n".join(sorted(here)))

    def python(*arguments, cwd):
        command = [folder / "bin" / "python", *arguments]
        done = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    python.package = str(site / "colift" if "wheel" in request.param else ROOT / "src" / "colift")
    return python


def above_a_clone(folder):
    (folder / "colift").symlink_to(ROOT)


def beside_a_stray_folder(folder):
    (folder / "colift" / "benchmark").mkdir(parents=True)
    (folder / "colift" / "benchmark" / "__init__.py").write_text("raise SystemExit('stray')")


def in_a_clone(folder):
    for name in PACKAGES:
        (folder / name).symlink_to(ROOT / name)


@pytest.mark.parametrize("around", [above_a_clone, beside_a_stray_folder, in_a_clone])
def test_it_is_the_same_from_any_folder(install, around, tmp_path):
    around(tmp_path)
    found = json.loads(install("-c", WHERE, cwd=tmp_path))
    import colift

    assert found["package"] == install.package
    assert found["paths"] == [install.package]
    assert found["version"] == colift.__version__
    assert found["names"] == sorted(dir(colift))
    assert found["policies"] == colift.list_policies()
    assert found["sandbox"] == [], "a sandboxed policy would see these"


def test_it_scores_and_has_its_command(install, tmp_path):
    beside_a_stray_folder(tmp_path)
    score = "import colift; print(colift.evaluate('copy').rmse_mm)"
    import colift

    assert float(install("-c", score, cwd=tmp_path)) == colift.evaluate("copy").rmse_mm
    assert install("-m", "colift", "--version", cwd=tmp_path) == f"colift {colift.__version__}\n"


def test_the_wheel_has_every_file_of_the_packages_and_no_other(wheels):
    listed = subprocess.run(
        ["git", "ls-files", *PACKAGES, "src"], cwd=ROOT, capture_output=True, text=True
    )
    if listed.returncode:
        pytest.skip("this is no clone")
    kept = [Path(line) for line in listed.stdout.splitlines()]
    packaged = {f"colift/{path}" for path in kept if path.parts[0] in PACKAGES}
    packaged |= {
        str(path.relative_to("src")) for path in kept if path.suffix and "src" in path.parts
    }
    for kind in ("wheel", "wheel of the sdist"):
        names = set(zipfile.ZipFile(wheels[kind]).namelist())
        assert {name for name in names if ".dist-info/" not in name} == packaged
