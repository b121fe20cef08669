"""`plutoc diff REVISION FILE`: what Git is asked, and what is said where there is none."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP
from tests.compiler.cli.test_merges import git
from tests.kit.command import plutoc

pytestmark = pytest.mark.process
MORE = APP.replace("max_attempts: 3", "max_attempts: 5")
MOST = APP.replace("max_attempts: 3", "max_attempts: 7")


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


def retries(*words: str | Path) -> tuple[int, int]:
    """Return from how many attempts to how many a comparison leads."""
    said = plutoc("diff", *words, "--format", "json")
    assert said.code == 0, said.err
    (change,) = json.loads(said.out)["changes"]
    return change["before"], change["after"]


def test_nothing_in_a_strangers_repository_is_run(repository: Path) -> None:
    """Of a partial clone whose content is missing nothing is fetched; no hook, monitor or helper is called."""
    blob = git("rev-parse", "HEAD:field/crop.pluto").strip()
    (repository / ".git/objects" / blob[:2] / blob[2:]).unlink()
    hacked = f"touch {repository}/hacked; false"
    for setting in (
        *("core.repositoryFormatVersion=1", "extensions.partialClone=o", "remote.o.promisor=true"),
        *("remote.o.url=" + str(repository), "protocol.allow=always", "protocol.file.allow=always"),
        *(f"{key}={hacked}" for key in ("remote.o.uploadpack", "core.fsmonitor", "core.pager")),
        *(f"{key}={hacked}" for key in ("core.sshCommand", "diff.external", "core.askPass")),
    ):
        git("config", *setting.split("=", 1))
    for url in (
        repository,
        f"file://{repository}",
        "ssh://host/x",
        f"ext::sh -c touch% {repository}/hacked",
    ):
        (repository / ".git/config").write_text(
            (repository / ".git/config").read_text().replace(f"url = {repository}", f"url = {url}")
        )
        done = plutoc("diff", "HEAD", "field/crop.pluto")
        assert done.code == 2 and "git cat-file has failed" in done.err
        assert not (repository / "hacked").exists(), url


def test_all_that_git_takes_for_a_revision_is_one(
    repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A commit before, a branch, a tag with a text of its own, a hash; the file is named from here."""
    whole = git("rev-parse", "HEAD~1").strip()
    assert retries("HEAD", "field/crop.pluto") == (5, 7)
    for revision in ("HEAD~1", "older", "v1", "refs/tags/v1", whole, whole[:8]):
        assert retries(revision, "field/crop.pluto") == (3, 7)
    (repository / "link.pluto").symlink_to("field/crop.pluto")
    for name in ("field", repository / "field/crop.pluto", "link.pluto"):
        assert retries("HEAD~1", name) == (3, 7)
    monkeypatch.chdir("field")
    for name in ("crop.pluto", ".", "../field/crop.pluto"):
        assert retries("HEAD~1", name) == (3, 7)
    (repository / "field/older").write_text(MORE)  # else a name would mean something else
    assert retries("older", "crop.pluto") == (5, 7)  # after each `git branch`
    assert retries("refs/heads/older", "crop.pluto") == (3, 7)


def refused(*words: str | Path) -> str:
    """Return why two versions cannot be compared."""
    said = plutoc("diff", *words)
    assert (said.code, said.out) == (2, "")
    return said.err


def test_what_is_no_version_of_a_file_is_told(repository: Path) -> None:
    """Unknown revisions and ranges; files that were not there, or outside; names are no patterns."""
    for revision in ("nowhere", "HEAD~9", "HEAD..older", "^HEAD", "0" * 40, "n" * 300):
        assert refused(revision, "field/crop.pluto") == (
            f"plutoc: there is no file {revision}, and no revision of that name in {repository}\n"
        )
    for name in ("new.pluto", "field/[f]*.pluto", "field/:(glob)*.pluto"):
        (repository / name).write_text(APP)
        said = refused("HEAD", name)
        assert f"plutoc: {name} did not exist at HEAD\n" in said
    assert "git show HEAD:OTHER | plutoc diff - new.pluto" in refused("HEAD", "new.pluto")
    assert "there is no file gone.pluto" in refused("HEAD", "gone.pluto")
    assert refused("HEAD", "-") == "plutoc: there is no file HEAD\n"
    outside = repository.parent / "other.pluto"
    outside.write_text(APP)
    (repository / "link.pluto").symlink_to(outside)
    for name in ("../other.pluto", "link.pluto"):
        said = refused("HEAD", name)
        assert said.startswith(f"plutoc: {name} is outside of the Git repository {repository}")
    for option in ("--output=taken", "-p"):
        assert refused("--", option, "field/crop.pluto").endswith(
            "and no revision begins with `-`\n"
        )
    assert "no revision of that name" in refused("HEAD; touch taken", "field/crop.pluto")
    assert not (repository / "taken").exists()


@pytest.mark.long
def test_mistakes_and_links_of_then_are_told_with_their_revision(repository: Path) -> None:
    """As `check` tells them; the content of a link is a path, and no app."""
    (repository / "field/crop.pluto").write_text(APP.replace("find_blooms)", "find_bloom)"))
    app = repository / "app.pluto"
    app.symlink_to("field/crop.pluto")
    git("add", ".")
    git("commit", "-q", "-a", "-m", "a mistake, and a link")
    (repository / "field/crop.pluto").write_text(MOST)
    said = plutoc("diff", "HEAD", "field/crop.pluto")
    assert (said.code, said.out) == (1, "")
    assert "--> HEAD:field/crop.pluto:14:34" in said.err
    app.unlink()
    app.write_text(APP)
    assert "app.pluto was no file at HEAD" in refused("HEAD", "app.pluto")
    said = plutoc("diff", "HEAD~2", "field/crop.pluto")
    assert said.out.startswith("HEAD~2:field/crop.pluto → field/crop.pluto: 1 change in meaning\n")
    assert "- HEAD~2:field/crop.pluto:13: retry = PriorityManager(max_attempts: 3)" in said.out


@pytest.mark.long
def test_where_there_is_no_repository_it_is_told(
    app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With what Git says."""
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(Path.cwd().parent))
    monkeypatch.setenv("LC_ALL", "C")
    said = refused("HEAD", app)
    assert "to read it as a revision, call plutoc in a Git repository" in said
    assert "git says: not a git repository" in said
