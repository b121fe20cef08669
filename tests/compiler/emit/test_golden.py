"""A case with a folder `expected` is compiled, and its package compared with it file by file.

Missing files and files too many count. Of what is only copied, `files.txt` has the names. `pytest
tests/compiler/emit/test_golden.py --update` rewrites the folders: read the difference before committing.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from plutoc.emit.package import emit
from plutoc.report.graph_file import graph_file
from plutoc.report.pictures import mermaid
from tests.compiler.emit.plans import plan_of
from tests.paths import CASES

FOLDERS = sorted(path.parent for path in CASES.glob("*/expected"))


def package_of(folder: Path) -> dict[str, str]:
    """Return the files worth reading, and the names of all."""
    plan = plan_of((folder / "app.pluto").read_text(encoding="utf-8"))
    package = emit(
        plan,
        source_name="app.pluto",
        picture=mermaid(plan.checked),
        graph_data=graph_file(plan.checked),
    )
    files = {**package.owned, **package.once}
    copied = [path for path in files if "/_runtime/" in path or path in ("LICENSE", "pluto.lock")]
    read = {path: text for path, text in files.items() if path not in copied}
    return {**read, "files.txt": "".join(f"{path}\n" for path in sorted(files))}


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_package_is_as_expected(folder: Path, update: bool) -> None:
    """A source gives exactly the files beside it."""
    made, expected = package_of(folder), folder / "expected"
    if update:
        shutil.rmtree(expected)
        for path, text in made.items():
            (expected / path).parent.mkdir(parents=True, exist_ok=True)
            (expected / path).write_bytes(text.encode())
    found = {
        path.relative_to(expected).as_posix(): path.read_bytes().decode()
        for path in expected.rglob("*")
        if path.is_file()
    }
    assert sorted(found) == sorted(made)
    for path, text in made.items():
        assert found[path] == text, path
