"""Two branches that both compiled, merged: who has merged the app has only to compile."""

from __future__ import annotations

from difflib import SequenceMatcher
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.compiler.cli.conftest import APP, FOLDER, tree
from tests.kit.command import command, plutoc

FLOW, LOCK = Path("crop/src/crop/flow.py"), Path("crop/pluto.lock")
OWN = ("src/crop/hooks.py", "tests/test_hooks.py")
"""What is made once, and the developer's from then on."""
Edit = tuple[str, str]
OURS = ("max_attempts: 3", "max_attempts: 5")
THEIRS = ("dose: mass = 50 mg", "dose: mass = 70 mg")
NEAR = ("max_attempts: 3", "max_attempts: 9")
"""In the same line as `OURS`: so in the app itself both sides collide."""
MORE = ("  start -> create -> allocate", "  rest = Clock\n\n  start -> create -> rest -> allocate")


def changed(*edits: Edit) -> str:
    """Return the app with some words in place of others."""
    text = APP
    for old, new in edits:
        assert old in text
        text = text.replace(old, new)
    return text


@cache
def package_of(text: str) -> dict[str, bytes]:
    """Return the files of an app's package, compiled once for all tests."""
    with TemporaryDirectory() as folder:
        app, package = Path(folder, "crop.pluto"), Path(folder, "crop")
        app.write_text(text)
        assert plutoc("compile", app, "-o", package).code == 0
        return tree(package)


def conflict(base: list[str], ours: list[str], theirs: list[str], style: str) -> str:
    """Return the lines of two sides with the marks of Git around those that differ."""
    middle = ["||||||| base\n", *base] if style == "diff3" else []
    merged: list[str] = []
    for what, a, b, c, d in SequenceMatcher(None, ours, theirs, autojunk=False).get_opcodes():
        if what == "equal":
            merged += ours[a:b]
        else:
            side = [*middle, "=======\n", *theirs[c:d], ">>>>>>> theirs\n"]
            merged += ["<<<<<<< HEAD\n", *ours[a:b], *side]
    return "".join(merged)


def merge(
    app: Path, ours: Edit, theirs: Edit, style: str = "merge", alone: Path | None = None
) -> None:
    """Compile an app on two branches, merge its package line by line, and the app by hand.

    The file `alone` is left as it is on our side.
    """
    sides = [dict(package_of(changed(*edits))) for edits in ((), (ours,), (theirs,))]
    for name, data in sides[1].items():
        if data != FOLDER:
            Path("crop", name).parent.mkdir(parents=True, exist_ok=True)
            Path("crop", name).write_bytes(data)
    for side in sides:
        for own in OWN:
            del side[own]
    for name in sides[1].keys() & sides[2].keys():
        base, mine, other = (
            side.get(name, b"").decode().splitlines(keepends=True) for side in sides
        )
        if mine != other and Path("crop", name) != alone:
            Path("crop", name).write_text(conflict(base, mine, other, style))
    for name in sides[2].keys() - sides[1].keys():
        Path("crop", name).write_bytes(sides[2][name])
    assert "<<<<<<< " in LOCK.read_text() or alone == LOCK
    app.write_text(changed(*((ours, theirs) if ours[0] != theirs[0] else (ours,))))


def assert_is_as_new(app: Path) -> None:
    """Compare the package with one that is compiled anew, but for what is the developer's."""
    found, wanted = tree(Path("crop")), dict(package_of(app.read_text()))
    for own in OWN:
        assert found.pop(own).startswith(wanted.pop(own).partition(b"\n")[0])
    assert found == wanted


@pytest.mark.parametrize(
    ("style", "ours", "theirs"),
    [("merge", OURS, THEIRS), ("diff3", OURS, NEAR), ("merge", THEIRS, MORE)],
    ids=["far", "near", "graph"],
)
def test_compile_settles_a_merge(app: Path, style: str, ours: Edit, theirs: Edit) -> None:
    """Only the app was merged by hand; `--check` says before that it is not done yet."""
    merge(app, ours, theirs, style)
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
    assert_is_as_new(app)


