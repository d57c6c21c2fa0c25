import pytest
from colift.base.errors import InputError
from colift.benchmark.figures.registry import REGISTRY, RecordedFigure, clone_folder, read_figures


def read(folder, text):
    (folder / REGISTRY).write_text(text)
    return read_figures(folder)


def test_an_entry_is_a_figure_with_its_files(tmp_path):
    text = """
[table]
command = "colift list"
suites = ["quick-v1"]
[picture]
command = "colift compare --all --out a"
text = false
pictures = ["a/one.png", "two.gif"]
machine = true
"""
    found = read(tmp_path, text)
    assert list(found) == ["table", "picture"]
    assert found["table"] == RecordedFigure(
        name="table", command="colift list", suites=("quick-v1",)
    )
    assert found["table"].files == ("table.txt",)
    assert found["picture"].files == ("one.png", "two.gif")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[a]\nsuites = ['quick-v1']", "a: command is missing"),
        ("[a]\ncommand = 'true'", "a: suites or code is missing"),
        ("[a]\ncommand = 'true'\nmachine = 1", "a: machine cannot be 1"),
        ("[a]\ncommand = 'true'\nsuites = 'quick-v1'", "a: suites cannot be 'quick-v1'"),
        ("[a]\ncommand = 'true'\nfiles = []", "a: unknown field 'files'; fields: command, text,"),
        ("[a]\ncommand = 'true'\nmachine = true\ntext = false", "a: records neither text"),
        ("a = 1", "a: must be a table"),
        ("[a", "Expected"),
        (
            "[a]\ncommand = 'b'\nmachine = true\npictures = ['x/p.png']\n"
            "[b]\ncommand = 'b'\nmachine = true\npictures = ['y/p.png']",
            "a and b both record p.png",
        ),
    ],
)
def test_a_wrong_entry_is_refused_with_its_place(tmp_path, text, message):
    with pytest.raises(InputError, match=message) as error:
        read(tmp_path, text)
    assert str(tmp_path / REGISTRY) in str(error.value)


def test_the_figures_are_in_a_clone_only(tmp_path, monkeypatch):
    assert (clone_folder() / "pyproject.toml").is_file()
    monkeypatch.setattr("colift.benchmark.figures.registry.REGISTRY", "elsewhere.toml")
    with pytest.raises(InputError, match="in a clone of colift only"):
        clone_folder()
