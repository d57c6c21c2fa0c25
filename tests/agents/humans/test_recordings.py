"""Files of recordings: their table, their trials, and files of other programs."""

import pytest
from colift.agents.humans import load_recordings
from colift.agents.humans.foreign_files import foreign_format
from colift.base.errors import InputError

from .motion import lift, rows, table

A, B = rows(*lift(50.0), trial="a"), rows(*lift(30.0, top=0.4), trial="b")
GOOD = table(A, B)
ONE = table(A)


@pytest.fixture
def load(tmp_path):
    def load_text(text):
        path = tmp_path / "lifts.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return load_recordings(path)

    return load_text


def decimal_commas(text, separator):
    """Return a table with decimal commas, as a German or French program writes it."""
    return text.replace(",", separator).replace(".", ",")


def test_trials_are_read_in_order(load):
    first, second = load(GOOD)
    assert (first.name, second.name) == ("a", "b")
    assert len(first.times) == 300
    assert (second.times[1], second.heights[0]) == (0.033333, 0.9)


def interleaved():
    """Return the good file with the rows of its trials in turn, while there are two."""
    pairs = zip(A.splitlines(), B.splitlines(), strict=False)
    rest = A.splitlines()[len(B.splitlines()) :]
    return table("\n".join([line for pair in pairs for line in pair] + rest), "\n")


@pytest.mark.parametrize(
    "text",
    [
        b"\xef\xbb\xbf" + GOOD.encode(),
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\n", "\r"),
        GOOD.replace("\n", "\n\n"),
        GOOD.replace("\n", "\n,,\n"),
        GOOD.replace("trial,t_s,z_m", " trial, t_s ,z_m "),
        GOOD.rstrip("\n"),
        GOOD.replace("\n", ",\n"),
        GOOD.replace(",", ", "),
        GOOD.replace("trial,t_s,z_m", "trial,t_s,z_m,x_m,x_m")
        .replace("\n", ",?,\n")
        .replace("m,?,", "m"),
        interleaved(),
        '# licence: CC BY 4.0\n#,"two\n' + GOOD,
    ],
    ids=[
        "byte order mark",
        "crlf",
        "cr",
        "blank lines",
        "empty rows",
        "spaces in the header",
        "no last newline",
        "commas at the end",
        "spaces",
        "other columns",
        "trials in turn",
        "notes",
    ],
)
def test_variants_of_csv_are_accepted(load, text):
    assert load(text) == load(GOOD)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"lifts.csv: empty file, needs the columns trial,t_s,z_m"),
        ("\n\n", r"lifts.csv: empty file, needs the columns trial,t_s,z_m"),
        ("trial,t_s,z_m\n", r"lifts.csv: no samples, needs rows of trial,t_s,z_m"),
        ("trial,x,y\na,0\n", r"missing column\(s\) t_s, z_m; found trial, x, y$"),
        ("trial,time\na,0\n", r"t_s, z_m; found trial, time \(rename the columns: 'time' to t_s\?"),
        ("take,Time,Height\na,0,1\n", r"'take' to trial, 'Time' to t_s, 'Height' to z_m\?\)$"),
        (ONE.replace(",", ";"), r"found trial;t_s;z_m \(are .* commas, not by semicolons"),
        (ONE.replace(",", "\t"), r"found trial t_s z_m \(are .* commas, not by tabs"),
        (decimal_commas(ONE, ";"), r"separated by commas, not by semicolons.*decimal points"),
        (
            "trial,t_s,z_m\n" + decimal_commas(A, ","),
            r"line 2: 5 fields, must be 3 .*decimal commas",
        ),
        ('trial,t_s,z_m\na,"0,00",1\n', r"line 2: t_s is '0,00', .* decimal point: 0.00$"),
        ('trial,t_s,z_m\na,0,"1,012.300"\n', r"line 2: z_m is '1,012.300'.* without separators"),
        (",Trial,T_s,Z_m\n1,a,0,0\n", r"found , Trial, T_s, Z_m \(write .* in lower case"),
        ("% recorded, at 100 Hz\n" + ONE, r"is this a comment\?"),
        ("trial,t_s,z_m,z_m\na,0,0,1\n", r"the column z_m is there 2 times, must be there once"),
        ("t_s,t_s,trial,z_m\n0,0,a,0\n", r"the column t_s is there 2 times"),
        ("trial,person,t_s,z_m,person\na,A,0,0,B\n", r"the column person is there 2 times"),
        ("trial,t_s,z_m,trial\na,0,0,b\n", r"the column trial is there 2 times"),
        (ONE.replace("0.900000", "up", 1), r"lifts.csv, line 2: z_m is 'up', must be a number$"),
        ("trial,t_s,z_m\na,0,0\na,1\n", r"line 3: .* z_m is nan or empty in 1 sample, 1 s"),
        ("trial,t_s,z_m\na,inf,0\na,1,1\n", r"line 2: t_s is 'inf', must be finite"),
        ("trial,t_s,z_m\na,nan,0\na,1,1\n", r"line 2: t_s is 'nan', must be finite"),
        ("trial,t_s,z_m\na,1e999,0\na,1,1\n", r"line 2: t_s is '1e999', must be finite"),
        ("trial,t_s,z_m\n,0,0\n", r"line 2: trial is empty"),
        ("trial,t_s,z_m\na,0,0\n", r"trial 'a' has 1 sample\(s\), needs at least 10"),
        (b"trial,t_s,z_m\n\xff\xfe,0,0\n", r"lifts.csv: must be UTF-8; byte 14 is not .*Latin-1"),
        (GOOD.encode("utf-16"), r"lifts.csv: must be UTF-8, is UTF-16"),
        (ONE.replace("a,", "Prüfung,").encode("latin-1"), r"0xfc, line 2.*Latin-1: save it as"),
        ("trial,t_s,z_m\na," + "1" * 140_000 + ",0\n", r"line 2: not a CSV file: field larger"),
        ("trial,t_s,z_m\na,0," + "9" * 400 + "\n", r"line 2: z_m is '9+\.\.\.|must be finite"),
    ],
)
def test_a_bad_file_is_refused_in_one_clear_line(load, text, message):
    with pytest.raises(InputError, match=message) as caught:
        load(text)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 500


