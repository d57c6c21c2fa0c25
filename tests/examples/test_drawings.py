"""The drawings of ``examples/drawings``: the recorded file is what its script draws."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = ROOT / "examples" / "drawings"
FIGURES = ROOT / "docs" / "figures"
DRAWINGS = sorted(path.stem for path in SCRIPTS.glob("*.py") if path.stem != "sheet")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["coupling", "sandbox", "submission"])
def test_a_drawing_without_a_lift_has_the_recorded_bytes(tmp_path, name):
    subprocess.run([sys.executable, SCRIPTS / f"{name}.py"], cwd=tmp_path, check=True)
    assert (tmp_path / f"{name}.svg").read_bytes() == (FIGURES / f"{name}.svg").read_bytes()


@pytest.mark.parametrize("name", DRAWINGS)
def test_letters_stay_letters_in_a_drawing(name):
    drawn = (FIGURES / f"{name}.svg").read_text()
    assert drawn.count("<text") >= 5
    assert "<dc:date>" not in drawn
