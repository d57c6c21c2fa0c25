"""A missing library is reported with the extra that has it, before any work."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.export import library
from colift.benchmark.export.exporting import check_format


@pytest.mark.parametrize(
    ("form", "lacking"), [("minari", "h5py"), ("minari", "minari"), ("lerobot", "pyarrow")]
)
def test_a_missing_library_names_the_extra(monkeypatch, form, lacking):
    load = library.importlib.import_module

    def missing(name):
        if name.partition(".")[0] == lacking:
            raise ImportError(name)
        return load(name)

    monkeypatch.setattr(library.importlib, "import_module", missing)
    with pytest.raises(InputError, match=rf"need {lacking}: .*(\[export\]|all-extras)"):
        check_format(form, "robot")
