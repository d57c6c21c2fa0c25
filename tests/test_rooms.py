"""The picture of the folders: all are in it, imports go down, and its arrows are imports."""

import importlib.util
import re
import sys
from itertools import pairwise
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[1]


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


def room_of(module, rooms):
    """Return the folder of the picture that holds a module: the innermost."""
    names = module.split(".")[1:]
    places = ("/".join(names[:length]) for length in range(len(names), 0, -1))
    return next((place for place in places if place in rooms), "src/colift")


@pytest.fixture(scope="module")
def imports(rooms):
    """Return the pairs of different folders of which the first imports from the second.

    ``colift.__main__`` is the command itself, although it has to stand in the package.
    """
    graph = grimp.build_graph("colift", cache_dir=None)
    graph.remove_module("colift.__main__")
    pairs = {
        (room_of(source, rooms), room_of(target, rooms)): f"{source} imports {target}"
        for source in graph.modules
        for target in graph.find_modules_directly_imported_by(source)
    }
    return {pair: words for pair, words in pairs.items() if pair[0] != pair[1]}


def test_each_folder_of_the_picture_exists(rooms):
    assert [name for name in rooms if not (ROOT / name).is_dir()] == []


@pytest.mark.parametrize("part", ["agents", "base", "benchmark", "leaderboard", "play"])
def test_each_folder_with_code_is_in_the_picture(part, rooms):
    folders = {path.parent for path in ROOT.glob(f"{part}/*/__init__.py")}
    assert {str(path.relative_to(ROOT)) for path in folders} - rooms.keys() == set()


def test_imports_go_down(rooms, imports):
    assert len(imports) > 200
    up = [words for (here, there), words in imports.items() if rooms[here].row >= rooms[there].row]
    assert up == []


def test_each_arrow_is_an_import(rooms, imports):
    way = [room.name for room in rooms.values() if room.on_the_way]
    assert [pair for pair in pairwise(way) if pair not in imports] == []


def test_a_row_without_a_part_is_refused():
    with pytest.raises(ValueError, match="no part"):
        picture().read_rooms(["world: physics"])
