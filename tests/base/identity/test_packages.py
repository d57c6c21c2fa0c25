"""The hash of a class of another package: its modules, its data, and what its import does."""

import importlib
import itertools
import sys

import pytest
from colift.base.identity import code_hash

PACKAGE = {
    "__init__.py": "from . import task\n",
    "settings.py": "GAIN = 2.0\nTABLE = {'slow': 1.0}\n",
    "rules.py": """
RULES = []

def rule(function):
    RULES.append(function)
    return function
""",
    "tilt.py": """
from .rules import rule

@rule
def tilt(x):
    return 2 * x
""",
    "data/weights.txt": "1 2 3",
    "task.py": '''
from dataclasses import dataclass
from importlib.resources import files
from typing import ClassVar

from . import tilt
from .rules import RULES
from .settings import GAIN, TABLE

FILE = "weights.txt"

def weights():
    """Return the weights."""
    return files(__package__).joinpath("data", FILE).read_text()

@dataclass(frozen=True)
class Task:
    name: ClassVar[str] = "steer"
    limit: float = GAIN

    def score(self, lift):
        if lift is None:
            raise ValueError("no lift")
        return sum(each(self.limit) for each in RULES) + TABLE["slow"] + float(weights()[0])
''',
}

NUMBERS = itertools.count()


@pytest.fixture
def digest(tmp_path, monkeypatch):
    """Return a function from changed files of the package to the hash of its class."""
    monkeypatch.syspath_prepend(tmp_path)

    def hashed(**changed):
        name = f"package{next(NUMBERS)}"
        for path, text in {**PACKAGE, **changed}.items():
            place = tmp_path / name / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text)
        importlib.invalidate_caches()
        return code_hash(importlib.import_module(f"{name}.task").Task, values=True)

    yield hashed
    for name in [each for each in sys.modules if each.startswith("package")]:
        del sys.modules[name]


def edited(path, old, new):
    assert old in PACKAGE[path]
    return {path: PACKAGE[path].replace(old, new)}


@pytest.mark.parametrize(
    "changed",
    [
        edited("task.py", '"""Return the weights."""', "# The weights."),
        edited("task.py", "limit: float", 'limit: "float"'),
        edited("task.py", "def score(self, lift)", "def score(self, lift: object) -> float"),
        edited("task.py", '"no lift"', 'f"there is no lift, but {lift}"'),
        edited("task.py", "each(self.limit) for each in", "rule(self.limit) for rule in"),
        edited("task.py", "from . import tilt", "import colorsys\n\nfrom . import tilt"),
        edited(
            "task.py",
            "FILE =",
            "import typing\nif typing.TYPE_CHECKING:\n    from .plots import Plot\nFILE =",
        ),
        {
            "task.py": PACKAGE["task.py"]
            .replace("GAIN", "FACTOR")
            .replace(".settings", ".numbers"),
            "numbers.py": "TABLE = {'slow': 1.0}\nFACTOR: float = 2.0  # A factor.\n",
        },
        {"plots.py": "from .settings import GAIN\nGAIN += 1\n"},
    ],
    ids=str,
)
def test_tidying_changes_nothing(digest, changed):
    assert digest(**changed) == digest()


@pytest.mark.parametrize(
    "changed",
    [
        edited("task.py", '+ TABLE["slow"]', '- TABLE["slow"]'),
        edited("task.py", "limit: float = GAIN", "limit: ClassVar[float] = GAIN"),
        edited("settings.py", "2.0", "2.5"),
        edited("settings.py", "1.0", "1.5"),
        edited("settings.py", "2.0", "sum([1.0, 0.5])"),
        edited("tilt.py", "2 * x", "3 * x"),
        edited("tilt.py", "@rule\n", ""),
        {"data/weights.txt": "1 2 4"},
        {"task.py": PACKAGE["task.py"] + "\nsetattr(Task, 'limit', 4.0)\n"},
        {"task.py": PACKAGE["task.py"] + "\nTask.score = lambda self, lift: 0.0\n"},
        {
            "__init__.py": "from . import tuning\n",
            "tuning.py": "from . import settings\nsettings.GAIN = 3.0\n",
        },
        {
            "__init__.py": "from . import task, tuning\n",
            "tuning.py": "from .task import Task\nTask.limit = 3.0\n",
        },
        {
            "__init__.py": "from . import tuning\n",
            "tuning.py": "from .settings import TABLE\nTABLE['slow'] = 3.0\n",
        },
    ],
    ids=str,
)
def test_what_changes_a_score_changes_it(digest, changed):
    assert digest(**changed) != digest()


def test_what_the_environment_sets_counts(digest, monkeypatch):
    read = edited("settings.py", "2.0", "float(os.environ['GAIN'])")
    read["settings.py"] = "import os\n" + read["settings.py"]
    found = []
    for value in ("2.0", "2.5", "2.0"):
        monkeypatch.setenv("GAIN", value)
        found.append(digest(**read))
    assert found[0] == found[2] != found[1]


def test_what_is_imported_late_counts_before_and_after(digest):
    late = edited("task.py", "+ TABLE", "+ late() + TABLE")
    late["task.py"] += "\ndef late():\n    from .late import OFFSET\n    return OFFSET\n"
    one, other = ({**late, "late.py": f"OFFSET = {value}\n"} for value in (1.0, 1.5))
    assert digest(**one) != digest(**other)
    task = sys.modules[f"package{next(NUMBERS) - 1}.task"]
    before = code_hash(task.Task, values=True)
    task.Task().score(object())
    assert code_hash(task.Task, values=True) == before
