import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.rendering.scene import Picture
from colift.benchmark.rendering.writing import check_film, write
from PIL import Image, ImageSequence


def pictures(count: int) -> list[Picture]:
    """Return a red square that wanders over a blue ramp."""
    made = []
    for i in range(count):
        picture = np.zeros((48, 64, 3), dtype=np.uint8)
        picture[..., 2] = np.linspace(40, 250, 64)
        picture[20:28, 4 * i : 4 * i + 8] = (220, 30, 30)
        made.append(picture)
    return made


def test_gif_opens_with_all_its_pictures(tmp_path: Path) -> None:
    write(tmp_path / "a.gif", pictures(9), 12.5)
    with Image.open(tmp_path / "a.gif") as film:
        assert film.size == (64, 48)
        times = [frame.info["duration"] for frame in ImageSequence.Iterator(film)]
    assert times == [80] * 9


def test_colours_of_a_gif_do_not_flicker_and_are_true(tmp_path: Path) -> None:
    drawn = pictures(9)
    write(tmp_path / "a.gif", drawn, 12.5)
    with Image.open(tmp_path / "a.gif") as film:
        seen = [np.asarray(f.convert("RGB"), dtype=int) for f in ImageSequence.Iterator(film)]
    for picture, original in zip(seen, drawn, strict=True):
        assert np.array_equal(picture[:20], seen[0][:20])
        assert np.abs(picture - original).max() < 12


@pytest.mark.parametrize(
    ("name", "plays", "loop"),
    [("a.gif", 0, 0), ("a.gif", 1, None), ("a.gif", 3, 2), ("a.webp", 0, 0), ("a.webp", 1, 1)],
)
def test_a_film_says_how_often_it_plays(
    tmp_path: Path, name: str, plays: int, loop: int | None
) -> None:
    """A GIF tells the number of repetitions, or nothing; a WebP that of all."""
    write(tmp_path / name, pictures(3), 12.5, plays=plays)
    with Image.open(tmp_path / name) as film:
        assert film.info.get("loop") == loop


def test_webp_opens_with_all_its_pictures_in_their_colours(tmp_path: Path) -> None:
    drawn = pictures(9)
    write(tmp_path / "a.webp", drawn, 12.5)
    with Image.open(tmp_path / "a.webp") as film:
        frames = [(f.convert("RGB"), f.info["duration"]) for f in ImageSequence.Iterator(film)]
    assert [time for _, time in frames] == [80] * 9
    for (seen, _), picture in zip(frames, drawn, strict=True):
        assert np.abs(np.asarray(seen, dtype=int) - picture).mean() < 6


def test_mp4_opens_with_all_its_pictures(tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    write(tmp_path / "a.mp4", pictures(9), 12.5)
    count, seconds = ffmpeg.count_frames_and_secs(tmp_path / "a.mp4")
    assert count == 9
    assert seconds == pytest.approx(9 / 12.5, abs=0.02)
    reader = ffmpeg.read_frames(tmp_path / "a.mp4")
    assert next(reader)["size"] == (64, 48)
    reader.close()


def test_mp4_without_the_extra_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"mp4 needs imageio-ffmpeg: "):
        check_film(tmp_path / "a.mp4")


def test_png_is_the_picture(tmp_path: Path) -> None:
    (picture,) = pictures(1)
    write(tmp_path / "a.png", [picture], 1)
    with Image.open(tmp_path / "a.png") as seen:
        assert np.array_equal(np.asarray(seen), picture)


@pytest.mark.parametrize(
    ("name", "count"), [("a.gif", 0), ("a.webp", 0), ("a.png", 0), ("a.png", 2)]
)
def test_wrong_number_of_pictures_is_refused(tmp_path: Path, name: str, count: int) -> None:
    with pytest.raises(ValueError, match="picture"):
        write(tmp_path / name, pictures(count), 10)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["a.avi", "a", ".gif", "a.gif.txt"])
def test_unknown_suffix_lists_the_known(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"\.gif, \.webp, \.mp4, \.png"):
        write(tmp_path / name, pictures(1), 10)


def test_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=f"there is no folder {tmp_path / 'absent'}"):
        check_film(tmp_path / "absent" / "a.gif")


def test_file_in_place_of_the_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=f"there is no folder {tmp_path / 'file'}"):
        check_film(tmp_path / "file" / "a.gif")


def test_folder_that_takes_no_files_is_named() -> None:
    # Not even the superuser can put a file there.
    with pytest.raises(InputError, match="cannot write to /proc"):
        check_film(Path("/proc/a.gif"))


def test_folder_in_place_of_the_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.gif").mkdir()
    with pytest.raises(InputError, match="it is a folder"):
        check_film(tmp_path / "a.gif")


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_interrupted_film_leaves_the_old_one(tmp_path: Path, suffix: str) -> None:
    if suffix == ".mp4":
        pytest.importorskip("imageio_ffmpeg")
    target = tmp_path / f"a{suffix}"
    target.write_bytes(b"old")

    def broken() -> Iterator[Picture]:
        yield from pictures(2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write(target, broken(), 10)
    assert list(tmp_path.iterdir()) == [target]
    assert target.read_bytes() == b"old"
