"""What a user of the package finds: ``import colift``."""

import subprocess
import sys
import xml.etree.ElementTree as ET
from importlib.metadata import version

import colift
import numpy as np
import pytest
from colift import colift_v0
from colift.agents.policies.blend import Blend
from colift.base.errors import InputError
from pettingzoo.test import api_test, parallel_api_test

from tests.printed import assert_neutral

pytestmark = pytest.mark.smoke


class Copy:
    """Goes where the human was, as the policy ``copy`` does."""

    def reset(self, seed):
        self.steps = 0

    def act(self, observation):
        self.steps += 1
        return [observation[0] - observation[3]]


class NeedsGain(Copy):
    def __init__(self, gain):
        self.gain = gain


class Failing(Copy):
    def act(self, observation):
        raise ValueError("no idea")


@pytest.fixture(scope="module")
def copied():
    return colift.evaluate("copy")


def python(program):
    """Return what a program prints in an interpreter of its own."""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_each_public_name_is_there():
    assert set(dir(colift)) == set(colift.__all__)
    for name in sorted({*colift.__all__} - {"twin"}):
        assert getattr(colift, name)
    assert python("import colift; print(colift.twin.make.__name__)") == "make"  # It imports JAX.
    assert colift.__version__ == version("colift")
    with pytest.raises(AttributeError, match="'lift'"):
        colift.lift  # noqa: B018 - the access is the test


def test_the_import_loads_no_library():
    loaded = python("import sys, colift; print(*sys.modules)").split()
    assert not {"numpy", "gymnasium", "pybullet", "matplotlib", "typer", "asyncio"} & set(loaded)


@pytest.mark.parametrize(
    "program",
    [
        "import colift, gymnasium; e = gymnasium.make('colift/Lift-v0')",
        "import gymnasium, colift; e = gymnasium.make('colift/Lift-v0')",
        "import gymnasium; e = gymnasium.make('colift:colift/Lift-v0')",
        "import gymnasium, colift.benchmark.environment; e = gymnasium.make('colift/Lift-v0')",
        "import colift; e = colift.make()",
    ],
)
def test_gymnasium_makes_it(program):
    assert python(f"{program}; print(len(e.reset(seed=1)[0]))") == "5"


# PettingZoo would rather have "human_0" than "human", and agents that all see and do the same.
@pytest.mark.filterwarnings("ignore::UserWarning:pettingzoo")
def test_the_pettingzoo_module_has_what_theirs_have():
    made = colift_v0.parallel_env(behaviour="pause")
    assert made.metadata["name"] == "colift_v0"
    parallel_api_test(made, num_cycles=20)
    for turns in (colift_v0.env(), colift_v0.raw_env()):
        api_test(turns, num_cycles=20)
        turns.close()
    made.close()


def test_a_lift_by_the_front_door():
    env = colift.make("pause", "S2", latency=0.2)
    observation, _ = env.reset(seed=3)
    assert env.observation_space.contains(observation)
    assert len(env.step(np.zeros(1))) == 5
    env.close()


@pytest.mark.parametrize("policy", [Copy(), Copy])
def test_an_object_and_a_class_score_as_the_same_policy_by_name(copied, policy):
    given = colift.evaluate(policy)
    assert given.run.policy == "Copy"
    assert [e.scores for e in given.run.episodes] == [e.scores for e in copied.run.episodes]


def test_an_object_of_colift_scores_as_by_name():
    by_name, given = colift.evaluate("blend"), colift.evaluate(Blend())
    assert given.rmse_mm == by_name.rmse_mm
    assert given.run.policy_digest == by_name.run.policy_digest


def test_a_file_is_scored_in_a_sandbox_and_a_folder_too(tmp_path, copied):
    (tmp_path / "mine.py").write_text(
        "class Mine:\n    def reset(self, seed): pass\n"
        "    def act(self, observation): return [observation[0] - observation[3]]\n"
    )
    found = colift.evaluate(f"{tmp_path}/mine.py:Mine")
    assert found.rmse_mm == copied.rmse_mm
    assert found.run.isolation != "none"
    with pytest.raises(InputError, match=r"no policy\.toml"):
        colift.evaluate(tmp_path)


def test_workers_give_the_same(copied):
    assert colift.evaluate("copy", jobs=2).rmse_mm == copied.rmse_mm


def test_what_it_prints_and_holds(copied):
    text = str(copied)
    assert text.startswith("copy on quick-v1")
    assert all(name in text for name in ("smooth", "pause", "jerky", "changing_goal", "two people"))
    assert f"RMSE {copied.rmse_mm:.2f} mm" in text
    assert not any(line.endswith(" ") for line in text.splitlines())
    low, high = copied.rmse_mm_ci95
    assert low < copied.rmse_mm < high
    assert 2 < copied.vs_human < 3
    assert repr(copied).startswith("<Evaluation of copy on quick-v1: RMSE 21.0")