@pytest.mark.parametrize(("one", "other"), [("1", "1.0"), ("01", "1"), ("2", "2e0")])
def test_names_that_are_the_same_number_are_refused(load, one, other):
    text = table(rows(*lift(50.0), trial=one), rows(*lift(50.0, top=0.4), trial=other))
    with pytest.raises(InputError, match=rf"line 302: the trials '{one}' and '{other}' are the"):
        load(text)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.csv: cannot be read: No such file"):
        load_recordings(tmp_path / "none.csv")
    with pytest.raises(InputError, match=r"cannot be read: Is a directory"):
        load_recordings(tmp_path)


FOREIGN = {
    "C3D": b"\x02P" + bytes(510) + b"\x00\x94" * 100,
    "BVH": b"HIERARCHY\nROOT Hand\n{\n OFFSET 0 0 0\n}\nMOTION\nFrames: 2\n",
    "TRC": b"PathFileType\t4\t(X/Y/Z)\tlift.trc\nDataRate\tCameraRate\n100\t100\n",
    "STO": b"lift\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\thand_ty\n0\t1\n",
    "Qualisys": b"NO_OF_FRAMES\t600\nNO_OF_CAMERAS\t8\n",
    "Motive": b"Format Version,1.25,Take Name,Take 2025-03-11\r\n\r\n,,Marker\r\n",
    "Vicon Nexus": b"\xef\xbb\xbfTrajectories\r\n100\r\n,,Table:H1,,\r\nFrame,Sub Frame,X,Y,Z\r\n",
    "rostopic": b"%time,field.header.seq\n1741687872123456789,1\n",
    "AMC": b"#!OML:ASF\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 1 2 3\n",
    "ZIP archive, or a workbook": b"PK\x03\x04\x14\x00\x00\x00",
    "MAT file": b"MATLAB 5.0 MAT-file, Platform: GLNXA64",
    "HDF5": b"\x89HDF\r\n\x1a\n",
    "NumPy": b"\x93NUMPY\x01\x00",
    "XDF": b"XDF:\x01",
    "JSON": b'{"trial": []}',
    "XML": b"<?xml version='1.0'?><mvnx>",
    "compressed": b"\x1f\x8b\x08\x00",
}


@pytest.mark.parametrize("name", FOREIGN)
def test_files_of_other_programs_are_named_with_the_cure(load, name):
    told = rf"lifts\.csv: this is .*{name}.*, must be a CSV file with the columns trial,t_s,z_m: "
    with pytest.raises(InputError, match=told + "'colift recordings FILE --out lifts.csv' makes"):
        load(FOREIGN[name])


@pytest.mark.parametrize("text", [GOOD, "", "Trajectory,t_s\n", "trial;t_s\n", "\n", "aPq,t_s"])
def test_tables_are_no_files_of_other_programs(text):
    assert foreign_format(text.encode()) == ""
