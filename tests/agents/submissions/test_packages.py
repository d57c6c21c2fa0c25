"""Which imports of a submission are found without running it."""

import pytest
from colift.agents.submissions.folder import read_folder
from colift.agents.submissions.packages import PACKAGES, installed, undeclared


@pytest.fixture
def found(tmp_path):
    """Return what is found in a folder with a policy, a module and a package."""

    def find(source, packages=()):
        (tmp_path / "policy.py").write_text(source)
        (tmp_path / "helper.py").touch()
        (tmp_path / "nets").mkdir()
        (tmp_path / "nets" / "__init__.py").touch()
        return list(undeclared(tmp_path, read_folder(tmp_path), packages))

    return find


def test_every_package_of_the_list_is_there():
    assert all(map(installed, PACKAGES))


def test_python_colift_the_own_modules_and_what_is_declared_may_be_imported(found):
    source = (
        "import os.path, json, helper, nets.deep\n"
        "from . import helper\n"
        "from colift.agents.agent import RobotObservation\n"
        "import numpy as np, sklearn.linear_model\n"
    )
    assert found(source, ("numpy", "scikit-learn")) == []


def test_what_is_not_declared_is_told_with_what_to_declare(found):
    told = found("def late():\n    from sklearn.svm import SVC\n    import numpy.linalg\n")
    assert told == [
        "policy.py imports numpy: add 'numpy' to packages",
        "policy.py imports sklearn: add 'scikit-learn' to packages",
    ]


def test_what_no_sandbox_has_is_told_with_what_it_has(found):
    (told,) = found("import torch.nn\n")
    assert told == (
        "policy.py imports torch, which boards need not have; "
        "a submission may declare filterpy, numpy, scikit-learn, scipy"
    )


@pytest.mark.parametrize("source", ["def (:", "\0", "(" * 5000, "-" * 100_000 + "1", "\xff"])
def test_what_is_no_python_is_left_to_the_sandbox(found, source):
    assert found(source) == []


def test_a_source_that_would_take_memory_to_read_is_told_and_not_read(found):
    told = found("import sklearn\n" + "1," * 2**20)
    assert told == ["policy.py is larger than 1 MiB; move its data to a data file"]
