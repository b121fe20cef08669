"""`plutoc compile`, as a person calls it: what is written, what is refused, and exit codes."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from plutoc.emit import lock, write
from tests.compiler.cli.conftest import APP, Call, tree

FLOW, HOOKS, LOCK = Path("crop/src/crop/flow.py"), Path("crop/src/crop/hooks.py"), "crop/pluto.lock"
CHANGED = APP.replace("max_attempts: 3", "max_attempts: 5")


def test_a_package_goes_beside_the_app(plutoc: Call, app: Path) -> None:
    """Into a folder named after the app; the command says what to do next."""
    said = plutoc("compile", app)
    assert (said.code, said.err) == (0, "")
    assert said.out.startswith("crop: a new package of ")
    assert "pip install -e ./crop; by -e what you edit there counts at once" in said.out
    assert FLOW.is_file()
    assert HOOKS.is_file()


def test_a_package_goes_where_it_is_told(plutoc: Call, app: Path, here: Path) -> None:
    """Folders on the way are made."""
    assert plutoc("compile", app, "-o", "deep/down/package").code == 0
    assert Path("deep/down/package/pluto.lock").is_file()
    assert sorted(os.listdir()) == ["crop.pluto", "deep", "missions.toml"]


def test_an_empty_folder_will_do(plutoc: Call, app: Path) -> None:
    """Such as one that was made for it."""
    Path("crop").mkdir()
    assert plutoc("compile", app).code == 0
    assert FLOW.is_file()


def test_compiling_again_changes_nothing(plutoc: Call, app: Path, here: Path) -> None:
    """Not even a file's time."""
    plutoc("compile", app)
    before, times = tree(here), FLOW.stat().st_mtime_ns
    said = plutoc("compile", app)
    assert (said.code, said.out) == (0, "crop: up to date\n")
    assert tree(here) == before
    assert FLOW.stat().st_mtime_ns == times
    assert plutoc("compile", app, "--check").code == 0


def test_an_edit_of_the_app_changes_few_files(plutoc: Call, app: Path) -> None:
    """They are named; hooks.py is never touched."""
    plutoc("compile", app)
    HOOKS.write_text(HOOKS.read_text() + "\n# mine\n")
    app.write_text(CHANGED)
    said = plutoc("compile", app)
    assert said.code == 0
    assert "crop: 2 files changed" in said.out
    assert "  ~ src/crop/flow.py\n" in said.out
    assert "max_attempts=5" in FLOW.read_text()
    assert HOOKS.read_text().endswith("\n# mine\n")


def test_check_writes_nothing_and_ends_with_1_on_drift(plutoc: Call, app: Path, here: Path) -> None:
    """It names the files that would change."""
    plutoc("compile", app)
    app.write_text(CHANGED)
    before = tree(here)
    said = plutoc("compile", app, "--check")
    assert said.code == 1
    assert "[P4008]" in said.err
    assert "src/crop/flow.py" in said.err
    assert tree(here) == before


def test_check_of_what_was_never_generated_ends_with_1(plutoc: Call, app: Path) -> None:
    """With a sentence."""
    said = plutoc("compile", app, "--check")
    assert said.code == 1
    assert "[P4007]: there is no package in `crop` yet" in said.err
    assert "help: run `plutoc compile crop.pluto`\n" in said.err
    assert not Path("crop").exists()


def test_check_of_another_folder_says_how_to_write_that_one(plutoc: Call, app: Path) -> None:
    """With its `-o`, and so that a shell reads it."""
    command = "`plutoc compile crop.pluto -o 'over there'`"
    said = plutoc("compile", app, "-o", "over there", "--check")
    assert f"help: run {command}\n" in said.err
    plutoc("compile", app, "-o", "over there")
    app.write_text(CHANGED)
    assert f"help: run {command};" in plutoc("compile", app, "-o", "over there", "--check").err


