"""Two branches that both compiled, merged by Git: who has merged the app has only to compile."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call, tree

FLOW, LOCK = Path("crop/src/crop/flow.py"), Path("crop/pluto.lock")
OURS = ("max_attempts: 3", "max_attempts: 5")
THEIRS = ("dose: mass = 50 mg", "dose: mass = 70 mg")
NEAR = ("max_attempts: 3", "max_attempts: 9")
"""In the same line as `OURS`: so in the app itself both sides collide."""
MORE = ("  start -> create -> allocate", "  rest = Clock\n\n  start -> create -> rest -> allocate")
AS_TEXT = "* merge\n"
"""Attributes with which Git merges every file line by line, as in packages of before."""

Merge = Callable[..., None]


def git(*arguments: str, code: int = 0) -> str:
    """Run a command of Git; an author is needed, and nothing of the user's own settings."""
    settings = ("user.name=a", "user.email=a@b", "core.autocrlf=false", "commit.gpgsign=false")
    given = [part for setting in settings for part in ("-c", setting)]
    done = subprocess.run(["git", *given, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


def changed(text: str, *edits: tuple[str, str]) -> str:
    """Return a text with some words in place of others."""
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    return text


@pytest.fixture
def merge(plutoc: Call, app: Path) -> Merge:
    """Compile an app on two branches, merge them, and merge the app by hand."""

    def merge(
        ours: tuple[str, str], theirs: tuple[str, str], *, style: str = "merge", info: str = ""
    ) -> None:
        git("init", "-q", "-b", "main")
        git("config", "merge.conflictStyle", style)
        Path(".git/info").mkdir(exist_ok=True)
        Path(".git/info/attributes").write_text(info)
        assert plutoc("compile", app).code == 0
        git("add", "-A")
        git("commit", "-qm", "base")
        for branch, edit in (("theirs", theirs), ("ours", ours)):
            git("checkout", "-q", "-b", branch, "main")
            app.write_text(changed(APP, edit))
            assert plutoc("compile", app).code == 0
            git("commit", "-qam", branch)
        git("merge", "theirs", code=1)
        assert "<<<<<<< " in LOCK.read_text()
        both = (ours, theirs) if ours[0] != theirs[0] else (ours,)
        app.write_text(changed(APP, *both))

    return merge


def assert_is_as_new(plutoc: Call, app: Path) -> None:
    """Compare the package with one that is compiled anew, but for what is the developer's."""
    assert plutoc("compile", app, "-o", "fresh").code == 0
    found, wanted = tree(Path("crop")), tree(Path("fresh"))
    for own in ("src/crop/hooks.py", "tests/test_hooks.py"):
        assert found.pop(own).startswith(wanted.pop(own).partition(b"\n")[0])
    assert found == wanted


@pytest.mark.parametrize("style", ["merge", "diff3", "zdiff3"])
@pytest.mark.parametrize("info", ["", AS_TEXT], ids=["our attributes", "as text"])
@pytest.mark.parametrize(
    ("ours", "theirs"), [(OURS, THEIRS), (OURS, NEAR), (THEIRS, MORE)], ids=["far", "near", "graph"]
)
def test_compile_settles_a_merge(
    plutoc: Call,
    app: Path,
    merge: Merge,
    style: str,
    info: str,
    ours: tuple[str, str],
    theirs: tuple[str, str],
) -> None:
    """Only the app was merged by hand; `--check` says before that it is not done yet."""
    merge(ours, theirs, style=style, info=info)
    before = tree(Path("crop"))
    said = plutoc("compile", app, "--check")
    assert said.code == 1
    assert "[P4008]: `crop` is out of date since a merge: " in said.err
    assert "run `plutoc compile crop.pluto`, which settles the generated files" in said.err
    assert tree(Path("crop")) == before
    said = plutoc("compile", app)
    assert (said.code, said.err) == (0, "")
    assert " changed, and a merge is settled\n" in said.out
    assert plutoc("compile", app, "--check").code == 0
    assert_is_as_new(plutoc, app)


def test_a_merge_of_lines_mixes_no_generated_file(app: Path, merge: Merge) -> None:
    """What was changed on both sides is left as ours, and Git says so: no attribute is set up."""
    merge(OURS, THEIRS)
    assert git("diff", "--name-only", "--diff-filter=U").split() == [str(LOCK), str(FLOW)]
    assert FLOW.read_text() == git("show", f"ours:{FLOW}")


def test_every_file_that_hangs_on_the_graph_is_kept_from_being_mixed(
    plutoc: Call, app: Path
) -> None:
    """But for the lock, whose two sides are needed, and for what is the developer's own."""
    plutoc("compile", app)
    app.write_text(changed(APP, OURS, THEIRS, MORE, ("Crop watch", "Crops")))
    plutoc("compile", app, "-o", "other")
    git("init", "-q", "crop")
    first, second = tree(Path("crop")), tree(Path("other"))
    paths = [path for path in second if first.get(path) != second[path] and path != "pluto.lock"]
    for path, value in [
        *((path, "unset") for path in paths if not path.endswith("hooks.py")),
        ("pluto.lock", "unspecified"),
        ("src/crop/hooks.py", "unspecified"),
        ("tests/test_hooks.py", "unspecified"),
        ("src/crop/own.py", "unspecified"),
    ]:
        told = git("-C", "crop", "check-attr", "merge", path)
        assert told == f"{path}: merge: {value}\n"
    assert "src/crop/flow.py" in paths


@pytest.mark.parametrize("info", ["", AS_TEXT], ids=["our attributes", "as text"])
def test_an_edit_by_hand_is_not_lost_in_a_merge(
    plutoc: Call, app: Path, merge: Merge, info: str
) -> None:
    """Neither outside of the marks, nor in one of the sides, nor in a file without any."""
    merge(OURS, NEAR, info=info)
    for path in (FLOW, Path("crop/README.md")):
        whole = path.read_text()
        path.write_text(whole + "# mine\n")
        before = tree(Path("crop"))
        for arguments in ([], ["--check"]):
            said = plutoc("compile", app, *arguments)
            assert said.code == 3
            assert f"[P4001]: `{path}` " in said.err
        assert tree(Path("crop")) == before
        path.write_text(whole)
    assert plutoc("compile", app).code == 0


def test_a_lock_of_one_side_only_is_told_how_to_get_both(
    plutoc: Call, app: Path, merge: Merge
) -> None:
    """The marks in the file are pointed at; what the message says does help."""
    merge(OURS, NEAR, info=AS_TEXT)
    git("checkout", "--ours", str(LOCK))
    git("add", str(LOCK))
    said = plutoc("compile", app)
    assert said.code == 3
    assert "[P4001]: `crop/src/crop/flow.py` has the marks of a merge in it" in said.err
    assert "<<<<<<< HEAD" in said.err
    assert "`git checkout --merge crop/pluto.lock` brings both sides" in said.err
    git("checkout", "--merge", str(LOCK))
    assert plutoc("compile", app).code == 0
    assert_is_as_new(plutoc, app)


def test_a_lock_with_the_lines_of_both_sides_is_read_as_both(
    plutoc: Call, app: Path, merge: Merge
) -> None:
    """Only the marks were taken out, as Git does by itself where it is told `merge=union`."""
    merge(OURS, NEAR, info=AS_TEXT)
    lines = LOCK.read_text().splitlines(keepends=True)
    marks = ("<<<<<<<", "=======", ">>>>>>>")
    LOCK.write_text("".join(line for line in lines if not line.startswith(marks)))
    assert plutoc("compile", app, "--check").code == 1
    assert plutoc("compile", app).code == 0
    assert_is_as_new(plutoc, app)


def test_marks_in_a_file_are_settled_where_the_lock_is_whole(plutoc: Call, app: Path) -> None:
    """Both sides of it are one text that was written, as where two branches say the same."""
    plutoc("compile", app)
    text = FLOW.read_text()
    first, rest = text.split("\n", 1)
    FLOW.write_text(f"<<<<<<< HEAD\n{first}\n=======\n{first}\n>>>>>>> other\n{rest}")
    assert "out of date since a merge" in plutoc("compile", app, "--check").err
    assert plutoc("compile", app).code == 0
    assert FLOW.read_text() == text


def test_a_file_that_only_one_side_has_is_ours(plutoc: Call, app: Path) -> None:
    """It goes where the merged app does not need it."""
    plutoc("compile", app)
    module = Path("crop/src/crop/_runtime/blocks/priority_manager.py")
    line = next(one for one in LOCK.read_text().splitlines() if module.name in one)
    marked = f"<<<<<<< HEAD\n=======\n{line}\n>>>>>>> theirs"
    LOCK.write_text(LOCK.read_text().replace(line, marked))
    app.write_text("".join(line for line in APP.splitlines(True) if "retry" not in line))
    assert plutoc("compile", app).code == 0
    assert not module.exists()
    assert_is_as_new(plutoc, app)
