"""An app that names no policy has another one since packages of seam 3.2: that is told where it matters."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.app import SEAM as NEWEST
from tests.compiler.cli.conftest import APP, Call
from tests.compiler.cli.test_revisions import git

NAMED = APP.replace("DroneAllocator", "DroneAllocator(policy: nearest)")
SEAM = "crop/src/crop/_runtime/domain/app.py"
TOLD = (
    "`allocate` names no `policy`: that is `least_makespan` from now on, and was `nearest`, which"
    " `DroneAllocator(policy: nearest)` keeps"
)
CHANGED = "a mission's drone is now chosen by `least_makespan`; before, by `nearest`"


@pytest.fixture
def app(plutoc: Call, here: Path) -> Path:
    """An app with its package, as a compiler of seam 3.1 has recorded it, in a commit."""
    return compiled(plutoc, here, APP)


def compiled(plutoc: Call, here: Path, text: str) -> Path:
    source = here / "crop.pluto"
    source.write_text(text)
    assert plutoc("compile", source, "--add-stubs").code == 0
    file, lock = here / SEAM, here / "crop/pluto.lock"
    now = file.read_text()
    before = now.replace(f"SEAM = {NEWEST}", "SEAM = (3, 1)")
    assert before != now
    file.write_text(before)
    digests = [sha256(each.encode()).hexdigest() for each in (now, before)]
    lock.write_text(lock.read_text().replace(digests[0], digests[1]))
    git("init", "-q", "-b", "main")
    git("add", ".")
    git("commit", "-q", "-m", "a package")
    return source


def changes(plutoc: Call, *words: str | Path) -> list[str]:
    said = plutoc("diff", *words, "--format", "json")
    assert said.code == 0, said.err
    return [change["sentence"] for change in json.loads(said.out)["changes"]]


def test_a_comparison_with_a_revision_looks_at_the_package_that_it_had(
    plutoc: Call, app: Path
) -> None:
    """As long as it had the earlier one, whatever is compiled meanwhile."""
    assert changes(plutoc, "HEAD", app) == [CHANGED]
    assert plutoc("compile", app).code == 0
    assert changes(plutoc, "HEAD", app) == [CHANGED]
    git("commit", "-q", "-a", "-m", "compiled anew")
    assert changes(plutoc, "HEAD", app) == []
    assert changes(plutoc, "HEAD~1", app) == [CHANGED]


def test_a_comparison_of_files_looks_at_the_package_beside_the_old_one(
    plutoc: Call, app: Path
) -> None:
    new = app.with_name("new.pluto")
    new.write_text(NAMED)
    assert changes(plutoc, app, new) == []
    new.write_text(APP.replace("DroneAllocator", "DroneAllocator(policy: least_makespan)"))
    assert changes(plutoc, app, new) == [CHANGED]


def test_where_no_package_is_known_todays_defaults_count(plutoc: Call, here: Path) -> None:
    (here / "old.pluto").write_text(APP)
    (here / "new.pluto").write_text(NAMED)
    (told,) = changes(plutoc, here / "old.pluto", here / "new.pluto")
    assert told == "a mission's drone is now chosen by `nearest`; before, by `least_makespan`"


def test_compiling_says_which_default_is_another(plutoc: Call, app: Path) -> None:
    """Once: then the package has it."""
    said = plutoc("compile", app, "--check")
    assert (said.code, said.err.count(TOLD)) == (1, 1)
    assert plutoc("compile", app).out.count(TOLD) == 1
    assert TOLD not in plutoc("compile", app).out


def test_an_app_that_names_its_policy_is_told_nothing(plutoc: Call, here: Path) -> None:
    app = compiled(plutoc, here, NAMED)
    assert changes(plutoc, "HEAD", app) == []
    assert "policy" not in plutoc("compile", app, "--check").err
    assert "policy" not in plutoc("compile", app).out
