"""Photos come out of a station as they were taken, and small: those of this flight, and nothing else."""

from __future__ import annotations

import io
import os
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from struct import pack
from zipfile import ZipFile

import pytest
from PIL import Image

from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.results.exports import write_archive
from pluto_fleet.station.results.flights import FlightResults
from pluto_fleet.station.results.pictures import picture, small


@dataclass(kw_only=True)
class Taken:
    """A flight with one photo."""

    journal: Path
    pictures: dict[int, str] = field(default_factory=dict)
    flight: str = "flight"

    @property
    def folder(self) -> Path:
        """Where its navigation may leave pictures."""
        return gateway_folder(self.journal) / "files"

    def named(self, file: str) -> Taken:
        """Let the photo's file be this one."""
        self.pictures[1] = file
        return self


@pytest.fixture
def taken(tmp_path: Path) -> Taken:
    flight = Taken(journal=tmp_path / "flight.journal")
    flight.folder.mkdir(parents=True)
    (flight.folder / "good.png").write_bytes(_png(8, 8))
    (tmp_path / "secret.png").write_bytes(_png(8, 8))
    return flight


def _png(width: int, height: int) -> bytes:
    """Return a PNG that says of itself that it is so large, whatever there is of it."""
    header = b"IHDR" + pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    lines = b"IDAT" + zlib.compress(b"\0" * min(width * height + height, 1000))
    chunks = (header, lines, b"IEND")
    parts = (pack(">I", len(one) - 4) + one + pack(">I", zlib.crc32(one)) for one in chunks)
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def test_only_what_lies_in_the_folder_for_files_is_served(taken: Taken, tmp_path: Path) -> None:
    good = (taken.folder / "good.png").read_bytes()
    assert picture(taken.named("good.png"), 1) == (good, "image/png")
    assert picture(taken.named(str(taken.folder / "good.png")), 1) == (good, "image/png")
    (taken.folder / "link.png").symlink_to(tmp_path / "secret.png")
    (taken.folder / "ring.png").symlink_to(taken.folder / "ring.png")
    (taken.folder / "folder.png").mkdir()
    os.mkfifo(taken.folder / "pipe.png")
    wrong = ("../../secret.png", str(tmp_path / "secret.png"), "link.png", "ring.png")
    for file in (*wrong, "folder.png", "pipe.png", "nul\0.png", ""):
        with pytest.raises(BadInput):
            picture(taken.named(file), 1)


@pytest.mark.parametrize("name", ["a.svg", "a.html", "a.txt", "a", "journal"])
def test_only_pictures_are_served(taken: Taken, name: str) -> None:
    (taken.folder / name).write_text("<svg/>")
    with pytest.raises(BadInput, match="no picture that can be shown"):
        picture(taken.named(name), 1)
    (taken.folder / "a.png").write_text("<svg/>")
    with pytest.raises(BadInput, match="not the picture that its name says"):
        picture(taken.named("a.png"), 1)


def test_a_picture_that_is_gone_gets_a_sentence(taken: Taken) -> None:
    with pytest.raises(BadInput, match=r"result 1: its picture \"gone.jpg\" is not there any more"):
        picture(taken.named("gone.jpg"), 1)
    with pytest.raises(BadInput, match="result 2 has no picture"):
        picture(taken, 2)


def test_a_small_picture_is_made_once_and_turned_as_its_camera_says(
    taken: Taken, tmp_path: Path
) -> None:
    image = Image.new("RGB", (900, 600), "red")
    exif = image.getexif()
    exif[0x0112] = 6  # the camera was held upright
    image.save(taken.folder / "turned.jpg", exif=exif)
    cache = tmp_path / "thumbnails"
    made = small(taken.named("turned.jpg"), 1, cache)
    with Image.open(io.BytesIO(made)) as found:
        assert found.size == (320, 480)
    [kept] = cache.iterdir()
    kept.write_bytes(b"kept")
    assert small(taken, 1, cache) == b"kept"


@pytest.mark.parametrize("size", [(9_500, 9_000), (60_000, 60_000)])
@pytest.mark.filterwarnings("ignore::PIL.Image.DecompressionBombWarning")
def test_a_picture_of_too_many_pixels_is_not_unpacked(
    taken: Taken, tmp_path: Path, size: tuple[int, int]
) -> None:
    (taken.folder / "bomb.png").write_bytes(_png(*size))
    with pytest.raises(BadInput, match="result 1: its picture"):
        small(taken.named("bomb.png"), 1, tmp_path / "thumbnails")


def test_an_archive_says_what_it_does_not_have(taken: Taken, tmp_path: Path) -> None:
    flight = FlightResults(
        flight="flight",
        journal=taken.journal,
        rows=(),
        pictures={1: "good.png", 2: "../../secret.png", 3: "gone.png"},
    )
    with ZipFile(write_archive(flight, tmp_path / "archives")) as archive:
        assert archive.namelist() == ["results.csv", "00001.png", "missing.txt"]
        said = archive.read("missing.txt").decode()
    assert said.count("\n") == 2
    assert "gone.png" in said
