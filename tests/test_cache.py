"""What is kept between runs is given back as it was kept, or made anew."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from plutoc.cache import cache_file, cache_folder, recalled, tidy

SHELF = "shelf"


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of the test's own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "pluto"


def making(data: bytes) -> tuple[Callable[[], bytes], list[bytes]]:
    """Return how to make something, and what was made that way as yet."""
    made: list[bytes] = []

    def make() -> bytes:
        made.append(data)
        return data

    return make, made


def test_what_was_made_once_is_not_made_again() -> None:
    make, made = making(b"text")
    assert [recalled(SHELF, b"a", make) for _ in range(3)] == [b"text"] * 3
    assert made == [b"text"]


def test_what_is_made_of_something_else_is_made_anew() -> None:
    make, made = making(b"text")
    assert [recalled(SHELF, of, make) for of in (b"a", b"b")] == [b"text"] * 2
    assert len(made) == 2


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:-1],
        lambda data: data + b"!",
        lambda data: data.replace(b"text", b"test"),
        lambda data: data[:64] + b"\ntext",
        lambda data: b"0" * 64 + b"\ntext",
    ],
)
def test_what_is_not_as_it_was_kept_is_made_anew(
    damage: Callable[[bytes], bytes], home: Path
) -> None:
    """Whatever became of it; and then it is kept again."""
    make, made = making(b"text")
    recalled(SHELF, b"a", make)
    (file,) = (home / SHELF).iterdir()
    good = file.read_bytes()
    file.write_bytes(damage(good))
    recalled(SHELF, b"a", make)
    assert len(made) == (1 if damage(good) == good else 2)
    assert file.read_bytes() == good


def test_what_was_kept_of_one_thing_is_not_taken_for_another(home: Path) -> None:
    """Even if somebody puts it there."""
    recalled(SHELF, b"a", lambda: b"text of a")
    (of_a,) = (home / SHELF).iterdir()
    recalled(SHELF, b"b", lambda: b"text of b")
    (of_b,) = set((home / SHELF).iterdir()) - {of_a}
    of_b.write_bytes(of_a.read_bytes())
    assert recalled(SHELF, b"b", lambda: b"made anew") == b"made anew"


@pytest.mark.skipif(os.name != "posix", reason="permissions are otherwise elsewhere")
@pytest.mark.parametrize("which", ["", SHELF])
def test_a_folder_that_others_can_write_is_not_used(which: str, home: Path) -> None:
    """Neither the cache itself nor a shelf in it."""
    assert cache_folder(SHELF) == home / SHELF
    (home / which).chmod(0o777)
    assert cache_folder(SHELF) is None
    assert recalled(SHELF, b"a", lambda: b"text") == b"text"
    assert not list((home / SHELF).iterdir())


def test_a_link_in_place_of_a_shelf_is_not_followed(home: Path, tmp_path: Path) -> None:
    """It could lead anywhere."""
    (tmp_path / "elsewhere").mkdir()
    home.mkdir(mode=0o700)
    (home / SHELF).symlink_to(tmp_path / "elsewhere")
    assert cache_file("a", SHELF) is None


def test_of_too_much_the_oldest_is_taken_away(tmp_path: Path) -> None:
    """What was of use lately stays."""
    for time in range(5):
        (tmp_path / str(time)).write_bytes(b"0123456789")
        os.utime(tmp_path / str(time), (time, time))
    os.utime(tmp_path / "0", (9, 9))
    tidy(tmp_path, most=25)
    assert sorted(os.listdir(tmp_path)) == ["0", "4"]
    tidy(tmp_path, most=25)
    assert sorted(os.listdir(tmp_path)) == ["0", "4"]


def test_a_home_that_is_nowhere_in_particular_is_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is left in the folder that the user is in."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", "elsewhere")
    monkeypatch.setenv("USERPROFILE", "elsewhere")
    assert cache_folder(SHELF) is None
    assert not list(tmp_path.iterdir())
