"""`plutoc diff REVISION FILE`, as a person calls it in a Git repository."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call

MORE = APP.replace("max_attempts: 3", "max_attempts: 5")
MOST = APP.replace("max_attempts: 3", "max_attempts: 7")


def git(*words: str, cwd: Path | None = None) -> str:
    """Run Git, as a person whom no settings of this machine concern."""
    who = ("-c", "user.name=T", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false")
    done = subprocess.run(
        ["git", *who, *words], cwd=cwd, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


@pytest.fixture
def repository(here: Path) -> Path:
    """The app `field/crop.pluto` in two commits, and changed once more; we are at the top."""
    git("init", "-q", "-b", "main")
    (here / "field").mkdir()
    for text in (APP, MORE):
        (here / "field/crop.pluto").write_text(text)
        git("add", ".")
        git("commit", "-q", "-m", "a change")
    git("tag", "-a", "v1", "-m", "the first", "HEAD~1")
    git("branch", "older", "HEAD~1")
    (here / "field/crop.pluto").write_text(MOST)
    return here


def retries(plutoc: Call, *words: str | Path) -> tuple[int, int]:
    """Return from how many attempts to how many a comparison leads."""
    said = plutoc("diff", *words, "--format", "json")
    assert said.code == 0, said.err
    (change,) = json.loads(said.out)["changes"]
    return change["before"], change["after"]


@pytest.mark.parametrize("how", ["HEAD~1", "older", "v1", "refs/tags/v1", "HASH", "SHORT"])
def test_all_that_git_takes_for_a_revision_is_one(plutoc: Call, repository: Path, how: str) -> None:
    """A commit before, a branch, a tag with a text of its own, a hash."""
    whole = git("rev-parse", "HEAD~1")
    revision = {"HASH": whole, "SHORT": whole[:8]}.get(how, how)
    assert retries(plutoc, "HEAD", "field/crop.pluto") == (5, 7)
    assert retries(plutoc, revision, "field/crop.pluto") == (3, 7)


def test_the_report_says_which_version_is_which(plutoc: Call, repository: Path) -> None:
    """In its heading and at each line."""
    said = plutoc("diff", "HEAD~1", "field/crop.pluto")
    assert said.out.startswith("HEAD~1:field/crop.pluto → field/crop.pluto: 1 change in meaning\n")
    assert "- HEAD~1:field/crop.pluto:13: retry = PriorityManager(max_attempts: 3)" in said.out
    assert "+ field/crop.pluto:13: retry = PriorityManager(max_attempts: 7)" in said.out


def test_the_file_is_meant_that_is_named_from_here(
    plutoc: Call, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From a folder below, by its folder, absolutely, and through a link."""
    (repository / "link.pluto").symlink_to("field/crop.pluto")
    for name in ("field", repository / "field/crop.pluto", "link.pluto"):
        assert retries(plutoc, "HEAD~1", name) == (3, 7)
    monkeypatch.chdir("field")
    for name in ("crop.pluto", ".", "../field/crop.pluto"):
        assert retries(plutoc, "HEAD~1", name) == (3, 7)


def test_a_file_of_a_revisions_name_counts(plutoc: Call, repository: Path) -> None:
    """Else a name would mean something else after each `git branch`."""
    (repository / "older").write_text(MORE)
    assert retries(plutoc, "older", "field/crop.pluto") == (5, 7)
    assert retries(plutoc, "refs/heads/older", "field/crop.pluto") == (3, 7)


def test_mistakes_of_then_are_told_with_their_revision(plutoc: Call, repository: Path) -> None:
    """As `check` tells them."""
    (repository / "field/crop.pluto").write_text(APP.replace("find_blooms)", "find_bloom)"))
    git("commit", "-q", "-a", "-m", "a mistake")
    (repository / "field/crop.pluto").write_text(MOST)
    said = plutoc("diff", "HEAD", "field/crop.pluto")
    assert (said.code, said.out) == (1, "")
    assert "--> HEAD:field/crop.pluto:14:34" in said.err


def refused(plutoc: Call, *words: str | Path) -> str:
    said = plutoc("diff", *words)
    assert (said.code, said.out) == (2, "")
    return said.err


