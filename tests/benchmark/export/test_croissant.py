"""The Croissant metadata, read and checked by MLCommons' own reader."""

import hashlib
import json

import numpy as np
import pytest
from colift.benchmark.export.croissant import CROISSANT
from colift.benchmark.export.exporting import CardWords, export
from colift.benchmark.export.lerobot_writer import DATA
from colift.benchmark.export.proving import proved_lifts

from .conftest import SUITE

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # Of its reader of RDF.
WORDS = CardWords(about="Four lifts.", people="simulated", shows=("Little.",), licence="MIT")


@pytest.fixture(scope="module")
def mlcroissant():
    """The reader, imported where it is used: it takes every process 80 MB."""
    return pytest.importorskip("mlcroissant")


@pytest.fixture(params=["lerobot", "minari"])
def exported(request, bundle, boxes, provenance, tmp_path):
    pytest.importorskip("pyarrow" if request.param == "lerobot" else "minari")
    lifts = proved_lifts(bundle, SUITE, both=False)
    export(tmp_path / "out", lifts, boxes, provenance(), WORDS, form=request.param)
    return request.param, tmp_path / "out"


def test_it_is_valid_and_names_every_other_file_with_its_hash(exported, mlcroissant):
    _, folder = exported
    read = mlcroissant.Dataset(jsonld=str(folder / CROISSANT))
    assert read.metadata.ctx.issues.errors == set()
    assert (read.metadata.name, read.metadata.license) == ("four-uneven", ["MIT"])
    files = {each.content_url: each.sha256 for each in read.metadata.distribution}
    assert files == {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*")
        if path.is_file() and path.name != CROISSANT
    }


def test_the_records_of_a_lerobot_set_are_its_steps(exported, mlcroissant):
    form, folder = exported
    described = json.loads((folder / CROISSANT).read_text())
    if form == "minari":
        assert "recordSet" not in described
        return
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(folder / DATA.format(chunk_index=0, file_index=0))
    read = mlcroissant.Dataset(jsonld=str(folder / CROISSANT))
    (steps,) = described["recordSet"]
    records = list(read.records(steps["@id"]))
    assert len(records) == table.num_rows
    actions = [record[f"{steps['@id']}/action"] for record in records]
    assert np.array_equal(np.ravel(actions), np.ravel(table.column("action").to_pylist()))
