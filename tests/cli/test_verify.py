"""``colift verify`` as a user meets it."""

import dataclasses
import hashlib
import json
import re
import shutil

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results, write_bundle
from colift.benchmark.bundle.json_text import dump_json
from colift.benchmark.episode.metric import SCORING
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.suites.suite import make_suite

from ..benchmark.verification.forging import outdate_metrics


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return the bundle of a true run of two lifts."""
    suite = make_suite("quick-v1")
    suite = dataclasses.replace(suite, name="two", scenarios=suite.scenarios[:1], seeds=(3, 4))
    run = run_suite(PolicySpec(text="copy"), suite)
    folder = tmp_path_factory.mktemp("made") / "bundle"
    write_bundle(folder, run, results(run, {}).plain())
    return folder


@pytest.fixture
def folder(made, tmp_path, monkeypatch):
    """Return a folder to work in, with a bundle that may be changed."""
    shutil.copytree(made, tmp_path / "bundle")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def edit(folder, name, change):
    """Change a JSON file of the bundle, and mend its hash."""
    path, manifest = folder / "bundle" / name, folder / "bundle" / "manifest.json"
    content = json.loads(path.read_text())
    change(content)
    path.write_bytes(dump_json(content))
    if path != manifest:
        told = json.loads(manifest.read_text())
        told["sha256"][name] = hashlib.sha256(path.read_bytes()).hexdigest()
        manifest.write_bytes(dump_json(told))


def test_other_files_in_a_bundle_are_a_note(colift, folder):
    (folder / "bundle" / ".DS_Store").touch()
    assert colift("verify", "bundle").stderr == ""
    for name in ("a.txt", "b.html", "c.png", "d"):
        (folder / "bundle" / name).touch()
    code, told, errors = colift("verify", "bundle")
    assert (code, "bundle is verified." in told) == (0, True)
    note = "note: bundle also contains a.txt, b.html, c.png and 1 more: not part of the bundle"
    assert errors == f"{note}, not checked\n"


def test_a_true_bundle_is_verified_and_said_to_prove_what_it_does(colift, folder):
    code, told, errors = colift("verify", "bundle", COLUMNS="80")
    assert (code, errors) == (0, "")
    first, score, verdict, *rest = told.splitlines()
    assert max(map(len, rest)) <= 80
    told = " ".join(rest)
    suite = "a suite of its own: 2 lifts, latency 0.1 s"
    assert first == f"2 lifts of copy on {suite} simulated again: equal to the bit."
    assert score.startswith("RMSE ")
    assert verdict == "bundle is verified."
    assert "not who produced them" in told
    assert "name and digest" in told


def test_json_is_alone_on_stdout(colift, folder):
    code, told, errors = colift("verify", "bundle", "--json", "--jobs", "1")
    content = json.loads(told)
    assert (code, errors) == (0, "")
    assert (content["verified"], content["bit_equal"], content["findings"]) == (True, True, [])


def test_a_refused_bundle_is_told_with_file_lift_and_step(colift, folder):
    path = folder / "bundle" / "episodes.csv"
    path.write_text(path.read_text().replace("smooth,draw-1,,3,", "smooth,draw-1,,4,", 1))
    code, told, errors = colift("verify", "bundle")
    assert (code, told) == (1, "")
    heading, *findings = errors.splitlines()
    assert heading == "bundle is refused:"
    assert "  episodes.csv: its SHA-256 is not the one in manifest.json" in findings
    assert "  episodes.csv, smooth/draw-1 seed 3: row 1 is smooth/draw-1 seed 4 instead" in findings


def test_a_refused_bundle_is_no_verified_json(colift, folder):
    edit(folder, "results.json", lambda r: r["summary"]["rmse_mm"].update(mean=1.0))
    code, told, errors = colift("verify", "bundle", "--json")
    content = json.loads(told)
    assert (code, content["verified"]) == (1, False)
    (finding,) = content["findings"]
    assert finding["file"] == "results.json"
    assert finding["message"].startswith("summary.rmse_mm.mean says 1.0, should be ")
    assert finding["message"] in errors


def test_another_platform_is_shown(colift, folder):
    edit(folder, "manifest.json", lambda m: m["platform"].update(libc="musl 9"))
    code, told, _ = colift("verify", "bundle")
    assert code == 0
    assert "  libc: musl 9 there, " in told


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("manifest.json", lambda m: m["platform"].update(libc="musl\x1b[2J 9")),
        ("manifest.json", lambda m: m["platform"].update({"\x1b]0;mine\x07": "x"})),
        ("results.json", lambda r: r["policy"].update(name="best\x1b[1A\rpolicy")),
    ],
)
def test_nothing_of_a_bundle_moves_the_cursor(colift, folder, name, change):
    edit(folder, name, change)
    _, told, errors = colift("verify", "bundle")
    assert all(line.isprintable() for line in (told + errors).splitlines())


def test_scores_of_an_older_version_are_computed_anew_on_demand(colift, folder):
    edit(folder, "results.json", lambda r: r.update(scoring=SCORING - 1))
    code, told, errors = colift("verify", "bundle")
    assert code == 1
    assert "is verified" not in told
    assert f"scores of version {SCORING - 1}" in errors
    assert "--rescore DIR" in errors
    code, told, errors = colift("verify", "bundle", "--rescore", "new")
    assert (code, errors) == (0, "")
    assert told.splitlines()[-1] == "Rescored bundle: new"
    assert colift("verify", "new")[0] == 0


def test_scores_of_other_metrics_are_computed_anew_on_demand(colift, folder):
    outdate_metrics(folder / "bundle", SCORING - 1)
    older = f"scores of version {SCORING - 1}, this colift computes version {SCORING}"
    for command in (("verify", "bundle"), ("compare", "bundle", "copy")):
        code, _, errors = colift(*command)
        assert code
        assert older in errors
        assert "colift verify bundle --rescore DIR" in errors
    code, told, errors = colift("verify", "bundle", "--rescore", "new")
    assert (code, errors) == (0, "")
    assert told.splitlines()[-1] == "Rescored bundle: new"
    code, told, _ = colift("verify", "new")
    assert (code, "new is verified." in told) == (0, True)
    rescored = json.loads((folder / "new" / "results.json").read_text())
    assert rescored["summary"]["sparc"]["mean"] > -7
    code, told, errors = colift("compare", "new", "copy")
    assert (code, errors.count("error")) == (0, 0)


def test_a_damaged_bundle_is_no_submission(colift, folder):
    (folder / "bundle" / "traces.npz").unlink()
    code, _, errors = colift("compare", "bundle", "copy")
    assert (code, errors) == (2, "error: bundle: traces.npz: it is missing\n")


def test_a_session_says_which_lifts_have_older_scores(colift, folder):
    lift = shutil.copytree(folder / "bundle", folder / "session" / "lifts" / "001-copy")
    outdate_metrics(lift, SCORING - 1)
    code, told, errors = colift("verify", "session")
    number, verdict = told.splitlines()
    assert re.fullmatch(r"001-copy: \d+\.\d\d mm, equal to the bit", number)
    assert (code, verdict) == (1, "The live lift is not verified.")
    assert errors.startswith(f"session/lifts/001-copy has scores of version {SCORING - 1}")
    assert "colift verify session/lifts/001-copy --rescore DIR" in errors


def test_a_session_is_counted_in_words(colift, folder):
    for number in (1, 2):
        shutil.copytree(folder / "bundle", folder / "session" / "lifts" / f"00{number}-copy")
        code, told, errors = colift("verify", "session")
        sentence = ("The live lift is verified.", "2 of 2 live lifts are verified.")[number - 1]
        assert (code, told.splitlines()[-1], errors) == (0, sentence, "")


@pytest.mark.parametrize("part", ["lifts", "session.json"])
def test_a_session_without_a_lift_is_not_verified(colift, tmp_path, part):
    session = tmp_path / "live" / "20270301-0123456789ab"
    session.mkdir(parents=True)
    (session / part).write_text("{}") if "." in part else (session / part).mkdir()
    code, told, errors = colift("verify", session)
    assert (code, told) == (1, "")
    assert errors == f"{session} has no lift to verify: none has counted yet\n"
    code, told, _ = colift("verify", session, "--json")
    assert (code, json.loads(told)) == (1, {})


def test_the_folder_of_sessions_names_them(colift, folder):
    """As 'colift play' leaves it: the session of which a lift counts is the one to verify."""
    for number in range(7):
        (folder / "live" / f"20270301-{number}" / "lifts").mkdir(parents=True)
    shutil.copytree(folder / "bundle", folder / "live" / "20270301-2" / "lifts" / "001-copy")
    code, told, errors = colift("verify", "live")
    assert (code, told) == (2, "")
    names = ", ".join(f"20270301-{number}" for number in range(5))
    assert errors == (
        f"error: live contains sessions of live lifts ({names} and 2 more), not a result bundle; "
        "verify one of them: colift verify live/20270301-2\n"
    )


def test_scores_of_a_newer_version_are_for_a_newer_colift(colift, folder):
    edit(folder, "results.json", lambda r: r.update(scoring=SCORING + 1))
    for command in (("verify", "bundle"), ("compare", "bundle", "copy")):
        code, _, errors = colift(*command)
        assert code
        assert "newer colift" in errors
        assert "--rescore" not in errors


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["nowhere"], "nowhere: no such folder; name that of a result bundle"),
        (["bundle/results.json"], "no such folder"),
        (["bundle", "--jobs", "0"], "jobs must be at least 1, got 0"),
        (["bundle", "--rescore", "."], "holds other files (bundle)"),
    ],
)
def test_wrong_usage_is_one_clear_line(colift, folder, arguments, told):
    code, output, errors = colift("verify", *arguments)
    assert (code, output) == (2, "")
    assert told in errors
    assert errors.count("\n") == 1
