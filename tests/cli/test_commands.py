"""The command line as a user meets it: real processes, real files."""

import json
import re
import subprocess
import sys
from importlib.metadata import version

import pytest
from colift.agents.submissions.new import write_template
from colift.cli.commands import COMMANDS

QUICK = ("--suite", "quick-v1")

GOOD_CSV = "trial,t_s,z_m\n" + "".join(
    f"a,{k / 50:.2f},{0.3 * min(k, 60 - k) / 30:.3f}\n" for k in range(61)
)


@pytest.fixture
def policy(tmp_path):
    """Write a policy file and return what to call it by."""

    def write(act, name="Mine"):
        path = tmp_path / "policy.py"
        path.write_text(
            f"class {name}:\n"
            "    def reset(self, seed): pass\n"
            f"    def act(self, observation): {act}\n"
        )
        return f"{path}:{name}"

    return write


def test_run_prints_a_table_and_where_the_policy_stands(colift):
    done = colift("run", "copy", "--suite", "quick-v1")
    assert done.returncode == 0
    assert done.stderr == ""
    for told in (
        "vs_human",
        "smooth",
        "pause",
        "jerky",
        "changing_goal",
        "hold (never",
        "two people",
    ):
        assert told in done.stdout


def test_json_is_alone_on_stdout_and_the_bundle_holds_the_same(colift, tmp_path):
    out = tmp_path / "bundle"
    done = colift("run", "copy", "--suite", "quick-v1", "--json", "--jobs", "2", "--out", str(out))
    content = json.loads(done.stdout)
    assert content == json.loads((out / "results.json").read_text())
    failed = colift("run", "nonesuch", "--json")
    assert failed.stderr == f"error: {json.loads(failed.stdout)['error']}\n"
    assert content["baselines"]["hold"]["rmse_mm"]["mean"] > 60
    assert done.returncode == 0


def test_seeds_latency_and_control_period_make_other_episodes(colift):
    options = ("--seeds", "40:41", "--latency", "0.05", "--control-period", "0.05", "--json")
    content = json.loads(colift("run", "copy", "--suite", "quick-v1", *options).stdout)
    usual = json.loads(
        colift("run", "copy", "--suite", "quick-v1", "--seeds", "40:41", "--json").stdout
    )
    assert content["summary"]["episodes"] == 12
    assert content["suite_digest"] != usual["suite_digest"]
    assert content["summary"]["rmse_mm"]["mean"] < usual["summary"]["rmse_mm"]["mean"]


def test_recordings_are_evaluated(colift, tmp_path):
    path = tmp_path / "lifts.csv"
    path.write_text(GOOD_CSV)
    content = json.loads(colift("run", "copy", "--recordings", str(path), "--json").stdout)
    assert content["summary"]["episodes"] == 1
    assert content["groups"][0]["behaviour"] == "recorded"


