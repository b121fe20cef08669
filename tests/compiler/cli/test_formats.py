"""One run, four reports: the format changes what is printed, and nothing else."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TextIO

import pytest

from plutoc.cli.options import FORMATS
from tests.compiler.cli.conftest import APP, Call, Said
from tests.test_cases import FOLDERS

MISTAKE = APP.replace("find_blooms)", "find_bloom)")
WARNED = APP.replace("  retry -> end otherwise\n", "")


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_the_format_never_changes_the_exit_code(
    plutoc: Call, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Errors are 1, warnings are 0, in whichever way they are told."""
    monkeypatch.chdir(folder)
    said = {name: plutoc("check", "app.pluto", "--format", name) for name in FORMATS}
    wanted = 1 if "error[" in Path("report.txt").read_text() else 0
    assert {name: one.code for name, one in said.items()} == dict.fromkeys(FORMATS, wanted)
    codes = [json.loads(line)["code"] for line in said["json"].out.splitlines()]
    assert _codes_of_sarif(said["sarif"]) == codes
    assert [_title(line) for line in said["github"].out.splitlines()] == codes
    assert said["text"].err.count("[P") >= min(len(codes), 20)
    assert not any(said[name].err for name in FORMATS if name != "text")


def _codes_of_sarif(said: Said) -> list[str]:
    return [result["ruleId"] for result in json.loads(said.out)["runs"][0]["results"]]


def _title(line: str) -> str:
    return line.split("title=")[1].split("::")[0]


def read_json(said: Said) -> list[str]:
    """The sentences of the lines that a program reads."""
    return [json.loads(line)["message"] for line in said.out.splitlines()]


def read_github(said: Said) -> list[str]:
    """The sentences of the commands that GitHub reads."""
    return [line.split("::", 2)[2] for line in said.out.splitlines()]


def read_sarif(said: Said) -> list[str]:
    """The sentences of the one document, those about files first."""
    run = json.loads(said.out)["runs"][0]
    told = run["invocations"][0].get("toolExecutionNotifications", [])
    return [one["message"]["text"] for one in (*told, *run["results"])]


Read = Callable[[Said], list[str]]
READERS = [("json", read_json), ("github", read_github), ("sarif", read_sarif)]


@pytest.mark.parametrize(("name", "reader"), READERS)
def test_a_file_that_cannot_be_read_is_told_in_every_format(
    plutoc: Call, app: Path, name: str, reader: Read
) -> None:
    """The other files are checked all the same, and standard output can still be read."""
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


@pytest.mark.parametrize(("name", "reader"), READERS)
def test_nothing_found_can_be_read_too(plutoc: Call, app: Path, name: str, reader: Read) -> None:
    """No line, or an empty document."""
    said = plutoc("check", app, "--format", name)
    assert (said.code, reader(said), said.err) == (0, [], "")


@pytest.mark.parametrize(("name", "reader"), READERS)
def test_compile_reports_once_in_every_format(
    plutoc: Call, app: Path, name: str, reader: Read
) -> None:
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


@pytest.mark.parametrize(("name", "reader"), READERS)
@pytest.mark.parametrize("flags", [["--diff"], ["--show", "plan"], ["--show", "graph"]])
def test_what_compile_shows_leaves_standard_output_to_the_report(
    plutoc: Call, app: Path, name: str, reader: Read, flags: list[str]
) -> None:
    """A program reads that; what is shown goes to standard error."""
    app.write_text(WARNED)
    text = plutoc("compile", app, *flags)
    said = plutoc("compile", app, *flags, "--format", name)
    assert said.code == text.code == 0
    assert len(reader(said)) == 1
    assert said.err == text.out


def test_each_finding_is_told_once_and_in_order(plutoc: Call, app: Path) -> None:
    """Also of a file that is named twice; the files keep the order in which they were named."""
    app.write_text(MISTAKE)
    Path("a.pluto").write_text(MISTAKE)
    said = plutoc("check", app, "a.pluto", app, "--format", "json")
    objects = [json.loads(line) for line in said.out.splitlines()]
    places = [(one["file"], one["line"], one["column"]) for one in objects]
    assert [place[0] for place in places] == sorted((p[0] for p in places), reverse=True)
    assert len(set(places)) == len(places) == 2 * sum(p[0] == "a.pluto" for p in places)


def test_the_cap_is_over_all_files(plutoc: Call, app: Path) -> None:
    """Twenty are shown, and the rest is counted; programs get all."""
    files = []
    for number in range(3):
        files.append(Path(f"many{number}.pluto"))
        unknown = "".join(f"  b{i} = Nothing{i}\n" for i in range(9))
        files[-1].write_text(f"pluto 1\napp many{number} {{\n{unknown}}}\n")
    said = plutoc("check", *files)
    assert said.err.count("error[P1012]") == 20
    assert "… and 7 more\n" in said.err
    assert "\n27 errors\n" in said.err
    assert len(plutoc("check", *files, "--format", "json").out.splitlines()) == 27


def python(*arguments: str, out: int | TextIO, read: str | None = None) -> tuple[int, str]:
    """Call the program as a process of its own: its exit code and its standard error."""
    done = subprocess.run(
        [sys.executable, "-m", "plutoc", *arguments],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        input=read,
        stdout=out,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr


PROGRAMS = [name for name in FORMATS if name != "text"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is full")
@pytest.mark.parametrize("name", PROGRAMS)
def test_a_report_that_cannot_be_written_ends_with_2(app: Path, name: str) -> None:
    """A full disk is an error, not a traceback."""
    app.write_text(MISTAKE)
    with open("/dev/full", "w") as full:
        code, told = python("check", str(app), "--format", name, out=full)
    assert (code, told) == (2, "plutoc: the output cannot be written: No space left on device\n")


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_report_without_a_reader_ends_with_141(app: Path, name: str) -> None:
    """Its reader has gone."""
    app.write_text(MISTAKE)
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as pipe:
        assert python("check", str(app), "--format", name, out=pipe) == (141, "")


@pytest.mark.parametrize(("name", "reader"), READERS)
def test_standard_input_is_checked_as_a_file_is(here: Path, name: str, reader: Read) -> None:
    """It has no folder, so there are no hooks; and there is nothing that --fix could change."""
    Path("hooks.py").write_text("nothing = 1\n")
    with open("report", "w+") as report:
        code, told = python("check", "-", "--format", name, out=report, read=MISTAKE)
        report.seek(0)
        sentences = reader(Said(code, report.read(), told))
    assert (code, told, len(sentences)) == (1, "", 1)
    repeated = APP.replace("can take_photo", "can measure, measure, take_photo")
    code, told = python("check", "-", "--fix", out=subprocess.DEVNULL, read=repeated)
    assert code == 2
    assert "plutoc: --fix changes files, and standard input is none\n" in told
    assert "warning[P1025]" in told