def test_diff_prints_a_patch_and_writes_nothing(plutoc: Call, app: Path, here: Path) -> None:
    """Alone it ends with 0, with `--check` with 1."""
    plutoc("compile", app)
    app.write_text(CHANGED)
    before = tree(here)
    said = plutoc("compile", app, "--diff")
    assert said.code == 0
    assert "--- a/src/crop/flow.py\n+++ b/src/crop/flow.py\n" in said.out
    assert "# retry = PriorityManager(max_attempts: 5)\n" in said.out
    assert tree(here) == before
    both = plutoc("compile", app, "--check", "--diff")
    assert (both.code, both.out) == (1, said.out)


def test_the_patch_of_diff_makes_the_package(plutoc: Call, app: Path, here: Path) -> None:
    """`patch` understands it."""
    plutoc("compile", app, "-o", "wanted")
    patch = plutoc("compile", app, "--diff").out
    Path("crop").mkdir()
    done = subprocess.run(["git", "apply", "-"], input=patch, text=True, cwd="crop", check=False)
    assert done.returncode == 0
    assert tree(here / "crop") == tree(here / "wanted")


def test_a_hand_edit_is_refused_with_3(plutoc: Call, app: Path, here: Path) -> None:
    """It names the line, and where the change belongs; `--check` says the same."""
    plutoc("compile", app)
    lines = FLOW.read_text().splitlines(keepends=True)
    FLOW.write_text("".join([*lines[:9], "import os\n", *lines[9:]]))
    before = tree(here)
    for arguments in ([], ["--check"], ["--diff"]):
        said = plutoc("compile", app, *arguments)
        assert said.code == 3
        assert "[P4001]: `crop/src/crop/flow.py` was edited by hand" in said.err
        assert "crop/src/crop/flow.py:10:1" in said.err
        assert "make this change in `crop.pluto`, or in `hooks.py`" in said.err
    assert tree(here) == before
    assert plutoc("compile", app, "--force").code == 0
    assert "import os" not in FLOW.read_text()


def test_a_library_that_is_written_into_the_project_belongs_into_the_source(
    plutoc: Call, app: Path
) -> None:
    """It is said how; and said so, it gets there."""
    plutoc("compile", app)
    project = Path("crop/pyproject.toml")
    made = project.read_text()
    project.write_text(made.replace("dependencies = []", 'dependencies = ["numpy>=2"]'))
    said = plutoc("compile", app)
    assert said.code == 3
    assert "in `crop.pluto`, where `version` and `requires` say what goes into" in said.err
    project.write_text(made)
    app.write_text(APP.replace("{\n", '{\n  requires "numpy>=2"\n', 1))
    assert plutoc("compile", app).code == 0
    assert 'dependencies = [\n    "numpy>=2",\n]' in project.read_text()


def test_every_hand_edit_is_named(plutoc: Call, app: Path) -> None:
    """A phase tells all that it found."""
    plutoc("compile", app)
    for path in (FLOW, Path("crop/README.md"), Path("crop/pyproject.toml")):
        path.write_text(path.read_text() + "\nmore\n")
    said = plutoc("compile", app)
    assert "flow.py` was edited" in said.err
    assert "README.md` was edited" in said.err
    assert "where `version` and `requires` say what goes into this file" in said.err


def test_a_file_that_went_missing_is_written_again(plutoc: Call, app: Path) -> None:
    """It is drift, no hand edit."""
    plutoc("compile", app)
    FLOW.unlink()
    assert plutoc("compile", app, "--check").code == 1
    assert plutoc("compile", app).code == 0
    assert FLOW.is_file()


def test_line_ends_that_git_changed_are_no_hand_edit(plutoc: Call, app: Path) -> None:
    """A checkout on Windows may have carriage returns."""
    plutoc("compile", app)
    FLOW.write_bytes(FLOW.read_bytes().replace(b"\n", b"\r\n"))
    assert plutoc("compile", app, "--check").code == 0


