"""Extensions are tried by the command line in this process."""

import shutil
from pathlib import Path

import pytest
from colift.base.registry import entries

from ..cli.conftest import colift

__all__ = ["colift"]


@pytest.fixture
def install(tmp_path_factory, monkeypatch):
    """Return what installs a module and its entry points, as pip would, for the time of a test."""

    def put(module, entry_points):
        name, site = Path(module).stem, tmp_path_factory.mktemp("site")
        about = site / f"{name}-1.0.dist-info"
        about.mkdir()
        about.joinpath("METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n"
        )
        about.joinpath("entry_points.txt").write_text(entry_points)
        shutil.copy(module, site)
        monkeypatch.syspath_prepend(site)
        entries.cache_clear()

    yield put
    monkeypatch.undo()
    entries.cache_clear()
