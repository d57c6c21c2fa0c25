"""The picture of the folders: all are in it, imports go down, and its arrows are imports."""

import ast
import importlib.util
import re
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PARTS = ("robots", "agents", "benchmark", "leaderboard", "cli")


def picture():
    """Return the module that reads and draws the picture."""
    path = ROOT / "docs/extensions/room_picture.py"
    spec = importlib.util.spec_from_file_location("room_picture", path)
    sys.modules[spec.name] = module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def rooms():
    page = (ROOT / "docs/background/architecture.md").read_text()
    [text] = re.findall(r"^```{rooms}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    return {room.name: room for room in picture().read_rooms(text.splitlines())}


def room_of(path, rooms):
    """Return the folder of the picture that holds a path: the innermost."""
    return next(str(each) for each in (path, *path.parents) if str(each) in rooms)


def imported(source: Path) -> Iterator[Path]:
    """Yield the files and folders of colift that a module imports."""
    package = source.parent.parts
    for node in ast.walk(ast.parse((ROOT / source).read_text())):
        if not isinstance(node, ast.ImportFrom):
            continue
        if node.level:
            base = package[: len(package) - node.level + 1]
        elif (node.module or "").startswith("colift."):
            base = ()
        else:
            continue
        inner = (node.module or "").removeprefix("colift.").split(".") if node.module else []
        module = Path(*base, *inner)
        for name in node.names:
            named = module / name.name
            is_module = (ROOT / named).is_dir() or (ROOT / named).with_suffix(".py").is_file()
            yield named if is_module else module


@pytest.fixture(scope="module")
def imports(rooms):
    """Return the pairs of different folders of which the first imports from the second."""
    sources = [path.relative_to(ROOT) for part in PARTS for path in ROOT.glob(f"{part}/**/*.py")]
    return {
        (room_of(source.parent, rooms), room_of(target, rooms)): source
        for source in sources
        for target in imported(source)
        if target.parts[0] in PARTS and room_of(source.parent, rooms) != room_of(target, rooms)
    }


def test_each_folder_of_the_picture_exists(rooms):
    assert [name for name in rooms if not (ROOT / name).is_dir()] == []


@pytest.mark.parametrize("part", ["agents", "benchmark", "leaderboard"])
def test_each_folder_with_code_is_in_the_picture(part, rooms):
    folders = {path.parent for path in ROOT.glob(f"{part}/*/__init__.py")}
    assert {str(path.relative_to(ROOT)) for path in folders} - rooms.keys() == set()


def test_imports_go_down(rooms, imports):
    assert len(imports) > 200
    up = [
        f"{source}: {here} imports {there}"
        for (here, there), source in imports.items()
        if rooms[here].row >= rooms[there].row
    ]
    assert up == []


def test_each_arrow_is_an_import(rooms, imports):
    way = [room.name for room in rooms.values() if room.on_the_way]
    assert [pair for pair in pairwise(way) if pair not in imports] == []


def test_a_row_without_a_part_is_refused():
    with pytest.raises(ValueError, match="no part"):
        picture().read_rooms(["world: physics"])