def test_its_rows_and_its_frame(copied):
    pytest.importorskip("pandas")
    frame = copied.to_frame()
    assert list(frame["seed"]) == 12 * [0]
    assert list(frame["subject"]) == 4 * ["draw-1", "draw-2", "draw-3"]
    assert frame["rmse_mm"].mean() == pytest.approx(copied.rmse_mm)
    assert len(copied.rows()) == len(frame) == 12
    ratios = frame["rmse_mm"] / frame["human_human_rmse_mm"]
    assert np.exp(np.log(ratios).mean()) == pytest.approx(copied.vs_human)


@pytest.fixture(scope="module")
def bundle(copied, tmp_path_factory):
    from colift.benchmark.bundle import write_bundle
    from colift.benchmark.results.baselines import HUMAN_HUMAN

    folder = tmp_path_factory.mktemp("bundles") / "copy"
    human_human = copied.results.baselines[HUMAN_HUMAN]
    write_bundle(folder, copied.run, copied.results.plain(), human_human=human_human)
    return folder


def test_a_bundle_is_loaded_as_it_was_evaluated(copied, bundle):
    loaded = colift.load(bundle)
    assert loaded.results.plain() == copied.results.plain()
    assert loaded.rows() == copied.rows()
    assert str(loaded) == str(copied)


def test_an_evaluation_and_its_bundle_are_inspected_alike(copied, bundle):
    found, stored = colift.inspect(copied), colift.inspect(str(bundle), jobs=2)
    worst = max(copied.run.episodes, key=lambda episode: episode.scores["rmse_mm"])
    assert found.worst[0].episode is worst
    assert repr(found).startswith("<Inspection of copy on quick-v1: worst smooth/draw-2 seed 0")
    *same, _ = str(found).rpartition("Suite digest")
    assert str(stored).startswith(same[0])
    assert f"claims of the bundle {bundle}" in " ".join(str(stored).split())
    page = found._repr_html_()
    assert page.count('<img style="max-width: 100%" src="data:image/png;base64,') == 3
    assert "copy on quick-v1: RMSE 21.03 mm" in page
    assert "<table" in page


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (3, "3 is no evaluation: give what colift.evaluate"),
        ("nowhere", "nowhere: no such folder"),
    ],
)
def test_what_cannot_be_inspected_is_refused_in_words(given, told):
    with pytest.raises(InputError, match=told):
        colift.inspect(given)


def test_what_a_notebook_shows(copied):
    page = copied._repr_html_()
    root = ET.fromstring(f"<div>{page.replace('<br>', '<br/>')}</div>")
    assert [each.tag.rpartition("}")[2] for each in root] == ["svg", "table", "p", "p"]
    words = " ".join(root.itertext())
    assert "two humans" not in words
    assert "copy on quick-v1" in words
    assert f"RMSE {copied.rmse_mm:.2f} mm (95 % interval" in words
    bodies = [[*row.itertext()] for row in root.iter("tr")]
    assert [row[0] for row in bodies] == [
        "human",
        "smooth",
        "pause",
        "jerky",
        "changing_goal",
        "all",
    ]
    assert_neutral(page)


def test_the_text_in_jupyter_is_that_of_a_terminal(copied, monkeypatch):
    text = str(copied)
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    assert str(copied) == text


def test_the_failures_of_a_policy_are_told():
    failed = colift.evaluate(Failing)
    assert len(failed.failures) == 12
    assert failed.failures[0] == "smooth/draw-1 seed 0: step 0: ValueError: no idea"
    *_, told = str(failed).partition(
        "12 of 12 lifts failed and count as worst; the first, smooth/draw-1 seed 0"
    )
    assert "in act\n" in told
    assert told.endswith("ValueError: no idea")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((3,), "policy 3 has no method reset"),
        ((NeedsGain,), "NeedsGain cannot be made without arguments .*'gain'.* give an object"),
        (("nobody",), "unknown policy 'nobody'"),
        (("copy", "slow-v1"), "unknown suite 'slow-v1'"),
    ],
)
def test_what_cannot_be_scored_is_refused_in_words(arguments, told):
    with pytest.raises(InputError, match=told):
        colift.evaluate(*arguments)


def test_an_object_is_not_sandboxed_in_silence():
    with pytest.raises(InputError, match="'limits': an object or a class acts in this process"):
        colift.evaluate(Copy(), isolation="limits")


def test_a_class_of_the_script_has_one_process_alone(monkeypatch):
    monkeypatch.setattr(Copy, "__module__", "__main__")
    with pytest.raises(InputError, match="move it to a module, or use jobs=1"):
        colift.evaluate(Copy, jobs=2)


def test_the_lists_name_what_there_is():
    assert {"blend", "copy"} < set(colift.list_policies())
    assert {"smooth", "recorded"} < set(colift.list_humans())
    assert {"standard-v1", "quick-v1"} < set(colift.list_suites())