def test_list_names_everything(colift):
    done = colift("list")
    assert done.returncode == 0
    for name in ("copy", "hold", "random", "changing_goal", "S5", "draw-N", "standard-v1"):
        assert name in done.stdout


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "nonesuch"], "unknown policy 'nonesuch' ('colift list' lists all names)"),
        (["run", "pose"], "did you mean pose_admittance or pose_bayes or pose_learned?"),
        (
            ["run", "copy", "--suite", "nonesuch"],
            "robust-v1, session-v1, standard-v1",
        ),
        (["run", "copy", "--seeds", "5:5"], "5:5"),
        (["run", "copy", "--seeds", "5"], "A:B"),
        (["run", "copy", "--seeds=-1:3"], "A:B"),
        (["run", "copy", "--jobs", "0"], "jobs must be at least 1"),
        (["run", "copy", "--jobs", "two"], "--jobs"),
        (["run", "copy", "--latency", "0.123"], "multiple of 0.01"),
        (["run", "copy", "--latency", "nan"], "latency"),
        (["run", "copy", "--control-period", "0"], "control_period"),
        (["run", "copy", "--out", "/proc/colift"], "cannot write"),
        (["run", "copy", "--out", "/dev/null"], "is a file"),
        (["run", "copy", "--recordings", "/nowhere.csv"], "/nowhere.csv"),
        (["run", "no.such.module:Class"], "cannot import"),
        (["run", "/nowhere.py:Class"], "no such file"),
        (["run", "colift.agents.agent:FRAME"], "not a class"),
        (["run", "colift.agents.agent:RobotObservation"], "no method reset"),
        (["run", "colift.agents.humans:Subject"], "own, which a sandbox does not see"),
        (
            ["render", "copy", "--out", "lift.bmp"],
            ".gif, .webp, .mp4, .png, .svg, .pdf, .glb, .html",
        ),
        (["render", "copy", "--out", "a.svg", "--for", "colum"], "--for: no figures for 'colum'"),
        (["render", "copy", "--out", "a.pdf", "--speed", "2"], "not for a.pdf"),
        (["compare", "copy", "hold", "--for", "poster"], "known: column, page, slide"),
        (["paper", "--blend", "forgeting=0.9"], "did you mean forgetting?"),
        (["paper", "--blend", "forgetting=2"], "--blend: "),
        (["channels", "copy", "--out", "a.txt"], "its suffix must be one of .png, .svg, .pdf"),
        (["render", "copy", "--out", "a.gif", "--camera", "left"], "unknown camera 'left'"),
        (["render", "copy", "--out", "a.gif", "--speed", "99"], "speed must be within"),
        (["render", "copy", "--out", "a.html", "--camera", "top"], "not for a.html"),
        (
            ["render", "copy", "--out", "a.png", "--speed", "2"],
            "--speed is for .gif, .webp, .mp4, not for a.png",
        ),
        (
            ["render", "copy", "--out", "a.mp4", "--plays", "3"],
            "--plays is for .gif, .webp, not for a.mp4",
        ),
        (
            ["render", "copy", "--out", "a.svg", "--beside", "blend"],
            "--beside is for .gif, .webp, .mp4, .png, not for a.svg",
        ),
        (["render", "copy", "--out", "a.gif", "--beside", "nosuch"], "'nosuch'"),
        (["render", "copy", "--out", "a.gif", "--beside", "ball_calm"], "for the task 'ball'"),
        (["render", "copy", "--behaviour", "smoth", "--out", "lift.png"], "smooth"),
        (["render", "copy", "--subject", "S9", "--out", "lift.png"], "S1, S2, S3, S4, S5"),
        (["bench", "--episodes", "1"], "at least 200"),
        (["learn", "everything"], "can learn: reactive"),
        (["learn", "reactive", "--trials", "0"], "--trials"),
        (["learn", "reactive", "--out", "/nowhere/x.json"], "no folder /nowhere"),
        (["calibrate", "--out", "/nowhere/x.json"], "no folder /nowhere"),
        (["baselines", "--out", "policy.py"], "its suffix must be .json"),
    ],
)
def test_wrong_usage_is_one_clear_line_and_exit_code_2(colift, arguments, told, tmp_path):
    done = colift(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert told in done.stderr + done.stdout
    assert "Traceback" not in done.stderr
    if done.stderr.startswith("error:"):
        assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("command", "out"),
    [
        (("learn", "reactive"), "mine.json"),
        (("learn", "task_model"), "mine.json"),
        (("learn", "anticipate", "--lifts", "1"), "mine.json"),
        (("calibrate",), "mine.json"),
        (("baselines",), "mine.json"),
        (("sweep",), "mine.png"),
    ],
)
def test_a_file_of_numbers_that_is_there_is_kept(colift, tmp_path, command, out):
    (tmp_path / "mine.json").write_text("precious")
    done = colift(*command, "--out", out)
    assert done.returncode == 2
    assert "mine.json exists; name a new file" in done.stderr
    assert (tmp_path / "mine.json").read_text() == "precious"
    assert not (tmp_path / "mine.png").exists()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "empty"),
        ("trial,t_s\na,0\n", "z_m"),
        ("trial,t_s,z_m\n", "no"),
        ("trial,t_s,z_m\na,0,0\n", "1 sample"),
        ("trial,t_s,z_m\na,0,0\na,0.1,nan\n", "nan"),
        ("trial,t_s,z_m\na,0.2,0\na,0.1,0.3\n", "must increase"),
        ("trial,t_s,z_m\na,0,0\na,0.1,high\n", "high"),
        ("trial,t_s,z_m\na,0,0\na,1,0.001\n", "m"),
    ],
)
def test_bad_recordings_are_refused(colift, tmp_path, text, told):
    path = tmp_path / "lifts.csv"
    path.write_text(text)
    done = colift("run", "copy", "--recordings", str(path))
    assert done.returncode == 2
    assert done.stderr.startswith("error:")
    assert done.stderr.count("\n") == 1
    assert told in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("act", "told"),
    [
        ("raise KeyError('oops')", "KeyError: 'oops'"),
        ("return float('nan')", "must be finite"),
        ("return [float('inf')]", "must be finite"),
        ("return None", "must be 1 number"),
    ],
)
def test_a_failing_policy_is_reported_and_the_run_goes_on(colift, policy, act, told):
    act += " if observation[4] > 0.5 else [0.0]"
    act = act.replace("raise KeyError('oops')", "{}['oops']")
    done = colift("run", policy(f"return {act.removeprefix('return ')}"), *QUICK, "--json")
    assert done.returncode == 1
    content = json.loads(done.stdout)
    assert content["summary"]["failed"] == content["summary"]["episodes"] == 12
    assert content["complete"]
    assert content["summary"]["rmse_mm"]["mean"] > 200
    assert "12 of 12 lifts failed" in done.stderr
    assert told in done.stderr
    assert set(re.findall(r'File "(.*?)"', done.stderr)) <= {"policy.py"}