@pytest.mark.parametrize(
    "revision", ["nowhere", "HEAD~9", "HEAD..older", "^HEAD", "0" * 40, "n" * 300]
)
def test_an_unknown_revision_is_told(plutoc: Call, repository: Path, revision: str) -> None:
    """So is a range: it is no revision."""
    said = refused(plutoc, revision, "field/crop.pluto")
    assert said == (
        f"plutoc: there is no file {revision}, and no revision of that name in {repository}\n"
    )


def test_a_file_that_was_not_there_yet_is_told(plutoc: Call, repository: Path) -> None:
    """And how its old name is compared with."""
    (repository / "new.pluto").write_text(APP)
    said = refused(plutoc, "HEAD", "new.pluto")
    assert "plutoc: new.pluto did not exist at HEAD\n" in said
    assert "git show HEAD:OTHER | plutoc diff - new.pluto" in said
    assert "there is no file gone.pluto" in refused(plutoc, "HEAD", "gone.pluto")


def test_a_name_is_no_pattern(plutoc: Call, repository: Path) -> None:
    """Git would find `field/crop.pluto` by it."""
    for name in ("[f]*.pluto", ":(glob)*.pluto"):
        (repository / "field" / name).write_text(APP)
        assert "did not exist at HEAD" in refused(plutoc, "HEAD", f"field/{name}")


def test_what_was_a_link_or_a_folder_then_is_told(plutoc: Call, repository: Path) -> None:
    """The content of a link is a path, and no app."""
    app = repository / "app.pluto"
    app.symlink_to("field/crop.pluto")
    git("add", ".")
    git("commit", "-q", "-m", "a link")
    app.unlink()
    app.write_text(APP)
    assert "app.pluto was no file at HEAD" in refused(plutoc, "HEAD", "app.pluto")


def test_a_file_outside_of_the_repository_is_told(plutoc: Call, repository: Path) -> None:
    """Also where a link in the repository leads to it."""
    outside = repository.parent / "other.pluto"
    outside.write_text(APP)
    (repository / "link.pluto").symlink_to(outside)
    for name in ("../other.pluto", "link.pluto"):
        said = refused(plutoc, "HEAD", name)
        assert said.startswith(f"plutoc: {name} is outside of the Git repository {repository}")


def test_where_there_is_no_repository_it_is_told(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With what Git says."""
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", os.fspath(Path.cwd().parent))
    monkeypatch.setenv("LC_ALL", "C")
    said = refused(plutoc, "HEAD", app)
    assert (
        "there is no file HEAD; to read it as a revision, call plutoc in a Git repository" in said
    )
    assert "git says: not a git repository" in said


def test_without_git_it_is_told(
    plutoc: Call, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All else needs none."""
    monkeypatch.setenv("PATH", os.fspath(repository))
    said = refused(plutoc, "HEAD", "field/crop.pluto")
    assert said == (
        "plutoc: there is no file HEAD; to read it as a revision, git must be installed\n"
    )
    assert plutoc("diff", "field", "field").code == 0


def test_no_revision_is_an_option_of_git(plutoc: Call, repository: Path) -> None:
    """Nor of any shell's: none is there."""
    for words in (["--", "--output=taken", "field"], ["--", "-p", "field"]):
        said = refused(plutoc, *words)
        assert said.endswith(f"{words[1]}, and no revision begins with `-`\n")
    assert "no revision of that name" in refused(plutoc, "HEAD; touch taken", "field")
    assert not (repository / "taken").exists()


def test_standard_input_has_no_revisions(plutoc: Call, repository: Path) -> None:
    """It has no name that Git could know."""
    assert refused(plutoc, "HEAD", "-") == "plutoc: there is no file HEAD\n"


def test_a_comparison_of_files_asks_no_git(app: Path) -> None:
    """It is not even loaded."""
    program = (
        "import sys; from plutoc.cli import main; main(['diff', 'crop.pluto', 'crop.pluto']);"
        "print('plutoc.cli.revisions' in sys.modules, file=sys.stderr)"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stderr == "False\n"
