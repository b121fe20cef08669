"""An app as it was at a revision that Git knows."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

from plutoc.cli.endings import UsageError
from plutoc.project.reading import decoded, shown
from plutoc.source import Source
from plutoc_runtime.domain.text import printable

_NAME_OF_OBJECT = re.compile(rb"[0-9a-f]{40,64}")

_HARMLESS = (
    *("core.fsmonitor=false", f"core.hooksPath={os.devnull}", "core.sshCommand=false"),
    *("core.gitProxy=", "core.alternateRefsCommand=", "core.askPass=", "credential.helper="),
    *("diff.external=", "protocol.allow=never"),
)
"""Settings over those of a repository."""
_OFFLINE = {
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_ALLOW_PROTOCOL": "none",  # over what the repository allows, and by older versions of Git, too
    "GIT_TERMINAL_PROMPT": "0",
    "GIT_OPTIONAL_LOCKS": "0",
}


def read_at(revision: str, file: Path) -> Source:
    """Read a file as it was at a revision; raise `UsageError` where there is nothing to read."""
    said = printable(revision)
    absent = f"there is no file {said}"
    if revision.startswith("-"):  # for Git it would be an option
        raise UsageError(f"{absent}, and no revision begins with `-`")
    top = _top(absent)
    place = Path(os.path.realpath(file))
    if not place.is_relative_to(top):
        raise UsageError(
            f"{shown(file)} is outside of the Git repository {shown(top)}, to which the revision"
            f" {said} belongs: call plutoc in the repository of the file"
        )
    tree = _git("rev-parse", "--verify", "--quiet", f"{revision}^{{tree}}")
    name = tree.stdout.strip()
    if tree.returncode or not _NAME_OF_OBJECT.fullmatch(name):
        raise UsageError(f"{absent}, and no revision of that name in {shown(top)}")
    path = f"{said}:{shown(file)}"
    blob = _blob(name.decode(), place.relative_to(top).as_posix(), shown(file), said)
    return Source(path, decoded(_done("cat-file", "blob", blob), path))


def _top(absent: str) -> Path:
    """Return the top of the repository that we are in."""
    try:
        found = _git("rev-parse", "--show-toplevel")
    except FileNotFoundError:
        raise UsageError(f"{absent}; to read it as a revision, git must be installed") from None
    if found.returncode:
        raise UsageError(
            f"{absent}; to read it as a revision, call plutoc in a Git repository ({_why(found)})"
        )
    return Path(os.path.realpath(os.fsdecode(found.stdout.removesuffix(b"\n"))))


def _blob(tree: str, path: str, file: str, revision: str) -> str:
    """Return the name of a file's content."""
    entry = _done("ls-tree", "-z", "--full-tree", tree, "--", path)
    if not entry:
        raise UsageError(
            f"{file} did not exist at {revision}\nhelp: where it had another name,"
            f" `git show {revision}:OTHER | plutoc diff - {file}` compares with that"
        )
    mode, _, name = entry.partition(b"\t")[0].decode().split()
    if not mode.startswith("100"):  # as Git writes those of files
        raise UsageError(f"{file} was no file at {revision}, but a link or a folder")
    return name


def _done(*words: str) -> bytes:
    done = _git(*words)
    if done.returncode:
        raise UsageError(f"git {words[0]} has failed ({_why(done)})")
    return done.stdout


def _git(*words: str) -> subprocess.CompletedProcess[bytes]:
    """Run Git without a shell; paths are paths, and no patterns.

    The repository may be a stranger's: nothing in its configuration runs a command or fetches anything.
    """
    settings = (word for one in _HARMLESS for word in ("-c", one))
    environment = {**os.environ, **_OFFLINE, "GIT_LITERAL_PATHSPECS": "1"}
    return subprocess.run(
        ["git", "--no-pager", *settings, *words],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        env=environment,
        check=False,
    )


def _why(done: subprocess.CompletedProcess[bytes]) -> str:
    first = done.stderr.decode("utf-8", "replace").strip().partition("\n")[0]
    return f"git says: {printable(first.removeprefix('fatal: '))}"
