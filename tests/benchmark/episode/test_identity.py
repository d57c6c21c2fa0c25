"""Digests: whatever changes a score changes them, and nothing that only tidies does."""

import ast
import importlib
import json
import os
import pkgutil
import shutil
import subprocess
import sys
from pathlib import Path

import colift
import pytest
from colift import benchmark, robots
from colift.agents import control, estimators, humans, policies
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.identity import Code, Module
from colift.base.identity.statements import Statement
from colift.base.registry import HUMANS, POLICIES, ROBOTS, TASKS, lookup, own_entries, own_policies
from colift.benchmark import episode, tasks, world
from colift.benchmark.episode.conditions import Conditions
from colift.benchmark.episode.identity import PLAYS_AND_SCORES, SIMULATES, stated
from colift.benchmark.episode.kept_world import drop_kept_world, lift_in_kept_world
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.provenance import PLAYS
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.tasks.level.task import Level

pytestmark = pytest.mark.slow

LOOSE = (
    *("agents.actions", "agents.agent"),
    *("agents.tasks.ball.facts", "agents.tasks.agree.belief", "agents.tasks.intent.pose_filter"),
)
APPEARANCE = ("colift.robots.nao.shapes",)
"""What a robot looks like: no lift depends on it, so that no number there changes a digest."""
ACCEPTANCE = tuple(
    f"colift.agents.humans.{name}"
    for name in (
        *("artefacts", "beside", "copies", "foreign_files", "goals", "recording_file"),
        *("recording_notes", "treatment", "trial", "trial_file"),
    )
)
"""What refuses or describes recordings and live lifts: those that play do not depend on it."""
NOT_IN_SUITES = ("oracle", "rehearsal", "suites", "telling")
"""Modules of tasks that play, as policies do, inform players, or state suites, whose scenarios and
seeds count."""
AT_IMPORTS = {("colift.registration", "_Awaited")}
"""What is asked at every import, such as a policy's late one, and waits for Gymnasium."""
LIVE = (humans.Played, humans.Cued, humans.HandLog, humans.PersonAsRobot)
BEYOND = [lookup(group, name) for group in (TASKS, HUMANS, ROBOTS) for name in own_entries(group)]
SUITE = (*PLAYS_AND_SCORES, Scenario, Conditions, humans.Subject, humans.Recording, *LIVE, *BEYOND)
"""The roots of what a suite's digest has of the code, all tasks and live lifts included."""

PLAY = """
import dataclasses, json
from colift.base.registry import SUITES, own_entries
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite
suites = [make_suite("quick-v1")]
for name in own_entries(SUITES):
    suite = make_suite(name)
    first = suite.scenarios[0]
    if first.task.name != "level" or first.conditions is not None:
        few = suite.scenarios[:: len(suite.scenarios) // 3]
        suites.append(dataclasses.replace(suite, scenarios=few, seeds=(0,)))
runs = [run_suite(PolicySpec(text="copy"), suite) for suite in suites]
lifts = [each for run in runs for each in run.episodes]
print(json.dumps([[each.trace.digest(), repr(each.scores)] for each in lifts]))
"""


def modules(package):
    found = pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    return [each.name for each in found]


def mutated():
    """Return the names of the modules of the world, the humans, sensors, metrics and the robot."""
    packages = (robots, world, humans, episode, tasks)
    found = [name for package in packages for name in modules(package)]
    own = [name for name in found if name.rpartition(".")[2] not in NOT_IN_SUITES]
    return own + [f"colift.{name}" for name in LOOSE]


def source(name):
    return Path(importlib.import_module(name).__file__).read_text()


def constants(tree):
    """Yield the numbers of a module, without those of annotations."""
    annotations = {
        id(each)
        for node in ast.walk(tree)
        for field in ("annotation", "returns")
        if (value := getattr(node, field, None)) is not None
        for each in ast.walk(value)
    }
    for node in ast.walk(tree):
        number = isinstance(node, ast.Constant) and type(node.value) in (int, float)
        if number and id(node) not in annotations:
            yield node


def another(value):
    return value + 1 if isinstance(value, int) else value * 1.25 + 0.001


def with_sources(sources, code=None):
    """Return the code with other sources; what is known of another stays."""
    modules = {}
    for name, text in sources.items():
        package = name if name in sys.modules and is_package(name) else name.rpartition(".")[0]
        modules[name] = Module(name, text, package)
    changed = Code(modules={**(code.modules if code else {}), **modules})
    if code:  # It defines the same names.
        changed._found = code._found
        changed._pieces = {ref: each for ref, each in code._pieces.items() if ref[0] not in sources}
    return changed


