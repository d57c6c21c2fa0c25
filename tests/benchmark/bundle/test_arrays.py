"""Arrays from files that nobody vouches for."""

import contextlib
import io
import tracemalloc
import zipfile

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.bundle.arrays import MOST_ARRAYS, dump_arrays, parse_arrays
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp


class Exploding:
    def __reduce__(self):
        return (exec, ("raise SystemExit('a pickle was loaded')",))


def archive(*members, compression=zipfile.ZIP_DEFLATED):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", compression) as file:
        for name, content in members:
            file.writestr(name, content)
    return data.getvalue()


def npy(shape, dtype="<f8", data=b"", fortran=False, version=(1, 0)):
    """Return an array file that claims what it is told to."""
    file = io.BytesIO()
    header = {"descr": dtype, "fortran_order": fortran, "shape": shape}
    if version == (1, 0):
        np.lib.format.write_array_header_1_0(file, header)
    else:
        np.lib.format.write_array_header_2_0(file, header)
    return file.getvalue() + data


@settings(max_examples=30, deadline=None)
@given(
    st.dictionaries(
        st.from_regex(r"[a-z]{1,8}(/[a-z]{1,8})?", fullmatch=True),
        st.sampled_from(["<f8", "<i8", "|u1"]).flatmap(
            lambda dtype: hnp.arrays(dtype, hnp.array_shapes(min_dims=1, max_dims=2, min_side=0))
        ),
        max_size=4,
    )
)
def test_arrays_come_back_bit_for_bit_and_equal_ones_give_equal_files(arrays):
    data = dump_arrays(arrays)
    assert dump_arrays(arrays) == data
    found = parse_arrays(data, "x.npz")
    assert list(found) == list(arrays)
    for name, array in arrays.items():
        assert found[name].dtype == array.dtype
        assert found[name].shape == array.shape
        assert found[name].tobytes() == array.tobytes()


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_a_damaged_file_is_refused_or_read_never_anything_else(data):
    good = dump_arrays({"a": np.arange(40.0), "b": np.arange(9, dtype="|u1")})
    changed = bytearray(good)
    for _ in range(data.draw(st.integers(1, 4))):
        changed[data.draw(st.integers(0, len(good) - 1))] = data.draw(st.integers(0, 255))
    with contextlib.suppress(InputError):
        parse_arrays(bytes(changed[: data.draw(st.integers(0, len(good)))]), "x.npz")


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "not an .npz file"),
        (b"PK\x03\x04 junk", "not an .npz file"),
        (archive(("a.npy", b"")), "damaged"),
        (archive(("a.npy", b"no array at all")), "damaged"),
        (archive(("a.txt", b"text")), "not a plain .npy array"),
        (archive(("a.npy", npy((10**15,)))), "claims the shape"),
        (archive(("a.npy", npy((2**40, 2**40)))), "claims the shape"),
        (archive(("a.npy", npy((-1,)))), "dimensions"),
        (archive(("a.npy", npy(()))), "claims the shape"),
        (archive(("a.npy", npy((1, 1, 1), data=bytes(8)))), "dimensions"),
        (archive(("a.npy", npy((4,), data=bytes(40)))), "claims the shape"),
        (archive(("a.npy", npy((2, 2), data=bytes(32), fortran=True))), "of type"),
        (archive(("a.npy", npy((1,), ">f8", bytes(8)))), "of type >f8"),
        (archive(("a.npy", npy((1,), "<f4", bytes(4)))), "of type <f4"),
        (archive(("a.npy", npy((1,), "|O", bytes(8)))), "of type |O"),
        (archive(("a.npy", npy((1,), data=bytes(8), version=(2, 0)))), "format 1.0"),
        (archive(("a.npy", npy((1,), data=bytes(8))), compression=zipfile.ZIP_LZMA), "compressed"),
        (archive(*((f"{i}.npy", b"") for i in range(MOST_ARRAYS + 1))), "201 arrays"),
        (archive(("a.npy", bytes(2**20)), ("b.npy", bytes(2**20)))[:-1], "damaged"),
    ],
)
def test_a_hostile_file_is_refused(data, told):
    with pytest.raises(InputError, match=r"x\.npz") as caught:
        parse_arrays(data, "x.npz")
    assert told in str(caught.value)


def test_pickles_are_never_loaded():
    file = io.BytesIO()
    np.save(file, np.array([Exploding()], dtype=object), allow_pickle=True)
    with pytest.raises(InputError, match="must be one of"):
        parse_arrays(archive(("a.npy", file.getvalue())), "x.npz")


def test_names_that_are_there_twice_are_refused():
    with pytest.warns(UserWarning, match="Duplicate"):
        data = archive(("a.npy", npy((0,))), ("a.npy", npy((0,))))
    with pytest.raises(InputError, match="same name"):
        parse_arrays(data, "x.npz")


def test_a_bomb_is_not_unpacked(monkeypatch):
    monkeypatch.setattr("colift.benchmark.bundle.arrays.MOST_BYTES", 10_000)
    data = archive(("a.npy", npy((100_000,), data=bytes(800_000))))
    assert len(data) < 2000
    with pytest.raises(InputError, match="claims 800128 bytes"):
        parse_arrays(data, "x.npz")


def test_a_bomb_that_claims_to_be_small_is_not_unpacked_either():
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as file:
        small = npy((100_000,), data=bytes(800_000))
        with file.open("a.npy", "w") as member:
            member.write(small)
            for _ in range(64):
                member.write(bytes(2**20))
        file.infolist()[0].file_size = len(small)  # It is written to the directory at the end.
    tracemalloc.start()
    with pytest.raises(InputError, match="damaged"):
        parse_arrays(data.getvalue(), "x.npz")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 2**23