def test_files_that_no_longer_belong_are_removed(plutoc: Call, app: Path) -> None:
    """With their empty folders, but not when they were edited."""
    plutoc("compile", app)
    module = Path("crop/src/crop/_runtime/blocks/priority_manager.py")
    assert module.is_file()
    less = APP.replace("  retry = PriorityManager(max_attempts: 3)\n", "")
    app.write_text("".join(line for line in less.splitlines(True) if "retry" not in line))
    edited = module.read_text() + "# mine\n"
    original = module.read_text()
    module.write_text(edited)
    said = plutoc("compile", app)
    assert said.code == 3
    assert "does not need this file any more" in said.err
    assert module.read_text() == edited
    module.write_text(original)
    said = plutoc("compile", app)
    assert said.code == 0
    assert "  - src/crop/_runtime/blocks/priority_manager.py\n" in said.out
    assert not module.exists()


def test_files_of_the_user_are_left_alone(plutoc: Call, app: Path) -> None:
    """Unless a new file of ours has their name: then it asks."""
    plutoc("compile", app)
    mine = Path("crop/src/crop/helpers.py")
    mine.write_text("mine\n")
    app.write_text(CHANGED)
    assert plutoc("compile", app).code == 0
    assert mine.read_text() == "mine\n"


def test_a_users_file_with_the_name_of_ours_is_refused(plutoc: Call, app: Path) -> None:
    """Nothing that we did not write is overwritten."""
    whole = app.read_text()
    app.write_text("".join(line for line in whole.splitlines(True) if "retry" not in line))
    plutoc("compile", app)
    mine = Path("crop/src/crop/_runtime/blocks/priority_manager.py")
    mine.write_text("mine\n")
    app.write_text(whole)
    said = plutoc("compile", app)
    assert said.code == 3
    assert "[P4002]" in said.err
    assert mine.read_text() == "mine\n"


def test_a_folder_that_is_not_ours_is_refused_with_3(plutoc: Call, app: Path, here: Path) -> None:
    """Even with `--force`, which is for hand edits."""
    Path("crop").mkdir()
    Path("crop/thesis.txt").write_text("years of work")
    before = tree(here)
    for arguments in ([], ["--force"], ["--check"], ["-o", "."]):
        said = plutoc("compile", app, *arguments)
        assert said.code == 3
        assert "[P4003]" in said.err
    assert tree(here) == before


def test_the_package_of_another_app_is_refused_with_3(plutoc: Call, app: Path) -> None:
    """Its name is in the message."""
    plutoc("compile", app)
    Path("farm.pluto").write_text(APP.replace("app crop", "app farm"))
    said = plutoc("compile", "farm.pluto", "-o", "crop")
    assert said.code == 3
    assert "[P4004]: `crop` is the package of another app, `crop`" in said.err


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"\xff", "it is no text"),
        (b"app = ", "Invalid value"),
        (b"app = 'crop'\n<<<<<<< HEAD\n", "a merge left its marks in it"),
        (b"files = {}", "it does not name the app and its files"),
        (b"app = 'crop'\n[files]\n'../x' = 'a'\n", "'../x' is no file of a package"),
        (b"app = 'crop'\n[files]\n'/etc/x' = 'a'\n", "'/etc/x' is no file of a package"),
        (b"app = 'crop'\n[files]\n'a//b' = 'a'\n", "'a//b' is no file of a package"),
        (b"app = 'crop'\n[files]\n'a' = 1\n", "'a' is no file of a package"),
    ],
)
def test_a_damaged_lock_is_refused_with_3(
    plutoc: Call, app: Path, content: bytes, why: str
) -> None:
    """What was edited cannot be known then; `--force` writes it anew."""
    plutoc("compile", app)
    Path(LOCK).write_bytes(content)
    said = plutoc("compile", app)
    assert said.code == 3
    assert "[P4005]: `crop/pluto.lock` is damaged" in said.err
    assert why in said.err
    assert plutoc("compile", app, "--force").code == 0
    assert plutoc("compile", app, "--check").code == 0


