"""One run, four reports: the format changes what is printed, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from plutoc.cli.options import FORMATS
from tests.compiler.cli.conftest import APP
from tests.kit.command import Ran, plutoc
from tests.test_cases import FOLDERS

MISTAKE = APP.replace("find_blooms)", "find_bloom)")
WARNED = APP.replace("  retry -> end otherwise\n", "")


@pytest.mark.parametrize("folder", FOLDERS[::8], ids=lambda folder: folder.name)
def test_the_format_never_changes_the_exit_code(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Errors are 1, warnings are 0, in whichever way they are told; and all tell the same codes."""
    monkeypatch.chdir(folder)
    said = {name: plutoc("check", "app.pluto", "--format", name) for name in FORMATS}
    wanted = 1 if "error[" in Path("report.txt").read_text() else 0
    assert {name: one.code for name, one in said.items()} == dict.fromkeys(FORMATS, wanted)
    codes = [json.loads(line)["code"] for line in said["json"].out.splitlines()]
    results = json.loads(said["sarif"].out)["runs"][0]["results"]
    assert [result["ruleId"] for result in results] == codes
    titles = [line.split("title=")[1].split("::")[0] for line in said["github"].out.splitlines()]
    assert titles == codes
    assert said["text"].err.count("[P") >= min(len(codes), 20)
    assert not any(said[name].err for name in FORMATS if name != "text")


def read_json(said: Ran) -> list[str]:
    """The sentences of the lines that a program reads."""
    return [json.loads(line)["message"] for line in said.out.splitlines()]


def read_github(said: Ran) -> list[str]:
    """The sentences of the commands that GitHub reads."""
    return [line.split("::", 2)[2] for line in said.out.splitlines()]


def read_sarif(said: Ran) -> list[str]:
    """The sentences of the one document, those about files first."""
    run = json.loads(said.out)["runs"][0]
    told = run["invocations"][0].get("toolExecutionNotifications", [])
    return [one["message"]["text"] for one in (*told, *run["results"])]


Read = Callable[[Ran], list[str]]
EACH = pytest.mark.parametrize(
    ("name", "reader"), [("json", read_json), ("github", read_github), ("sarif", read_sarif)]
)


@EACH
def test_a_file_that_cannot_be_read_is_told_in_every_format(
    app: Path, name: str, reader: Read
) -> None:
    """The other files are checked all the same, and standard output can still be read."""
    assert reader(plutoc("check", app, "--format", name)) == []
    app.write_text(MISTAKE)
    said = plutoc("check", "none.pluto", app, "--format", name)
    assert said.code == 2
    assert said.err == "plutoc: there is no file none.pluto\n"
    sentences = reader(said)
    assert ("there is no file none.pluto" in sentences) is (name != "json")
    assert sum("find_bloom" in sentence for sentence in sentences) == 1
    compiled = plutoc("compile", "none.pluto", "--format", name)
    assert (compiled.code, compiled.err) == (2, said.err)
    assert reader(compiled) == ([] if name == "json" else ["there is no file none.pluto"])


@EACH
def test_compile_reports_once_in_every_format(app: Path, name: str, reader: Read) -> None:
    """Its warnings and what stands in the way of its files make one report."""
    app.write_text(WARNED)
    assert plutoc("compile", app, "--format", name).code == 0
    flow = Path("crop/src/crop/flow.py")
    flow.write_text(flow.read_text() + "# mine\n")
    said = plutoc("compile", app, "--format", name)
    assert said.code == 3
    sentences = reader(said)
    assert any("was edited by hand" in sentence for sentence in sentences)
    assert any("`retry`" in sentence for sentence in sentences)


@EACH
def test_what_compile_shows_leaves_standard_output_to_the_report(
    app: Path, name: str, reader: Read
) -> None:
    """A program reads that; what is shown goes to standard error."""
    app.write_text(WARNED)
    for flags in (["--diff"], ["--show", "graph"]):
        text = plutoc("compile", app, *flags)
        said = plutoc("compile", app, *flags, "--format", name)
        assert said.code == text.code == 0
        assert len(reader(said)) == 1
        assert said.err == text.out