def git(*words: str, code: int = 0) -> str:
    """Run a command of Git; an author is needed, and nothing of the user's own settings."""
    settings = ("user.name=a", "user.email=a@b", "core.autocrlf=false", "commit.gpgsign=false")
    done = command("git", *(part for one in settings for part in ("-c", one)), *words)
    assert done.code == code, done.out + done.err
    return done.out


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("style", ["merge", "diff3", "zdiff3"])
@pytest.mark.parametrize("info", ["", "* merge\n"], ids=["our attributes", "as text"])
@pytest.mark.parametrize(
    ("ours", "theirs"), [(OURS, THEIRS), (OURS, NEAR), (THEIRS, MORE)], ids=["far", "near", "graph"]
)
def test_what_git_merges_is_settled(
    app: Path, style: str, info: str, ours: Edit, theirs: Edit
) -> None:
    """By our attributes, which keep it from mixing generated files, and by others."""
    git("init", "-q", "-b", "main")
    git("config", "merge.conflictStyle", style)
    Path(".git/info").mkdir(exist_ok=True)
    Path(".git/info/attributes").write_text(info)
    assert plutoc("compile", app).code == 0
    git("add", "-A")
    git("commit", "-qm", "base")
    for branch, edit in (("theirs", theirs), ("ours", ours)):
        git("checkout", "-q", "-b", branch, "main")
        app.write_text(changed(edit))
        assert plutoc("compile", app).code == 0
        git("commit", "-qam", branch)
    git("merge", "theirs", code=1)
    if not info:
        assert FLOW.read_text() == git("show", f"ours:{FLOW}")
    app.write_text(changed(*((ours, theirs) if ours[0] != theirs[0] else (ours,))))
    assert plutoc("compile", app).code == 0
    assert_is_as_new(app)


def test_an_edit_by_hand_is_not_lost_in_a_merge(app: Path) -> None:
    """Neither outside of the marks, nor in one of the sides, nor in a file without any."""
    merge(app, OURS, NEAR)
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


def test_a_lock_of_one_side_only_is_told_how_to_get_both(app: Path) -> None:
    """The marks in the file are pointed at."""
    merge(app, OURS, NEAR, alone=LOCK)
    said = plutoc("compile", app)
    assert said.code == 3
    assert "[P4001]: `crop/src/crop/flow.py` has the marks of a merge in it" in said.err
    assert "<<<<<<< HEAD" in said.err
    assert "`git checkout --merge crop/pluto.lock` brings both sides" in said.err


def test_marks_in_a_file_are_settled_where_the_lock_is_whole(app: Path) -> None:
    """Both sides of it are one text that was written, as where two branches say the same."""
    plutoc("compile", app)
    text = FLOW.read_text()
    first, rest = text.split("\n", 1)
    FLOW.write_text(f"<<<<<<< HEAD\n{first}\n=======\n{first}\n>>>>>>> other\n{rest}")
    assert "out of date since a merge" in plutoc("compile", app, "--check").err
    assert plutoc("compile", app).code == 0
    assert FLOW.read_text() == text


def test_a_file_that_only_one_side_has_is_ours(app: Path) -> None:
    """It goes where the merged app does not need it."""
    plutoc("compile", app)
    module = Path("crop/src/crop/_runtime/blocks/priority_manager.py")
    line = next(one for one in LOCK.read_text().splitlines() if module.name in one)
    marked = f"<<<<<<< HEAD\n=======\n{line}\n>>>>>>> theirs"
    LOCK.write_text(LOCK.read_text().replace(line, marked))
    app.write_text("".join(line for line in APP.splitlines(True) if "retry" not in line))
    assert plutoc("compile", app).code == 0
    assert not module.exists()
    assert_is_as_new(app)