@pytest.mark.slow
@pytest.mark.parametrize("act", ["raise KeyError('oops')", "return None"])
def test_a_run_ends_early_if_every_lift_fails_at_once(colift, policy, act, tmp_path):
    bundle = ("--out", tmp_path / "kept", "--jobs", "1")
    done = colift("run", policy(act), *bundle)
    assert (done.returncode, done.stdout) == (1, "")
    assert "stopped: the policy fails at once in each of the first 10 lifts\n" in done.stderr
    assert "10 of 10 lifts failed" in done.stderr
    assert [each.name for each in tmp_path.iterdir()] == ["policy.py"]
    content = json.loads(colift("run", policy(act), "--json", "--jobs", "1").stdout)
    assert (content["complete"], content["summary"]["failed"]) == (False, 10)


def test_a_policy_without_act_is_refused(colift, tmp_path):
    path = tmp_path / "half.py"
    path.write_text("class Half:\n    def reset(self, seed): pass\n")
    done = colift("run", f"{path}:Half")
    assert done.returncode == 2
    assert "no method act" in done.stderr


def test_render_draws_a_picture(colift, tmp_path):
    done = colift("render", "copy", "--behaviour", "pause", "--out", "lift.png", cwd=tmp_path)
    assert done.returncode == 0
    assert (tmp_path / "lift.png").read_bytes().startswith(b"\x89PNG")
    assert "pause/S1 seed 0" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("task", "policy", "behaviour"),
    [("ball", "ball_calm", "ball_smooth"), ("agree", "agree_leader", "abreast")],
)
def test_a_task_has_a_behaviour_of_its_own(colift, tmp_path, task, policy, behaviour):
    done = colift("render", policy, "--task", task, "--out", "lift.png", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith(f"lift.png: {behaviour}/S1 seed 0, RMSE ")


@pytest.mark.slow
def test_render_draws_partners_beside_each_other(colift, tmp_path):
    others = ("--beside", "hold", "--beside", "human")
    done = colift("render", "copy", *others, "--out", "lifts.png", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    score = r"\d+\.\d mm"
    told = f"lifts.png: smooth/S1 seed 0, RMSE copy {score}, hold {score}, two people {score}\n"
    assert re.fullmatch(told, done.stdout)
    assert (tmp_path / "lifts.png").stat().st_size > 10_000


@pytest.mark.slow
def test_render_writes_a_model(colift, tmp_path):
    pytest.importorskip("trimesh")
    done = colift("render", "copy", "--out", "lift.glb", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "lift.glb").read_bytes().startswith(b"glTF")


@pytest.mark.slow
def test_render_draws_the_intended_pose_of_a_task_and_refuses_a_policy_of_another(colift, tmp_path):
    picture = tmp_path / "pose.png"
    lift = ("--behaviour", "pivot", "--out", picture)
    code, _, err = colift("render", "pose_wrist", *lift, "--task", "intent")
    assert (code, err) == (0, "")
    assert picture.stat().st_size > 10_000
    code, _, err = colift("render", "pose_wrist", *lift)
    assert code == 2
    assert "policy 'pose_wrist' is for the task 'intent', not for 'level'" in err


def test_render_writes_a_page_that_plays_the_lift(colift, tmp_path):
    lift = ("render", "copy", "--behaviour", "pause", "--seed", "2", "--out", "lift.html")
    done = colift(*lift, cwd=tmp_path)
    assert done.returncode == 0
    page = (tmp_path / "lift.html").read_text()
    data = re.search('id="replay-data">(.*?)</script>', page)
    (shown,) = json.loads(data[1])["replays"]
    assert (shown["policy"], shown["behaviour"], shown["seed"]) == ("copy", "pause", 2)
    assert f"RMSE {shown['scores']['rmse_mm']:.1f} mm" in done.stdout


def test_a_command_that_is_spelt_wrong_is_guessed(colift):
    done = colift("verfy")
    assert done.returncode == 2
    assert "Did you mean 'verify'?" in done.stderr


def test_a_command_waits_for_no_library_of_another():
    code = (
        "import sys; from colift.cli.program import app;"
        "app(['new', '--help'], standalone_mode=False)"
        "; print(*{'matplotlib', 'pybullet', 'scipy', 'sqlalchemy'} & {*sys.modules}, 'none')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert done.stdout.splitlines()[-1] == "none", done.stderr


def test_it_says_its_version(colift):
    done = colift("--version")
    assert (done.returncode, done.stdout) == (0, f"colift {version('colift')}\n")


def test_alone_it_says_how_to_begin(colift):
    done = colift()
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert len(lines) < 15
    assert all(len(line) <= 80 for line in lines)
    told = [line.split()[1] for line in lines if line.startswith("  colift ")]
    assert told == ["run", "list", "compare", "play", "new", "check", "submit", "serve"]
    assert set(told) <= set(COMMANDS)


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("run bl", ["blend"]),
        ("run mi", ["minimum_jerk", "mine", "mine.py:"]),
        ("run ./mi", ["./mine", "./mine.py:"]),
        ("run blend --suite q", ["quick-v1"]),
        ("compare blend co", ["copy"]),
        ("list blen", ["blend"]),
        ("render blend --behaviour pau", ["pause"]),
        ("run blend --behaviour pau", ["pause"]),
        ("render blend --subject S5", ["S5"]),
        ("verif", ["verify"]),
    ],
)
def test_a_shell_completes_what_there_is(colift, tmp_path, words, wanted):
    write_template(tmp_path / "mine")
    (tmp_path / "mine.py").touch()
    done = colift(
        _COLIFT_COMPLETE="complete_bash",
        COMP_WORDS=f"colift {words}",
        COMP_CWORD=str(len(words.split())),
    )
    assert done.stdout.split() == wanted
    assert done.stderr == ""


def test_an_option_that_is_spelt_wrong_is_guessed(colift):
    assert "--suite" in colift("run", "blend", "--siute", "quick-v1").stderr


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "blend", "--seeds", "0:99999999999999999999"], "at most 12 digits"),
        (["run", "blend", "--seeds", "0:999999999"], "at most 100000 seeds"),
        (["run", "blend", "--jobs", "100000000"], "jobs must be at most 1024"),
        (["run", "mine,"], "parameters must be name=value, separated by commas; got ''"),
        (["run", "x" * 5000], "..."),
        (["render", "blend", "--out", "x.png", "--seed", "-3"], "--seed must not be negative"),
    ],
    ids=lambda each: " ".join(each)[:40] if isinstance(each, list) else "",
)
def test_what_once_ended_in_a_traceback_is_one_line(colift, arguments, told):
    done = colift(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert len(done.stderr) < 2100
