"""A bundle has what colift writes, as colift writes it, and no room for anything else."""

import json
import re
import zipfile

import numpy as np
import pytest
from colift.benchmark.bundle import read_bundle
from colift.benchmark.verification import UNPROVEN, verify

from .forging import edit_arrays, edit_json, mend, refused


def rewritten(encode):
    """Return what writes a JSON file in another way."""

    def change(folder, name):
        path = folder / name
        path.write_bytes(encode(json.loads(path.read_text())))

    return change


def text(content):
    return json.dumps(content, indent=2) + "\n"


@pytest.mark.parametrize("name", ["results.json", "manifest.json"])
@pytest.mark.parametrize(
    "encode",
    [
        lambda content: text(content).encode("utf-16"),
        lambda content: text(content).encode("utf-8-sig"),
        lambda content: (text(content) + " " * 1000).encode(),
        lambda content: json.dumps(content).encode(),
        lambda content: text(content).replace("\n", "\r\n").encode(),
        lambda content: re.sub(r"(\.\d+)(?=[,\n])", r"\g<1>0", text(content)).encode(),
        lambda content: text(content).replace("suite", "s\\u0075ite").encode(),
    ],
)
def test_json_in_another_form_is_refused(bundle, name, encode):
    rewritten(encode)(bundle, name)
    if name != "manifest.json":
        mend(bundle)
    assert refused(bundle, file=name)


MANIFEST = [
    lambda m: m.update(verified=True),
    lambda m: m["recipe"].update(signed_by="colift"),
    lambda m: m["recipe"].update(scenarios=["smooth/S1/", *m["recipe"]["scenarios"][1:]]),
    lambda m: m["platform"].update(note="x" * 1001),
    lambda m: m["platform"].update(note="\x1b[31m"),
    lambda m: m["platform"].update({f"note {i}": "x" for i in range(100)}),
]


@pytest.mark.parametrize("change", MANIFEST)
def test_more_in_the_manifest_is_refused(bundle, change):
    edit_json(bundle, "manifest.json", change)
    assert refused(bundle, file="manifest.json")


RESULTS = [
    lambda r: r["summary"]["step_ms"].update(p50=90.0, p99=0.001),
    lambda r: r["summary"]["step_ms"].update(p50=-0.0),
    lambda r: r["summary"].update(step_ms={"p50": None, "p99": None}, real_time=None),
    lambda r: r["summary"]["step_ms"].update(verified=True),
    lambda r: r["policy"].update(name="x" * 1001),
    lambda r: r["policy"].update(name="\ud800"),
    lambda r: r["policy"].update(name="two\nlines"),
    lambda r: r.update(isolation="\x1b[2Jbubblewrap"),
    lambda r: r.update(colift="1\u20282"),
    lambda r: r.update(evaluator_faults=10**4000),
]


@pytest.mark.parametrize("change", RESULTS)
def test_circumstances_that_cannot_be_are_refused(bundle, change):
    edit_json(bundle, "results.json", change)
    mend(bundle)
    assert refused(bundle, file="results.json")


@pytest.mark.parametrize("row", ["3", "1"])
def test_a_log_of_a_lift_that_did_not_fail_is_refused(bundle, row):
    (bundle / "logs.json").write_text(json.dumps({row: "I did"}, indent=2) + "\n")
    edit_json(bundle, "manifest.json", lambda m: m["sha256"].update({"logs.json": ""}))
    mend(bundle)
    assert "failed" in refused(bundle, file="logs.json")


def test_an_empty_log_is_refused(bundle):
    (bundle / "logs.json").write_text("{}\n")
    edit_json(bundle, "manifest.json", lambda m: m["sha256"].update({"logs.json": ""}))
    mend(bundle)
    assert "failed" in refused(bundle, file="logs.json")


def before(path):
    path.write_bytes(b"#!/bin/sh\n" + path.read_bytes())


def after(path):
    path.write_bytes(path.read_bytes() + b"#!/bin/sh\n")


def comment(path):
    with zipfile.ZipFile(path, "a") as archive:
        archive.comment = b"verified"


def entry_comment(path, field="comment", value=b"verified"):
    with zipfile.ZipFile(path) as archive:
        content = {info: archive.read(info) for info in archive.infolist()}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for info, data in content.items():
            setattr(info, field, value)
            archive.writestr(info, data)


def extra(path):
    entry_comment(path, "extra", b"\xfe\xca\x04\x00true")


@pytest.mark.parametrize("change", [before, after, comment, entry_comment, extra])
def test_more_than_arrays_in_the_traces_is_refused(bundle, change):
    change(bundle / "traces.npz")
    mend(bundle)
    assert "only arrays are allowed" in refused(bundle, file="traces.npz")


@pytest.mark.parametrize("name", ["..", ".hidden", "-v", "a/b"])
def test_an_odd_name_among_the_internals_is_refused(giving, name):
    def change(arrays):
        arrays[f"internals/{name}"] = arrays.pop("internals/prediction")

    edit_arrays(giving, change)
    mend(giving)
    assert "is not an array of a bundle" in refused(giving, file="traces.npz")


@pytest.mark.parametrize("bits", [0x7FF8000000000001, 0xFFF8000000000000])
def test_a_nan_has_one_form(giving, bits):
    def change(arrays):
        arrays["internals/prediction"].view(np.uint64)[3] = bits

    edit_arrays(giving, change)
    mend(giving)
    assert "NaN" in refused(giving, file="traces.npz")


def test_a_bundle_that_says_nothing_of_itself_is_verified(giving):
    edit_arrays(giving, lambda arrays: arrays["internals/prediction"].fill(np.nan))
    mend(giving)
    assert verify(giving).ok
    assert read_bundle(giving).results["policy"]["name"] == "giving"


def test_all_that_is_taken_as_said_is_named():
    for name in ("step times", "faults", "version of colift", "platform", "isolation"):
        assert name in UNPROVEN


def test_the_largest_traces_need_a_large_file(bundle):
    """An array of zeros takes a thousandth of its size in a file."""
    edit_arrays(bundle, lambda arrays: arrays.update(human_end=np.zeros(2**22)))
    mend(bundle)
    assert "bytes, at most" in refused(bundle, file="traces.npz")