@pytest.mark.parametrize(
    ("made_by", "code"),
    [
        ('plutoc = "999.0"', 3),
        ('plutoc = "0.1.1.dev3"', 3),
        ('plutoc = "0.1.0.post1"', 3),
        ('plutoc = "0.1.10"', 3),
        ('plutoc = "0.1.0rc1"', 0),
        ('plutoc = "0.0.99"', 0),
        ("", 0),
    ],
)
@pytest.mark.parametrize("other", ["", 'survey = "survey 2.0"\n'])
def test_what_a_newer_plutoc_made_is_not_overwritten(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch, made_by: str, code: int, other: str
) -> None:
    """The order of versions is that of PEP 440; a lock that says none stops no compile."""
    for module in (lock, write):
        monkeypatch.setattr(module, "__version__", "0.1.0")
    plutoc("compile", app)
    text = Path(LOCK).read_text().replace('plutoc = "0.1.0"\n', f"{made_by}\n{other}")
    Path(LOCK).write_text(text)
    FLOW.write_bytes(FLOW.read_bytes())
    said = plutoc("compile", app)
    assert said.code == code
    if code:
        assert "[P4010]: `crop` was made by plutoc " in said.err
        assert Path(LOCK).read_text() == text
        assert plutoc("compile", app, "--check").code == 3
    assert plutoc("compile", app, "--force").code == 0
    assert plutoc("compile", app, "--check").code == 0


def test_no_link_is_followed(plutoc: Call, app: Path, here: Path, tmp_path: Path) -> None:
    """Neither the package's folder, nor one in it, nor a file."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    Path("crop").symlink_to(elsewhere)
    said = plutoc("compile", app)
    assert said.code == 3
    assert "[P4006]: `crop` is a symbolic link" in said.err
    Path("crop").unlink()
    plutoc("compile", app)
    os.rename("crop/src", tmp_path / "src")
    Path("crop/src").symlink_to(tmp_path / "src")
    assert plutoc("compile", app, "--force").code == 3
    Path("crop/src").unlink()
    os.rename(tmp_path / "src", "crop/src")
    secret = tmp_path / "secret"
    secret.write_text("secret")
    FLOW.unlink()
    FLOW.symlink_to(secret)
    app.write_text(CHANGED)
    said = plutoc("compile", app, "--force")
    assert said.code == 3
    assert "`crop/src/crop/flow.py` is a symbolic link" in said.err
    assert secret.read_text() == "secret"
    assert not list(elsewhere.iterdir())


def test_a_folder_in_the_way_of_a_file_is_refused(plutoc: Call, app: Path) -> None:
    """And a file in the way of a folder."""
    plutoc("compile", app)
    FLOW.unlink()
    FLOW.mkdir()
    assert plutoc("compile", app).code == 3
    Path("file").touch()
    said = plutoc("compile", app, "-o", "file")
    assert said.code == 3
    assert "`file` is a file, and a folder must be there" in said.err


def test_a_place_that_cannot_be_written_ends_with_2(plutoc: Call, app: Path) -> None:
    """With the reason of the system."""
    Path("file").touch()
    said = plutoc("compile", app, "-o", "file/package")
    assert said.code == 2
    assert "Not a directory; nothing was changed" in said.err


def test_tests_of_hooks_are_the_developers(plutoc: Call, app: Path) -> None:
    """They are written where there are none, and never again: a package from before keeps its own."""
    assert plutoc("compile", app).code == 0
    tests, fixtures = Path("crop/tests/test_hooks.py"), Path("crop/tests/conftest.py")
    tests.write_text("# mine\n")
    fixtures.unlink()
    assert plutoc("compile", app).code == 0
    assert tests.read_text() == "# mine\n"
    assert "from crop.testing import " in fixtures.read_text()
    fixtures.write_text("# mine, too\n")
    assert plutoc("compile", app, "--force").code == 0
    assert fixtures.read_text() == "# mine, too\n"


def test_hooks_beside_the_app_become_the_packages_first(plutoc: Call, app: Path) -> None:
    """A copy; from then on the package's own is the one that counts."""
    mine = Path("hooks.py")
    plutoc("compile", app, "-o", "drafts")
    mine.write_text(Path("drafts/src/crop/hooks.py").read_text() + "# mine\n")
    said = plutoc("compile", app)
    assert "hooks.py was copied to crop/src/crop/hooks.py" in said.out
    assert HOOKS.read_text() == mine.read_text()
    mine.write_text("broken(")
    assert plutoc("compile", app).code == 0
    assert HOOKS.read_text().endswith("# mine\n")
    assert plutoc("compile", app, "--check").code == 0