def survivors(names):
    """Return how many numbers there are, and of each module those that change no digest."""
    code = Code()
    before = code.hash(*SUITE, without=stated())
    count, left = 0, {}
    for name in names:
        tree = ast.parse(source(name))
        numbers = list(constants(tree))
        count += len(numbers)

        def same(changed, name=name, tree=tree):
            values = [node.value for node in changed]
            for node in changed:
                node.value = another(node.value)
            found = with_sources({name: tree}, code).hash(*SUITE, without=stated())
            for node, value in zip(changed, values, strict=True):
                node.value = value
            return found == before

        # If all at once change nothing, none does.
        found = numbers if same(numbers) else [node for node in numbers if same([node])]
        if found:
            left[name] = [(node.lineno, node.col_offset) for node in found]
    return count, left


def played(folder=None):
    """Return what quick-v1 gives, of the sources in a folder."""
    path = {} if folder is None else {"PYTHONPATH": str(folder)}
    done = subprocess.run(
        [sys.executable, "-c", PLAY],
        env={**os.environ, **path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def test_every_number_changes_the_digest_or_no_bit_of_a_lift(tmp_path):
    """Those that change no digest are all changed at once, and the suite is played."""
    count, left = survivors(mutated())
    assert count > 1000
    physical = [places for name, places in left.items() if name not in APPEARANCE + ACCEPTANCE]
    assert 0 < sum(map(len, physical)) < count / 20
    root = Path(colift.__path__[0])
    shutil.copytree(root, tmp_path / "colift", ignore=shutil.ignore_patterns("leaderboard"))
    for name, places in left.items():
        path = Path(importlib.import_module(name).__file__)
        tree = ast.parse(path.read_text())
        for node in constants(tree):
            if (node.lineno, node.col_offset) in places:
                node.value = another(node.value)
        copied = Path(tmp_path, *name.split("."))
        copied = copied / "__init__.py" if copied.is_dir() else copied.with_suffix(".py")
        copied.write_text(ast.unparse(tree))
    assert played(tmp_path) == played()


def run_through(play):
    """Return the top-level definitions of colift that run, as (module, name)."""
    found = set()

    def note(frame, event, argument):
        if event == "call":
            name = frame.f_globals.get("__name__", "")
            first = frame.f_code.co_qualname.partition(".")[0]
            generated = frame.f_code.co_filename == "<string>" or first.startswith("<")
            if name.startswith("colift.") and not generated:
                found.add((name, first))

    sys.setprofile(note)
    try:
        play()
    finally:
        sys.setprofile(None)
    return found


@pytest.fixture(scope="module")
def code():
    """The code as it is, read once."""
    return Code()


@pytest.fixture(scope="module")
def of_suite(code):
    """The definitions behind the digest of a suite."""
    return set(code.definitions(*SUITE, Level, without=stated()))


@pytest.mark.parametrize("name", own_policies("level"))
def test_what_runs_is_in_a_digest(code, of_suite, name):
    """What plays and scores a lift is in the suite's, what decides in the policy's."""
    policy = PolicySpec(text=name).load()
    known = of_suite | set(code.definitions(policy))
    scenarios = make_suite("quick-v1").scenarios[8:10]

    def play():
        for scenario in scenarios:  # A person takes over from the last one, as in every run.
            with lift_in_kept_world(scenario) as lift:
                run_episode(lift, policy(), 0)
        drop_kept_world()

    ran = run_through(play)
    assert (Level.__module__, "Level") in ran
    assert not ran - known - AT_IMPORTS
    assert not {each for each in ran - set(code.definitions(policy)) if policies.__name__ in each}


def tidied(text):
    """Return a source without comments and docstrings, with an import that nothing uses.

    Its functions stand in another order, and what it raises says something else.
    """
    tree = ast.parse(text)
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        match body:
            case [ast.Expr(value=ast.Constant() as docstring), *_]:
                docstring.value = "Other words."
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            node.exc.args = [ast.Constant("another message")]
    functions = [each for each in tree.body if isinstance(each, ast.FunctionDef)]
    others = [each for each in tree.body if not isinstance(each, ast.FunctionDef)]
    first = 1 + max((i for i, each in enumerate(others) if is_import(each)), default=0)
    body = [*others[:first], *functions[::-1], *others[first:]]
    return (
        f"{ast.unparse(ast.Module(body, []))}\nimport colorsys\nfrom email import message as _m\n"
    )


def is_import(node):
    future = isinstance(node, ast.ImportFrom) and node.module == "__future__"
    return isinstance(node, ast.Import | ast.ImportFrom) or future


def moved(name, text):
    """Return the sources of a module and of a new one, in which its first function now is."""
    tree = ast.parse(text)
    functions = [each for each in tree.body if isinstance(each, ast.FunctionDef)]
    if not functions:
        return {name: text}
    function = functions[0]
    package = name if is_package(name) else name.rpartition(".")[0]
    top = [each for each in tree.body if is_import(each)]
    rest = [
        name
        for each in tree.body
        if each is not function and not is_import(each)
        for name in bound(each)
    ]
    old, function.name = function.name, "elsewhere"
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and node.id == old:
            node.id = "elsewhere"
    back = f"from {name} import {', '.join(rest)}\n" if rest else ""
    tree.body.remove(function)
    there = "\n".join(map(ast.unparse, top)) + f"\n{back}{ast.unparse(function)}"
    new = f"{package}.out_of_{name.rpartition('.')[2]}"
    here = f"from {new} import elsewhere as {old}\n{ast.unparse(tree)}"
    return {name: here, new: there}


def bound(statement):
    """Return the names that a statement binds in its module."""
    top = Statement(statement, "").top
    return [name for name in top.numbers if name in top.stored]


def is_package(name):
    return hasattr(importlib.import_module(name), "__path__")


def hashes(code):
    """Return every hash of code that identifies something."""
    own = {name: code.hash(PolicySpec(text=name).load()) for name in own_entries(POLICIES)}
    return {
        "suite": code.hash(*SUITE, without=stated()),
        "simulation": code.hash(*SIMULATES, *BEYOND, without=stated()),
        "colift": code.hash(*PLAYS, without=stated()),
        **own,
    }


@pytest.fixture(scope="module")
def before(code):
    """The hashes of the code as it is."""
    return hashes(code)


@pytest.fixture(scope="module")
def everything(code):
    """Return the names of all modules that any digest is over."""
    loaded = [PolicySpec(text=name).load() for name in own_entries(POLICIES)]
    return sorted({each.module for each in code.definitions(*SUITE, *PLAYS, *loaded)})


def test_tidying_changes_no_digest(everything, before):
    assert len(everything) > 100
    sources = {name: tidied(source(name)) for name in everything}
    assert hashes(with_sources(sources)) == before


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("episode.scenario", "human: Behaviour", 'human: "Behaviour"'),
        ("tasks.level.table", 'label="Smoothness"', 'label="How smooth"'),
        ("episode.metric", '"less", "more", "near zero"', '"less", "near zero", "more"'),
        ("tasks.agree.task", "table import AGREE_METRICS", "table import AGREE_METRICS as SAME"),
    ],
)
def test_quotes_and_words_change_no_digest(before, name, old, new):
    name = f"{benchmark.__name__}.{name}"
    text = source(name)
    assert old in text
    text = text.replace(old, new, 1).replace("= AGREE_METRICS", "= SAME")
    assert hashes(with_sources({name: text})) == before


