"""The extension for Visual Studio Code: what it names is there, and npm alone builds it."""

from __future__ import annotations

import re
import shutil
import subprocess
from json import loads
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest

from plutoc.service.document import Document
from tests.paths import ROOT

FOLDER = ROOT / "editors" / "vscode"
MANIFEST: dict[str, Any] = loads((FOLDER / "package.json").read_text(encoding="utf-8"))
CODE = (FOLDER / "src" / "extension.js").read_text(encoding="utf-8")
SNIPPETS = loads((FOLDER / "snippets" / "pluto.json").read_text(encoding="utf-8"))
NPM = shutil.which("npm")


def test_the_files_that_it_contributes_are_there() -> None:
    contributed = MANIFEST["contributes"]
    named = [contributed["languages"][0]["configuration"], contributed["grammars"][0]["path"]]
    named += [one["path"] for one in contributed["snippets"]]
    assert all(loads((FOLDER / name).read_text(encoding="utf-8")) for name in named)


def test_it_asks_for_the_settings_and_commands_that_it_declares() -> None:
    settings = {f"pluto.{name}" for name in re.findall(r'settings\(\)\.get\("(\w+)"\)', CODE)}
    assert settings == MANIFEST["contributes"]["configuration"]["properties"].keys()
    commands = set(re.findall(r'registerCommand\("([\w.]+)"', CODE))
    assert commands == {one["command"] for one in MANIFEST["contributes"]["commands"]}


@pytest.mark.parametrize("name", SNIPPETS)
def test_a_snippet_can_be_read_where_it_stands(name: str) -> None:
    body = "\n".join(SNIPPETS[name]["body"])
    text = re.sub(r"\$\{\d+:([^}]*)\}", r"\1", body)
    text = text.replace("$1", (re.search(r"\$\{1:([^}]*)\}", body) or [""] * 2)[1])
    if not text.startswith("pluto"):
        text = f"pluto 1\napp tried {{\n{text}\n}}\n"
    found = Document(path="app.pluto", text=text).of_names
    assert not any(one.code.startswith("P0") for one in found)


@pytest.mark.long
@pytest.mark.skipif(NPM is None, reason="npm builds it")
def test_npm_alone_builds_it(tmp_path: Path) -> None:
    built = tmp_path / "vscode"
    shutil.copytree(FOLDER, built, ignore=shutil.ignore_patterns("node_modules", "dist", "*.vsix"))
    for command in (["ci"], ["run", "package"]):
        done = subprocess.run(
            [str(NPM), *command], cwd=built, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
    packed = set(ZipFile(built / "pluto.vsix").namelist())
    contributed = ("dist/extension.js", "syntaxes/pluto.tmLanguage.json", "snippets/pluto.json")
    assert {f"extension/{name}" for name in contributed} <= packed
