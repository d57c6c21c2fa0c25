import pytest
from colift.base.errors import InputError
from colift.benchmark.validity.sources import source_of, sources_of


def write(path, trials=2, first=20):
    """Write lifts that rise for some frames, two more in each lift, and fall in the rest of 60."""
    path.parent.mkdir(exist_ok=True)
    rows = [
        f"{trial},{k / 50:.2f},{0.3 * min(k / up, (60 - k) / (60 - up)):.3f}\n"
        for trial in range(trials)
        for up in [first + 3 * trial]
        for k in range(61)
    ]
    path.write_text("trial,t_s,z_m\n" + "".join(rows))
    return path


def test_a_file_is_a_source_of_its_name_with_each_trial_once(tmp_path):
    source = source_of(write(tmp_path / "our people.csv", trials=3))
    assert (source.name, source.kind, source.suite.size) == ("our people", "recordings", 3)
    assert [scenario.trial for scenario in source.suite.scenarios] == ["0", "1", "2"]


def test_one_lift_is_refused(tmp_path):
    with pytest.raises(InputError, match="has 1 lift; intervals need 2 or more"):
        source_of(write(tmp_path / "one.csv", trials=1))


def test_a_lift_is_in_one_source(tmp_path):
    paths = [write(tmp_path / "one.csv"), write(tmp_path / "other.csv", first=23)]
    with pytest.raises(InputError, match=r"^other has the lift '1' of one, as '0': a lift can"):
        sources_of(paths)
    assert len(sources_of([paths[0], write(tmp_path / "new.csv", first=40)])) == 2


def test_two_sources_have_two_names(tmp_path):
    paths = [write(tmp_path / place / "lifts.csv") for place in ("here", "there")]
    with pytest.raises(InputError, match="2 sources are called 'lifts'"):
        sources_of(paths)
