"""Folders of apps that cannot be looked into."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.kit.command import plutoc


@pytest.mark.skipif(os.name != "posix", reason="only there a mode keeps readers out")
def test_a_folder_that_cannot_be_read_is_told(app: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others are looked into."""
    Path("b/deep").mkdir(parents=True)
    shutil.move(app, "b/one.pluto")
    scandir = os.scandir

    def refusing(path: str | os.PathLike[str]) -> object:
        if os.fspath(path).endswith("deep"):
            raise PermissionError(13, "Permission denied", os.fspath(path))
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refusing)  # root may read everything
    why = "plutoc: the folder b/deep cannot be read: Permission denied\n"
    said = plutoc("check", "b")
    assert (said.code, said.err) == (2, why)
    assert said.out.startswith("b/one.pluto: no errors")
    assert plutoc("check", "b/deep") == (2, "", why)
