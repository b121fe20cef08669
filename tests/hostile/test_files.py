"""Files that are no texts of a sane size: an error with a place, or a result, and never a wait."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP
from tests.kit.command import plutoc


@pytest.mark.parametrize(
    ("data", "code", "said"),
    [
        (APP.encode().replace(b"\n", b"\r\n"), 0, "no errors"),
        (b"\xef\xbb\xbf" + APP.encode(), 0, "no errors"),
        (APP.encode().replace(b"\n", b"\r"), 1, "U+000D"),
        (APP.encode() + b"\0", 1, "error[P0"),
        (APP.encode().replace(b"Crop", b"Cr\0p"), 1, "P0004"),
        (APP.encode().replace(b"Crop", b"Cr\x1b[31mp"), 1, "P0004"),
        (APP.encode().replace(b"Crop", "Cr\N{RIGHT-TO-LEFT OVERRIDE}p".encode()), 1, "P0004"),
        (APP.encode().replace(b"Crop", "Cr\N{BYTE ORDER MARK}p".encode()), 1, "P0004"),
        (APP.encode().replace(b"judge", "jud\N{CYRILLIC SMALL LETTER IE}g".encode()), 1, "P1"),
        (APP.encode().replace(b"Crop", b"Cr\xedop"), 2, "is not UTF-8 text: see line 3"),
        (APP.encode().replace(b"Crop", b"\xed\xa0\x80"), 2, "is not UTF-8 text: see line 3"),
        (APP.encode("utf-16"), 2, "is not UTF-8 text: see line 1"),
        (APP.encode("utf-32-le"), 1, "error[P0"),
        (b"", 1, "P0015"),
        (b"\xef\xbb\xbf", 1, "P0015"),
        (b"\n" * 100_000, 1, "P0015"),
        (APP.encode() + b"#" * (1 << 20), 2, "P0006"),
    ],
    ids=range(17),
)
def test_an_odd_file_is_read_or_refused(here: Path, data: bytes, code: int, said: str) -> None:
    """The same by `check` and by `compile`; what is refused leaves nothing behind."""
    Path("crop.pluto").write_bytes(data)
    checked = plutoc("check", "crop.pluto")
    assert checked.code == code
    assert said in checked.out + checked.err
    assert "\x1b" not in checked.err
    compiled = plutoc("compile", "crop.pluto")
    assert compiled.code == code
    assert sorted(os.listdir(here)) == (["crop", "crop.pluto"] if code == 0 else ["crop.pluto"])


def test_what_is_no_file_is_refused(here: Path) -> None:
    """A folder, a device that never ends, a pipe into which nothing is written, links in a circle."""
    Path("folder.pluto").mkdir()
    os.mkfifo("pipe.pluto")
    Path("zero.pluto").symlink_to("/dev/zero")
    Path("null.pluto").symlink_to(os.devnull)
    Path("gone.pluto").symlink_to("nowhere")
    Path("loop.pluto").symlink_to("loop.pluto")
    said = {
        "folder": (2, "is a folder, not a file"),
        "pipe": (1, "P0015"),
        "zero": (2, "P0006"),
        "null": (1, "P0015"),
        "gone": (2, "there is no file"),
        "loop": (2, "cannot be read"),
        "no\0file": (2, "cannot be read"),
        "no\udcfffile": (2, "there is no file"),
        "n" * 5000: (2, "cannot be read"),
    }
    for name, (code, words) in said.items():
        for command in ("check", "compile", "graph"):
            done = plutoc(command, f"{name}.pluto")
            if (name, command) == ("folder", "check"):  # it is searched for apps
                assert (done.code, "holds no app" in done.err) == (2, True)
                continue
            assert (done.code, words in done.err) == (code, True), (name, command, done)


def test_a_pipe_into_which_something_is_written_is_read(here: Path) -> None:
    """As a shell hands it on: `plutoc check <(make-an-app)`."""
    reading, writing = os.pipe()
    os.write(writing, APP.encode())
    os.close(writing)
    try:
        assert plutoc("check", f"/dev/fd/{reading}").code == 0
    finally:
        os.close(reading)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("(" * 10_000, "P0"),
        ("pluto 1\napp a {\n  b = Clock(x: " + "[" * 10_000 + "]" * 10_000 + ")\n}\n", "P0007"),
        ("pluto 1\napp a {\n  b = Clock(x: " + "[" * 10_000 + "\n}\n", "P0007"),
        ("{" * 10_000, "P0"),
        ("pluto 1\napp a {\n" + "a -> [" * 10_000, "P0011"),
        ("pluto 1\napp a {\n  start" + " -> a" * 20_000 + "\n}\n", "P1032"),
        ("pluto 1\napp " + "a" * 500_000 + " {\n}\n", "P1001"),
        ("pluto 1\napp a {\n  b = Clock(x: " + "9" * 500_000 + ")\n}\n", "P0012"),
        ('pluto 1\napp a "' + "\\" * 500_000, "P0002"),
        ('pluto 1\napp a "' + "x" * 500_000 + '" {\n}\n', "P2001"),
        ("pluto 1\napp a {\n" + "x = = y\n" * 10_000 + "}\n", "P0001"),
        ("pluto 1\napp a {\n" + "".join(f"x{i} = Nope\n" for i in range(10_000)) + "}\n", "P1012"),
        ("pluto 1\napp a {\n" + "x = Clock\n" * 10_000 + "}\n", "P1005"),
        ("pluto 1\n" + "use nothing\n" * 10_000 + "app a {\n}\n", "P1008"),
        (";" * 300_000, "P0"),
        ("pluto 1\napp a {" + "\t" * 500_000 + "}", "P2001"),
        ("pluto 1\napp a {\n" + "}\n" * 60_000, "P0017"),
        ("pluto 1\napp a {\n}\n}\n" + "x {\n" * 40_000, "P0"),
        ("pluto 1\napp a {\n  category c can " + ", ".join(f"x{i}" for i in range(25_000)), "P0"),
        ("pluto 1\napp a {\n  category c can " + "measure, " * 25_000 + "measure\n}\n", "P2001"),
    ],
    ids=range(20),
)
def test_much_of_anything_is_refused_in_a_few_lines(here: Path, text: str, code: str) -> None:
    """Deep brackets, long lines, long names, ten thousand mistakes."""
    Path("a.pluto").write_text(text)
    done = plutoc("check", "a.pluto")
    assert done.code == 1
    assert f"error[{code}" in done.err
    assert len(done.err) < 20_000
    assert max(map(len, done.err.splitlines())) < 400
