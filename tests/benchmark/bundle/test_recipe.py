"""The recipe: what re-makes the episodes, and nothing that it should not."""

import dataclasses
import json

import pytest
from colift.agents.humans import SUBJECTS, Pause, Recorded, Recording
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.bundle import Recipe
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite, make_suite, recorded_suite


def lift(up=30):
    """Return the samples of a lift that rises in some frames, and falls in the rest of 60."""
    heights = (0.3 * min(k / up, (60 - k) / (60 - up)) + 1 / 3 for k in range(61))
    return "".join(f"{k / 50:.2f},{height!r}\n" for k, height in enumerate(heights))


LIFT = lift()


def told(suite):
    """Return a suite's recipe as a bundle has it, read back."""
    recipe = Recipe.of(suite)
    plain = json.loads(json.dumps(recipe.plain()))
    return Recipe.parse(plain, recipe.recordings)


@pytest.mark.parametrize("name", own_entries(SUITES))
def test_it_makes_every_suite_again(name):
    for suite in (
        make_suite(name),
        make_suite(name).with_seeds(90, 93).with_timing(0.05, 0.02),
        make_suite(name).with_partner("human"),
    ):
        made = told(suite).suite()
        assert made.digest == suite.digest
        assert made.name == suite.name


def test_it_makes_drawn_people_and_long_seeds_again():
    scenarios = tuple(make_scenario("pause", f"draw-{2**127 + k}") for k in range(2))
    suite = Suite(name="mine", scenarios=scenarios, seeds=(2**128 - 1, 5))
    assert told(suite).suite().digest == suite.digest


def test_it_takes_recordings_with_it(tmp_path):
    path = tmp_path / "lifts.csv"
    trials = ("a", 'b "x", y', "c/d", "é")
    quoted = ['"' + trial.replace('"', '""') + '"' for trial in trials]
    rows = [
        f"{trial},{line}"
        for i, trial in enumerate(quoted)
        for line in lift(18 + 4 * i).splitlines()
    ]
    path.write_text("trial,t_s,z_m\n" + "\n".join(rows))
    suite = recorded_suite(path)
    recipe = told(suite)
    path.unlink()
    assert recipe.suite().digest == suite.digest
    assert [scene.trial for scene in recipe.suite().scenarios] == list(trials)


def test_what_has_no_name_has_no_recipe():
    plain = make_suite("quick-v1")
    first = plain.scenarios[0]
    changed = dataclasses.replace(SUBJECTS["S1"], stiffness=123.0)
    odd = Recording(name=" spaces ", times=(0.0, 1.0), heights=(0.0, 0.3))
    for scenario in (
        dataclasses.replace(first, subject=changed),
        dataclasses.replace(first, subject=dataclasses.replace(changed, name="Ann")),
        dataclasses.replace(first, behaviour="pause"),
        dataclasses.replace(first, behaviour="mine", human=Pause()),
        dataclasses.replace(
            first,
            behaviour="recorded",
            trial=odd.name,
            human=Recorded(recording=odd),
        ),
    ):
        assert Recipe.of(dataclasses.replace(plain, scenarios=(scenario,))) is None
    mixed = (first, dataclasses.replace(plain.scenarios[1], latency=0.0))
    assert Recipe.of(dataclasses.replace(plain, scenarios=mixed)) is None


def plain(**changes):
    return {**Recipe.of(make_suite("quick-v1")).plain(), **changes}


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"scenarios": []}, "1 to 100000 episodes"),
        ({"seeds": []}, "1 to 100000 episodes"),
        ({"seeds": list(range(30_000))}, "1 to 100000 episodes"),
        ({"seeds": [-1]}, "from 0 to"),
        ({"seeds": [2**128]}, "from 0 to"),
        ({"seeds": [1.0]}, "must be a whole number"),
        ({"seeds": [True]}, "must be a whole number"),
        ({"seeds": "0"}, "must be a list"),
        ({"scenarios": ["x" * 1001]}, "too long"),
        ({"scenarios": [3]}, "must be a text"),
        ({"scenarios": ["nonesuch/S1"]}, "; or the package that registers it is not installed"),
        ({"task": "nonesuch"}, "; or the package that registers it is not installed"),
        ({"seeds": [1, 1]}, "has the seed 1 twice"),
        ({"scenarios": ["smooth/S1", "smooth/S1"]}, "has the scenario 'smooth/S1' twice"),
        ({"scenarios": ["smooth"]}, "unknown subject ''"),
        ({"scenarios": ["smooth/S9"]}, "unknown subject 'S9'"),
        ({"scenarios": ["smooth/S1/trial"]}, "no behaviour 'smooth' with trial 'trial'"),
        ({"scenarios": ["recorded:/S1"]}, "no behaviour 'recorded:'"),
        ({"scenarios": ["recorded/S1/a"]}, "no trial 'a'"),
        ({"scenarios": ["recorded/S1"]}, "no trial ''"),
        ({"partner": "dog"}, "partner must be"),
        ({"latency": 0.123}, "latency must be"),
        ({"latency": 1}, "latency must be a number"),
        ({"control_period": 1e300}, "control_period must be"),
        ({"control_period": None}, "control_period must be a number"),
    ],
)
def test_a_recipe_of_something_else_is_refused(changes, said):
    with pytest.raises(InputError, match=r"^(manifest\.json|recordings\.csv)") as caught:
        Recipe.parse(plain(**changes), None).suite()
    assert said in str(caught.value)


def test_metrics_of_a_task_that_is_not_installed_are_refused():
    with pytest.raises(InputError, match=r"^manifest\.json: unknown task 'far'.*not installed$"):
        Recipe.parse(plain(task="far"), None).metrics()


def test_a_recipe_opens_no_file_of_this_machine(tmp_path):
    path = tmp_path / "lifts.csv"
    path.write_text("trial,t_s,z_m\n" + "".join(f"a,{line}\n" for line in LIFT.splitlines()))
    make_scenario(f"recorded:{path}")
    recipe = Recipe(
        name="trap",
        scenarios=((f"recorded:{path}", "S1", ""),),
        seeds=(0,),
        partner="nao",
        control_period=0.1,
        latency=0.1,
    )
    with pytest.raises(InputError, match="there is no behaviour"):
        recipe.suite()


@pytest.mark.parametrize(
    "recordings",
    [b"", b"\xff\xff", b"trial,t_s,z_m\n", b"a,b\n1,2\n", b'trial,t_s,z_m\n"a,0,0\n']
    + [b"trial,t_s,z_m\na,0,0\na,1," + height + b"\n" for height in (b"nan", b"1e308", b"x")],
)
def test_recordings_that_are_none_are_refused_by_their_name(recordings):
    recipe = Recipe.parse(plain(scenarios=["recorded/S1/a"]), recordings)
    with pytest.raises(InputError, match=r"^recordings\.csv"):
        recipe.suite()
