"""The hash of code: what leaves it as it is, and what changes it."""

import pytest
from colift.base.identity import Code, Module, Reference, source_hash

BEFORE = {
    "p.a": '''
"""A module."""
import math
from .b import SIZE, Shape
from . import c

LIMIT: float = 3.0
"""What it must not be more than."""

def area(shape: Shape, scale=1.0):
    """Return an area."""
    if scale > LIMIT:
        raise ValueError(f"scale is {scale}")
    total = math.pi * sum(c.squared(each) for each in shape.sides)
    return total * scale + even(SIZE)

def even(n):
    return n == 0 or odd(n - 1)

def odd(n):
    return n != 0 and even(n - 1)
''',
    "p.b": '''
from dataclasses import dataclass
FIRST, SIZE = 4, 5

class Small(Exception):
    """Too small."""

class Large(Exception):
    """Too large."""

@dataclass
class Shape:
    sides: tuple[int, ...]

    def longest(self):
        try:
            return max(self.sides)
        except Small:
            return 0
        except Large:
            return 1

    def shortest(self):
        return min(self.sides)
''',
    "p.c": """
def squared(x):
    return x * x
""",
}

TIDIED = {
    "p.a": '''
import colorsys
import math as m
from colift_elsewhere import something
from .moved.shapes import Figure, count

def odd_number(n):
    """Another order, another name."""
    return n != 0 and even(n - 1)

def _unused():
    return 17

# A comment.
HIGHEST = 3.0

def surface(shape, scale: float = 1.0) -> float:
    """Return the area of a shape, in other words."""
    from .c import square as squared_
    if scale > HIGHEST:
        raise ValueError(f"{scale} is more than {HIGHEST}: take less", scale)
    result: float = m.pi * sum(squared_(side) for side in shape.sides)
    return result * scale + even(count)

def even(n): return n == 0 or odd_number(n - 1)
''',
    "p.c": "def square(x): return x * x",
    "p.moved.shapes": '''
import dataclasses
from .errors import TooLarge, TooSmall
_, count = 4, 5

@dataclasses.dataclass
class Figure:
    """A figure."""
    sides: tuple[int, ...]
    """How long each is."""

    def shortest(self) -> int:
        """Return the shortest."""
        return min(self.sides)

    def longest(self) -> int:
        try:
            return max(self.sides)
        except TooSmall:
            return 0
        except TooLarge:
            return 1
''',
    "p.moved.errors": """
class TooLarge(Exception): ...
class TooSmall(Exception): pass
""",
}


def digest(sources, module="p.a", name="area"):
    modules = {
        each: Module(each, text, each.rpartition(".")[0] or each) for each, text in sources.items()
    }
    return Code({"p"}, modules).hash(Reference(module, name))


def test_names_places_words_and_what_is_unused_change_nothing():
    assert digest(BEFORE) == digest(TIDIED, name="surface")
    assert digest(BEFORE, "p.b", "Shape") == digest(TIDIED, "p.moved.shapes", "Figure")


@pytest.mark.parametrize(
    ("module", "old", "new"),
    [
        ("p.a", "LIMIT: float = 3.0", "LIMIT: float = 3.5"),
        ("p.a", "scale=1.0", "scale=2.0"),
        ("p.a", "scale > LIMIT", "scale >= LIMIT"),
        ("p.a", "math.pi", "math.tau"),
        ("p.a", "raise ValueError", "raise TypeError"),
        ("p.a", "even(SIZE)", "odd(SIZE)"),
        ("p.a", "odd(n - 1)", "even(n - 1)"),
        ("p.a", "import SIZE,", "import FIRST as SIZE,"),
        ("p.a", "for each in shape.sides", "for each in shape.corners"),
        ("p.b", "FIRST, SIZE = 4, 5", "SIZE, FIRST = 4, 5"),
        ("p.b", "FIRST, SIZE = 4, 5", "FIRST, SIZE = 4, 5\nSIZE += 1"),
        ("p.b", "FIRST, SIZE = 4, 5", "FIRST, SIZE = 4, 5\nif FIRST: SIZE = 7"),
        ("p.b", "FIRST, SIZE = 4, 5", "FIRST, SIZE = 4, 5\nfor SIZE in range(9): pass"),
        ("p.c", "x * x", "x * x * x"),
        ("p.c", "def squared", "import os\nos.environ['X'] = '1'\n\ndef squared"),
        ("p.c", "    return x * x", "    return x * x\n\nsquared.cache = {}"),
        ("p.c", "def squared", "import functools\n@functools.cache\ndef squared"),
    ],
)
def test_behaviour_changes_it(module, old, new):
    assert old in BEFORE[module]
    changed = {**BEFORE, module: BEFORE[module].replace(old, new)}
    assert digest(changed) != digest(BEFORE)


