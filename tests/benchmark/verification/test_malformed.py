"""What is no bundle is refused with the file."""

import pytest
from colift.base.errors import InputError
from colift.benchmark.verification import verify

from .forging import edit_json, mend, refused


class TestMalformed:
    def test_no_folder_is_the_users_mistake(self, tmp_path):
        with pytest.raises(InputError, match="nowhere: no such folder"):
            verify(tmp_path / "nowhere")

    def test_an_empty_folder_is_refused(self, tmp_path):
        assert refused(tmp_path, file="results.json") == "it is missing"

    @pytest.mark.parametrize(
        "name", ["results.json", "episodes.csv", "traces.npz", "manifest.json"]
    )
    @pytest.mark.parametrize("data", [b"", b"\x00" * 100, b"{}", b"PK\x05\x06" + bytes(18)])
    def test_a_file_of_something_else_is_named(self, bundle, name, data):
        (bundle / name).write_bytes(data)
        assert refused(bundle, file=name)

    def test_a_behaviour_that_cannot_be_planned_is_refused(self, bundle):
        """A recording of a lone outlier, of which nothing is left."""
        rows = "".join(f"a,{k / 100},{0.3 * (k == 50)}\n" for k in range(100))
        (bundle / "recordings.csv").write_text("trial,t_s,z_m\n" + rows)
        names = ["recorded/S1/a", "pause/S2", "jerky/S3", "changing_goal/S5"]

        def change(manifest):
            manifest["recipe"]["scenarios"] = names
            manifest["sha256"]["recordings.csv"] = ""

        edit_json(bundle, "manifest.json", change)
        mend(bundle)
        assert not verify(bundle).ok
