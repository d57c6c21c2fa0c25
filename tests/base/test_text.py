"""Text that people edit is read alike everywhere; other encodings are refused by their names."""

import pytest
from colift.agents.submissions.manifest import read_manifest
from colift.base.errors import InputError
from colift.base.text import decoded, parse_toml, read_bytes
from colift.benchmark.channels.reading import read_channel
from colift.benchmark.figures.registry import REGISTRY, read_figures

TEXT = 'name = "é"\nb = 2\n'
TOO_LARGE = {
    "400 digits": "9" * 400,
    "-400 digits": "-" + "9" * 400,
    "10^400": "1" + "0" * 400,
    "5000 digits": "9" * 5000,
    "hexadecimal": "0x" + "f" * 400,
    "long hexadecimal": "0x" + "f" * 9000,
    "octal": "0o" + "7" * 400,
    "binary": "0b" + "1" * 1000,
    "2^63": str(2**63),
}


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"], ids=["", "byte order mark"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["lf", "crlf", "cr"])
def test_marks_and_line_ends_of_editors_are_read(mark, end):
    data = mark + TEXT.replace("\n", end).encode()
    assert decoded(data, "f") == TEXT
    assert parse_toml(data, "f") == {"name": "é", "b": 2}


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (TEXT.encode("utf-16"), "f: must be UTF-8, is UTF-16: save it as UTF-8"),
        (b"\xfe\xff" + TEXT.encode("utf-16-be"), "is UTF-16"),
        (TEXT.encode("utf-32"), "is UTF-32"),
        (TEXT.encode("utf-16-le"), "looks like UTF-16"),
        (TEXT.encode("utf-16-be"), "looks like UTF-16"),
        ("a\nüb".encode("latin-1"), "byte 2 is not (0xfc, line 2): it looks like Latin-1"),
        ("“a”".encode("cp1252"), "it looks like Windows-1252: save it as UTF-8"),
        (b"PK\x03\x04\xff", "it is no text"),
        (b"some text with one \0 in it", "has null bytes"),
    ],
)
def test_other_encodings_are_named(data, told):
    with pytest.raises(InputError, match=r"^f: must be UTF-8") as caught:
        decoded(data, "f")
    assert told in str(caught.value)


def test_numbers_of_64_bits_are_read():
    assert parse_toml(f"a = {2**63 - 1}\nb = -{2**63}".encode(), "f") == {
        "a": 2**63 - 1,
        "b": -(2**63),
    }


@pytest.mark.parametrize("number", TOO_LARGE.values(), ids=TOO_LARGE)
@pytest.mark.parametrize("place", ["x = {}", "[x]\ny = {}", "x = [[1], {{y = [{}]}}]"])
def test_larger_numbers_are_refused_anywhere_in_a_file(number, place):
    with pytest.raises(InputError, match=r"^f: ") as caught:
        parse_toml(place.format(number).encode(), "f")
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize("number", TOO_LARGE.values(), ids=TOO_LARGE)
def test_every_reader_of_toml_refuses_them(number, tmp_path):
    channel = tmp_path / "own.toml"
    channel.write_text(f"[down]\ndelay = {number}\n")
    with pytest.raises(InputError, match=r"own\.toml"):
        read_channel(channel)
    with pytest.raises(InputError, match=r"policy\.toml"):
        read_manifest(f"name = {number}\n".encode())
    (tmp_path / REGISTRY).write_text(f"[figure]\nmachine = {number}\n")
    with pytest.raises(InputError, match=REGISTRY):
        read_figures(tmp_path)


def test_a_path_that_cannot_be_a_file_is_refused(tmp_path):
    for path, told in (
        (tmp_path / "none", "none: cannot be read: No such file"),
        (tmp_path, "cannot be read: Is a directory"),
        (tmp_path / "a\0b", "cannot be read"),
    ):
        with pytest.raises(InputError, match=told):
            read_bytes(path, 10)
    (tmp_path / "long").write_bytes(b"x" * 11)
    with pytest.raises(InputError, match="has more than 10 bytes"):
        read_bytes(tmp_path / "long", 10)