def test_what_the_package_runs_when_it_is_imported_counts():
    assert digest({**BEFORE, "p": "VERSION = 1"}) == digest(BEFORE)
    assert digest({**BEFORE, "p": "import os\nos.environ['X'] = '1'"}) != digest(BEFORE)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("except Small:\n            return 0", "except Small:\n            return 2"),
        ("except Small", "except Exception"),
        ("sides: tuple[int, ...]", "sides: tuple[int, ...]\n    more: int = 0"),
        ("sides: tuple[int, ...]", "sides = ()"),
        ("sides: tuple", "corners: tuple"),
        ("@dataclass\n", "@dataclass(frozen=True)\n"),
        ("def shortest", "def least"),
        ("min(self.sides)", "min(*self.sides)"),
    ],
)
def test_all_of_a_class_counts(old, new):
    assert old in BEFORE["p.b"]
    changed = {**BEFORE, "p.b": BEFORE["p.b"].replace(old, new)}
    assert digest(changed, "p.b", "Shape") != digest(BEFORE, "p.b", "Shape")


def test_classes_that_look_alike_are_told_apart():
    text = "class A(Exception): ...\nclass B(Exception): ...\ndef f():\n    try: g()\n"
    text += "    except A: return 0\n    except {}: return 1\ndef g(): raise B\n"
    one, other = ({"p.a": text.format(name)} for name in "AB")
    assert digest(one, name="f") != digest(other, name="f")


@pytest.mark.parametrize(
    ("text", "used"),
    [
        ("def f(): return [k for k in 'ab'], k", True),
        ("def f(): return [k for k in 'ab']", False),
        ("def f(): return [j for j in range(k)]", True),
        ("def f():\n    for k in 'ab': print(k)", False),
        ("class f:\n    k = 1\n    def g(self): return k", True),
        ("class f:\n    k = 1", False),
        ("class f:\n    k = k", True),
        ("def f():\n    global k\n    k += 1", True),
        (
            "def f():\n    k = 0\n    def g():\n        nonlocal k\n        k += 1\n    return g",
            False,
        ),
        ("def f(k): return lambda: k", False),
        ("def f(): return lambda: k", True),
        ("def f(*, a=k): return a", True),
        ("def f(a: k): return a", False),
        ("def f():\n    from math import pi as k\n    return k", False),
        ("def f():\n    try: pass\n    except OSError as k: return k", False),
        ("def f(x):\n    match x:\n        case [*k]: return k", False),
        ("def f(): return f'{k:.2f}'", True),
    ],
)
def test_a_name_is_global_or_not_by_where_it_is_bound(text, used):
    one, other = (digest({"p.a": f"k = {value}\n{text}\n"}, name="f") for value in "12")
    assert (one != other) == used


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("import numpy as np\nx = np.pi", "from numpy import pi as q\nx = q"),
        ("import numpy\nx = numpy.linalg.norm", "from numpy.linalg import norm\nx = norm"),
        ("x: int = 3", "x = 3"),
        ("def x(): pass", "def x():\n    '''Do nothing.'''"),
        ("def x():\n    a = 1\n    return a", "def x():\n    one = 1  # Two?\n    return one"),
        ("def x(): assert 1, 'no'", "def x(): assert 1, f'yes {x}'"),
    ],
)
def test_other_words_for_the_same_are_the_same(one, other):
    assert digest({"p.a": one}, name="x") == digest({"p.a": other}, name="x")


def test_of_a_file_all_counts_but_words_and_order():
    one = b"'''Mine.'''\nimport numpy as np\nA = 1\ndef f():\n    return A\ndef g(): return np.pi\n"
    other = b"from numpy import pi\ndef g(): return pi\ndef ff():\n    return B # b\nB = 1\n"
    assert source_hash(one) == source_hash(other)
    assert source_hash(one) != source_hash(one + b"def h(): return 3\n")
    assert source_hash(one) != source_hash(one.replace(b"A = 1", b"A = 2"))


def test_what_a_file_uses_of_colift_counts():
    text = b"from colift.agents.policies.%s import %s as P\nclass Mine(P): pass\n"
    assert source_hash(text % (b"copy", b"Copy")) != source_hash(text % (b"hold", b"Hold"))


@pytest.mark.parametrize("text", [b"not Python at all", b"x = 1\0", b"(" * 9999, b"\xff\xfe\xfd"])
def test_what_cannot_be_read_is_hashed_as_it_is(text):
    assert source_hash(text) == source_hash(text) != source_hash(text + b" ")
