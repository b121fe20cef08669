"""`plutoc fmt`, as a person calls it."""

from __future__ import annotations

import errno
import io
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc.cli.changes import rewrite
from plutoc.cli.endings import UsageError
from plutoc.format import run
from tests.compiler.cli.conftest import APP, Call, tree

UNTIDY = APP.replace("  watch ->", "\n\n\twatch->").replace(" = ", "=").replace("50 mg", "50mg")
TIDY = APP.replace("  watch -> ", "\n  watch -> ")
ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
MISTAKE = "pluto 1\napp a {\n  b ->\n}\n"


def give(text: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a text be what comes from standard input."""
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text), encoding="ascii"))


def test_a_source_becomes_canonical_and_stays_so(plutoc: Call, app: Path, here: Path) -> None:
    """It says what it did; nothing else is written."""
    app.write_text(UNTIDY)
    said = plutoc("fmt", app)
    assert (said.code, said.out, said.err) == (0, "crop.pluto: formatted\n", "")
    assert app.read_text() == TIDY
    assert sorted(tree(here)) == ["crop.pluto", "missions.toml"]
    before = app.stat()
    assert plutoc("fmt", app).out == "crop.pluto: nothing to change\n"
    assert (app.stat().st_mtime_ns, app.stat().st_ino) == (before.st_mtime_ns, before.st_ino)


def test_check_writes_nothing_and_ends_with_1_if_something_would_change(
    plutoc: Call, app: Path
) -> None:
    """And says what would mend it."""
    assert plutoc("fmt", "--check", app).code == 0
    app.write_text(UNTIDY)
    said = plutoc("fmt", app, "--check")
    assert (said.code, said.out) == (1, "")
    assert said.err == "crop.pluto is not in canonical form: `plutoc fmt crop.pluto` does it\n"
    assert app.read_text() == UNTIDY


def test_a_diff_is_printed_and_can_be_applied(plutoc: Call, app: Path) -> None:
    """It writes nothing; with `--check` the exit code tells, too."""
    assert plutoc("fmt", app, "--diff").out == ""
    app.write_bytes(UNTIDY.replace("\n", "\r\n").encode("utf-8-sig"))
    said = plutoc("fmt", app, "--diff")
    assert (said.code, said.err) == (0, "")
    assert said.out.startswith("diff --git a/crop.pluto b/crop.pluto\n--- a/crop.pluto\n+++ b/")
    assert app.read_bytes().startswith(b"\xef\xbb\xbfpluto 1\r\n")
    assert plutoc("fmt", app, "--diff", "--check").code == 1
    patch = subprocess.run(
        [sys.executable, "-m", "plutoc", "fmt", app, "--diff"],
        env=ENVIRONMENT,
        capture_output=True,
        check=True,
    ).stdout
    subprocess.run(["git", "apply"], input=patch, check=True)
    assert app.read_text() == TIDY


def test_several_files_are_all_done(plutoc: Call, app: Path) -> None:
    """What is wrong with one does not stop the others; the worst exit code counts."""
    app.write_text(UNTIDY)
    Path("bad.pluto").write_text(MISTAKE)
    Path("other.pluto").write_text(UNTIDY)
    said = plutoc("fmt", "bad.pluto", app, "other.pluto")
    assert said.code == 1
    assert "--> bad.pluto:3:7" in said.err
    assert said.out == "crop.pluto: formatted\nother.pluto: formatted\n"
    assert Path("bad.pluto").read_text() == MISTAKE
    assert Path("other.pluto").read_text() == TIDY
    said = plutoc("fmt", "none.pluto", "bad.pluto", app)
    assert said.code == 2
    assert "there is no file none.pluto" in said.err
    assert "bad.pluto:3" in said.err


def test_line_ends_and_marks_of_windows_go(plutoc: Call, app: Path) -> None:
    """Also where nothing else would change."""
    app.write_bytes(APP.replace("\n", "\r\n").encode("utf-8-sig"))
    assert plutoc("fmt", app).code == 0
    assert app.read_bytes() == APP.encode()


def test_standard_input_goes_to_standard_output(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In UTF-8, whether the terminal knows it or not."""
    text = UNTIDY.replace("Crop watch", "Ünkräut 日本")
    give(text.encode(), monkeypatch)
    said = plutoc("fmt", "-")
    assert (said.code, said.out, said.err) == (0, TIDY.replace("Crop watch", "Ünkräut 日本"), "")
    assert not tree(here)


def test_standard_input_can_be_checked_and_compared(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a file can."""
    give(UNTIDY.encode(), monkeypatch)
    said = plutoc("fmt", "-", "--check")
    assert (said.code, said.out, said.err) == (1, "", "<stdin> is not in canonical form\n")
    give(APP.encode(), monkeypatch)
    assert (said := plutoc("fmt", "-", "--check")).code == 0 and not said.out
    give(UNTIDY.encode(), monkeypatch)
    said = plutoc("fmt", "-", "--diff")
    assert said.code == 0
    assert "+++ b/<stdin>\n" in said.out


@pytest.mark.parametrize(
    ("text", "code", "sentence"),
    [
        (MISTAKE.encode(), 1, "--> <stdin>:3:7"),
        (b"pluto 1\n\xff", 2, "standard input is not UTF-8 text: see line 2"),
        (b"#" * (1 << 20) + b"\n", 2, "standard input is larger than 1024 KiB"),
        (b"", 1, "P0015"),
    ],
)
def test_what_is_wrong_with_standard_input_is_said(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch, text: bytes, code: int, sentence: str
) -> None:
    """And nothing goes to standard output: an editor would take it for the source."""
    give(text, monkeypatch)
    said = plutoc("fmt", "-")
    assert (said.code, said.out) == (code, "")
    assert sentence in said.err


def test_standard_input_stands_alone(plutoc: Call, app: Path) -> None:
    """With files it would not be clear what goes where."""
    said = plutoc("fmt", "-", app)
    assert said.code == 2
    assert "cannot be formatted together with files" in said.err


def test_a_closed_standard_input_is_said(
    plutoc: Call, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program may be started without one."""
    monkeypatch.setattr(sys, "stdin", None)
    said = plutoc("fmt", "-")
    assert (said.code, said.err) == (2, "plutoc: standard input is closed\n")


@pytest.mark.skipif(os.name != "posix", reason="Windows has no permissions of this kind")
def test_permissions_are_kept(plutoc: Call, app: Path) -> None:
    """A file that other users may not read stays so."""
    app.write_text(UNTIDY)
    app.chmod(0o640)
    assert plutoc("fmt", app).code == 0
    assert stat.S_IMODE(app.stat().st_mode) == 0o640


def test_a_read_only_file_is_left_alone(plutoc: Call, app: Path) -> None:
    """Renaming could replace it, which its owner did not want."""
    app.write_text(UNTIDY)
    app.chmod(0o444)
    said = plutoc("fmt", app)
    assert (said.code, said.out) == (2, "")
    assert said.err == "plutoc: crop.pluto is read-only and was not changed\n"
    assert app.read_text() == UNTIDY
    assert plutoc("fmt", app, "--check").code == 1


@pytest.mark.skipif(os.name != "posix", reason="on Windows an ordinary user may make no link")
def test_a_link_stays_a_link(plutoc: Call, app: Path) -> None:
    """What it leads to is formatted."""
    app.write_text(UNTIDY)
    Path("deep").mkdir()
    link = Path("deep/link.pluto")
    link.symlink_to(Path("..") / app)
    assert plutoc("fmt", link).code == 0
    assert link.is_symlink()
    assert app.read_text() == TIDY
    assert os.listdir("deep") == ["link.pluto"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_what_is_no_ordinary_file_is_not_replaced(app: Path) -> None:
    """A pipe would be gone afterwards."""
    os.mkfifo("pipe")
    with pytest.raises(UsageError, match="pipe is no ordinary file and was not changed"):
        rewrite(Path("pipe"), "a", "b")
    assert stat.S_ISFIFO(os.stat("pipe").st_mode)


@pytest.mark.parametrize(
    ("failure", "code"),
    [(OSError(errno.ENOSPC, "No space left on device"), 2), (KeyboardInterrupt(), 130)],
)
@pytest.mark.parametrize("at", ["replace", "save"])
def test_any_end_in_between_leaves_the_old_source(
    plutoc: Call,
    app: Path,
    here: Path,
    monkeypatch: pytest.MonkeyPatch,
    failure: BaseException,
    code: int,
    at: str,
) -> None:
    """A full disk or Ctrl-C, while the new one is written or just before it is there."""

    def fail(*_: object) -> None:
        raise failure

    app.write_text(UNTIDY)
    before = tree(here)
    with monkeypatch.context() as patched:
        patched.setattr(
            *((os, "replace", fail) if at == "replace" else (Path, "write_bytes", fail))
        )
        said = plutoc("fmt", app)
    assert said.code == code
    assert tree(here) == before
    assert "crop.pluto was not changed" in said.err or code == 130


def test_the_new_source_comes_into_its_place_at_once(
    app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Until the rename the old one is there, whole: a kill finds one of the two."""
    app.write_text(UNTIDY)
    seen: list[str] = []
    replace = os.replace

    def replacing(source: Path, target: Path) -> None:
        seen.append(app.read_text())
        replace(source, target)
        seen.append(app.read_text())

    monkeypatch.setattr(os, "replace", replacing)
    rewrite(app, UNTIDY, TIDY)
    assert seen == [UNTIDY, TIDY]


@pytest.mark.skipif(os.name != "posix", reason="Windows has no SIGKILL")
@pytest.mark.parametrize(
    "moment",
    [
        "Path.write_bytes = lambda path, data: (open(path, 'wb').write(data[:9]), die())",
        "os.replace = die",
    ],
)
def test_a_kill_in_the_middle_leaves_the_old_source(plutoc: Call, app: Path, moment: str) -> None:
    """And the next run does what that one did not."""
    app.write_text(UNTIDY)
    program = (
        "import os, signal, sys\n"
        "from pathlib import Path\n"
        "from plutoc.cli import main\n"
        "def die(*_): os.kill(os.getpid(), signal.SIGKILL)\n"
        f"{moment}\n"
        "main(['fmt', 'crop.pluto'])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], env=ENVIRONMENT, check=False)
    assert done.returncode == -signal.SIGKILL
    assert app.read_text() == UNTIDY
    assert plutoc("fmt", app).code == 0
    assert app.read_text() == TIDY


def test_a_mistake_of_ours_destroys_nothing(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is an internal error, and the source stays."""
    app.write_text(UNTIDY)
    monkeypatch.setattr(run, "canonical", lambda text: TIDY.replace("retry -> end", "watch -> end"))
    said = plutoc("fmt", app)
    assert said.code == 70
    assert "P9001" in said.err
    assert app.read_text() == UNTIDY