def test_moving_a_function_out_of_every_module_changes_no_digest(everything, before):
    each_moved = {name: moved(name, source(name)) for name in everything}
    at_once = {module: text for sources in each_moved.values() for module, text in sources.items()}
    assert sum(map(len, each_moved.values())) == len(at_once) > 1.5 * len(everything)
    assert hashes(with_sources(at_once)) == before, [
        name for name, sources in each_moved.items() if hashes(with_sources(sources)) != before
    ]


def test_a_policy_s_digest_is_its_own(code):
    """A change of one policy, or of a part that some use, changes no other's."""
    loaded = {name: PolicySpec(text=name).load() for name in own_entries(POLICIES)}
    before = {name: code.hash(each) for name, each in loaded.items()}
    assert len(set(before.values())) == len(before)
    cases = {
        policies.copy.__name__: {"copy"},
        estimators.residuals.__name__: None,
        control.learned_task.__name__: {"task_model"},
    }
    for module, wanted in cases.items():
        tree = ast.parse(source(module))
        for node in constants(tree):
            node.value = another(node.value)
        changed = with_sources({module: ast.unparse(tree) + "\nNEW = 1\n"})
        differ = {name for name, each in loaded.items() if changed.hash(each) != before[name]}
        assert differ < set(loaded)
        if wanted is not None:
            assert differ <= wanted


def test_data_that_is_read_counts_and_no_other(monkeypatch):
    read = Path.read_bytes
    before = {
        name: Code().hash(PolicySpec(text=name).load())
        for name in ("anticipate", "reactive", "task_model", "copy")
    }
    for file, wanted in (
        ("anticipate.json", {"anticipate"}),
        ("reactive.json", {"reactive"}),
        ("task_model.json", {"task_model"}),
    ):
        other = lambda self, file=file: read(self) + b" " * (self.name == file)  # noqa: E731
        monkeypatch.setattr(Path, "read_bytes", other)
        found = {name: Code().hash(PolicySpec(text=name).load()) for name in before}
        assert {name for name in before if found[name] != before[name]} == wanted