def test_a_hook_that_is_missing_ends_with_1_and_writes_nothing(
    plutoc: Call, app: Path, here: Path
) -> None:
    """Until `--add-stubs` adds it at the end."""
    plutoc("compile", app)
    HOOKS.write_text('"""Mine."""\n\nfrom . import Drone\n\nSIZE = 3\n')
    before = tree(here)
    said = plutoc("compile", app)
    assert said.code == 1
    assert said.err.count("[P3003]") == 2
    assert tree(here) == before
    assert plutoc("compile", app, "--add-stubs", "--check").code == 1
    assert tree(here) == before
    said = plutoc("compile", app, "--add-stubs")
    assert (said.code, said.err) == (0, "")
    assert "~ src/crop/hooks.py" in said.out
    text = HOOKS.read_text()
    assert text.startswith(
        '"""Mine."""\n\nfrom . import Drone\nfrom . import Context, Mission, Results, Trip, Verdict'
    )
    assert text.index("SIZE = 3") < text.index("async def pollinate") < text.index("def find_bl")
    assert plutoc("compile", app, "--add-stubs").out == "crop: up to date\n"


def test_stubs_are_added_to_a_copy_of_the_hooks_beside_the_app(plutoc: Call, app: Path) -> None:
    """The file beside the app itself stays as it is."""
    mine = Path("hooks.py")
    mine.write_text("def pollinate(drone, trip, context, *, dose): ...\n")
    assert plutoc("compile", app, "--add-stubs").code == 0
    assert "def find_blooms" in HOOKS.read_text()
    assert "def find_blooms" not in mine.read_text()


def test_errors_write_nothing(plutoc: Call, app: Path, here: Path) -> None:
    """They end with 1."""
    app.write_text(APP.replace("-> judge", "-> juge"))
    before = tree(here)
    assert plutoc("compile", app).code == 1
    assert tree(here) == before


def test_show_prints_and_writes_nothing(plutoc: Call, app: Path, here: Path) -> None:
    """The graph, or the plan."""
    before = tree(here)
    assert "flowchart TD" in plutoc("compile", app, "--show", "graph").out
    assert plutoc("compile", app, "--show", "plan").out.startswith("plan crop\n")
    assert tree(here) == before


def test_the_plan_after_each_pass_can_be_shown(plutoc: Call, app: Path) -> None:
    """`built` is the plan before all, which `-O0` keeps; a name that is none lists them."""
    built = plutoc("compile", app, "--show", "plan=built").out
    assert plutoc("compile", app, "-O0", "--show", "plan").out == built
    assert plutoc("compile", app, "--show", "plan=decided").out != built
    said = plutoc("compile", app, "--show", "plan=magic")
    assert said.code == 2
    assert "there is no such pass, only built, impossible, decided" in said.err


def test_json_says_nothing_but_diagnostics(plutoc: Call, app: Path) -> None:
    """A program reads standard output."""
    said = plutoc("compile", app, "--format", "json")
    assert (said.code, said.out, said.err) == (0, "", "")
    FLOW.write_text("mine")
    said = plutoc("compile", app, "--format", "json")
    assert said.code == 3
    assert '"code": "P4001"' in said.out
    assert not said.err


def test_the_plain_plan_can_be_asked_for(plutoc: Call, app: Path) -> None:
    """With `-O0` every fork is tasks; without, a wait for the trip's end is a single one."""
    assert plutoc("compile", app, "-O0").code == 0
    plain = FLOW.read_text()
    assert plutoc("compile", app).code == 0
    assert ("watch_trip(" in plain, "watch_trip(" in FLOW.read_text()) == (True, False)
