import pytest
from colift.agents.errors import InputError
from colift.agents.humans import Recording, load_recordings

GOOD = "trial,t_s,z_m\na,0.0,0.0\na,0.1,0.3\nb,0,1\nb,0.5,0.5\n"


@pytest.fixture
def load(tmp_path):
    def load_text(text):
        path = tmp_path / "lifts.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return load_recordings(path)

    return load_text


def test_trials_are_read_in_order(load):
    assert load(GOOD) == (
        Recording(name="a", times=(0.0, 0.1), heights=(0.0, 0.3)),
        Recording(name="b", times=(0.0, 0.5), heights=(1.0, 0.5)),
    )


@pytest.mark.parametrize(
    "text",
    [
        b"\xef\xbb\xbf" + GOOD.encode(),
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\n", "\n\n"),
        GOOD.replace("trial,t_s,z_m", " trial, t_s ,z_m "),
        GOOD.rstrip("\n"),
        "x_m,z_m,trial,t_s\n9,0,a,0\n9,0.3,a,0.1\n?,1,b,0\n,0.5,b,0.5\n",
    ],
    ids=["bom", "crlf", "blank lines", "spaces", "no last newline", "other columns and order"],
)
def test_variants_of_csv_are_accepted(load, text):
    assert load(text) == load(GOOD)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"lifts.csv: empty file, needs the columns trial,t_s,z_m"),
        ("trial,t_s,z_m\n", r"lifts.csv: no samples, needs rows of trial,t_s,z_m"),
        ("trial,time\na,0\n", r"missing column\(s\) t_s, z_m; found trial, time"),
        (
            "trial;t_s;z_m\na;0;0\n",
            r"missing column\(s\) trial, t_s, z_m; found trial;t_s;z_m \(are .* commas",
        ),
        ("trial,t_s,z_m\na,0,0\na,1,up\n", r"lifts.csv, line 3: z_m is 'up', must be a number"),
        ("trial,t_s,z_m\na,0,0\na,1\n", r"line 3: z_m is None, must be a number"),
        ("trial,t_s,z_m\na,0,nan\na,1,1\n", r"line 2: z_m is 'nan', must be finite"),
        ("trial,t_s,z_m\na,inf,0\na,1,1\n", r"line 2: t_s is 'inf', must be finite"),
        ("trial,t_s,z_m\n,0,0\n", r"line 2: trial is empty"),
        ("trial,t_s,z_m\na,0,0\na,.2,.3\na,.1,1\n", r"'a': time goes from 0.2 s to 0.1 s"),
        ("trial,t_s,z_m\na,0,0\na,0,.3\n", r"'a': time goes from 0.0 s to 0.0 s, must increase"),
        ("trial,t_s,z_m\na,0,0\n", r"trial 'a' has 1 sample\(s\), needs at least 2"),
        ("trial,t_s,z_m\na,0,0\na,1,.009\n", r"trial 'a' does not move: .* 0.0090 m"),
        ("trial,t_s,z_m\na,0,0\na,3000,1\n", r"'a' lasts 3000 s, must be .* in seconds"),
        (b"trial,t_s,z_m\n\xff\xfe,0,0\n", r"lifts.csv: not a CSV file in UTF-8"),
    ],
)
def test_a_bad_file_is_refused_in_one_clear_line(load, text, message):
    with pytest.raises(InputError, match=message) as caught:
        load(text)
    assert "\n" not in str(caught.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.csv: cannot be read: No such file"):
        load_recordings(tmp_path / "none.csv")
    with pytest.raises(InputError, match=r"cannot be read: Is a directory"):
        load_recordings(tmp_path)
