"""`plutoc diff`, as a person and a pipeline call it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from tests.compiler.cli.conftest import APP, Call

PLACES = {
    "type": "array",
    "items": {
        "type": "object",
        "properties": {"file": {"type": "string"}}
        | {
            key: {"type": "integer", "minimum": 1}
            for key in ("line", "column", "end_line", "end_column")
        },
        "required": ["file", "line", "column", "end_line", "end_column"],
        "additionalProperties": False,
    },
}
NAMES = {"type": "array", "items": {"type": "string"}}
FACT = {"anyOf": [{"type": ["boolean", "number", "string", "null"]}, NAMES]}
IMPORTANCE = ["safety", "missions", "people", "form"]
SCHEMA = {
    "type": "object",
    "properties": {
        "old": {"type": "string"},
        "new": {"type": "string"},
        "changed": {"type": "boolean"},
        "number": {
            "type": "object",
            "properties": {key: {"type": "integer", "minimum": 0} for key in IMPORTANCE},
            "required": IMPORTANCE,
            "additionalProperties": False,
        },
        "changes": {
            "type": "array",
            "items": {
                "type": "object",
                "properties": {
                    "kind": {"type": "string", "pattern": "^[a-z_]+$"},
                    "importance": {"enum": IMPORTANCE},
                    "sentence": {"type": "string"},
                    "blocks": NAMES,
                    "statuses": NAMES,
                    "before": FACT,
                    "after": FACT,
                    "old": PLACES,
                    "new": PLACES,
                },
                "required": [
                    *("kind", "importance", "sentence", "blocks", "statuses"),
                    *("before", "after", "old", "new"),
                ],
                "additionalProperties": False,
            },
        },
    },
    "required": ["old", "new", "changed", "number", "changes"],
    "additionalProperties": False,
}
MORE = APP.replace("max_attempts: 3", "max_attempts: 5")
SENTENCE = "a FAILED mission is now retried up to 5 times"


@pytest.fixture
def changed(app: Path) -> Path:
    """The app beside the other one, in which failed trips are flown more often."""
    path = Path("new.pluto")
    path.write_text(MORE)
    return path


def test_a_change_is_told_with_its_lines_and_ends_with_0(
    plutoc: Call, app: Path, changed: Path
) -> None:
    """A change is nothing wrong."""
    said = plutoc("diff", app, changed)
    assert (said.code, said.err) == (0, "")
    assert said.out.startswith("crop.pluto → new.pluto: 1 change in meaning\n")
    assert SENTENCE in said.out
    assert "- crop.pluto:13: retry = PriorityManager(max_attempts: 3)" in said.out
    assert "+ new.pluto:13: retry = PriorityManager(max_attempts: 5)" in said.out


def test_with_exit_code_a_change_ends_with_1(plutoc: Call, app: Path, changed: Path) -> None:
    """And no change with 0, in every format."""
    changed.write_text(MORE)
    for form in ("text", "markdown", "json"):
        assert plutoc("diff", app, changed, "--exit-code", "--format", form).code == 1
        assert plutoc("diff", app, app, "--exit-code", "--format", form).code == 0


def test_where_nothing_changed_it_says_so(plutoc: Call, app: Path, changed: Path) -> None:
    """A comment is nothing."""
    changed.write_text(APP.replace("  create =", "  # It begins.\n  create ="))
    said = plutoc("diff", app, changed)
    assert said.out == "crop.pluto → new.pluto: nothing changed in meaning\n"


def test_markdown_is_for_a_pull_request(plutoc: Call, app: Path, changed: Path) -> None:
    """A heading, a list, and the lines as a patch shows them."""
    said = plutoc("diff", app, changed, "--format", "markdown")
    assert said.out.startswith("### `new.pluto`: 1 change in meaning\n")
    assert f"\n- {SENTENCE}" in said.out
    assert "```diff\n- retry = PriorityManager(max_attempts: 3)\n+ retry =" in said.out


def test_json_is_one_object_of_the_shape_that_the_page_tells(
    plutoc: Call, app: Path, changed: Path
) -> None:
    """With facts as values, and places in both files."""
    jsonschema.validate(json.loads(plutoc("diff", app, app, "--format", "json").out), SCHEMA)
    found = json.loads(plutoc("diff", app, changed, "--format", "json").out)
    jsonschema.validate(found, SCHEMA)
    assert found["number"] == {"safety": 1, "missions": 0, "people": 0, "form": 0}
    (change,) = found["changes"]
    assert (change["kind"], change["before"], change["after"]) == ("retries_changed", 3, 5)
    assert change["blocks"] == ["retry"]
    (place,) = change["new"]
    assert place == {"file": "new.pluto", "line": 13, "column": 3, "end_line": 13, "end_column": 8}


def test_a_folder_stands_for_the_app_in_it(plutoc: Call, app: Path, here: Path) -> None:
    """`app.pluto`, or the only one."""
    for name, text in (("before", APP), ("after", MORE)):
        (here / name).mkdir()
        (here / name / "app.pluto").write_text(text)
    assert SENTENCE in plutoc("diff", "before", "after").out
    assert SENTENCE in plutoc("diff", ".", "after").out
    (here / "before" / "app.pluto").rename(here / "before" / "crop.pluto")
    (here / "before" / "field.pluto").write_text(APP)
    said = plutoc("diff", "before", "after")
    assert (said.code, said.out) == (2, "")
    assert "the folder before holds several apps, none of them app.pluto: name one" in said.err
    (here / "empty").mkdir()
    assert "the folder empty holds no app" in plutoc("diff", "empty", "after").err


def test_what_git_knows_comes_by_standard_input(app: Path, changed: Path) -> None:
    """`git show HEAD:app.pluto | plutoc diff - app.pluto`; but only one of the two."""
    done = piped("-m", "plutoc", "diff", "-", "new.pluto")
    assert done.stdout.startswith("<stdin> → new.pluto: 1 change in meaning")
    both = piped("-m", "plutoc", "diff", "-", "-")
    assert both.returncode == 2
    assert "can be one of the two apps, not both" in both.stderr


@pytest.mark.parametrize("words", [("-", "new.pluto"), ("new.pluto", "-")])
def test_a_git_that_has_nothing_to_show_is_told_as_that(
    app: Path, changed: Path, words: tuple[str, str]
) -> None:
    """As outside a repository: that is no mistake in an app, and no code explains it."""
    done = piped("-m", "plutoc", "diff", *words, given="")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "plutoc: standard input is empty: the command before the `|` gave no app\n"
    )


def piped(*arguments: str, given: str = APP) -> subprocess.CompletedProcess[str]:
    """Run a program of Python's, with the app on its standard input."""
    return subprocess.run(
        [sys.executable, *arguments],
        input=given,
        capture_output=True,
        text=True,
        check=False,
        env={"PYTHONPATH": os.pathsep.join(sys.path), "PYTHONUTF8": "1"},
    )


@pytest.mark.parametrize("form", ["text", "markdown"])
def test_errors_of_either_are_told_as_ever(
    plutoc: Call, app: Path, changed: Path, form: str
) -> None:
    """Of both in one run; and nothing is compared."""
    broken = APP.replace("  retry -> allocate when STANDBY\n", "")
    changed.write_text(broken)
    for pair in ((app, changed), (changed, app)):
        said = plutoc("diff", *pair, "--format", form)
        assert (said.code, said.out) == (1, "")
        assert "new.pluto" in said.err
    app.write_text(broken)
    said = plutoc("diff", app, changed, "--format", form)
    assert "crop.pluto:" in said.err and "new.pluto:" in said.err


def test_errors_in_json_are_those_of_check(plutoc: Call, app: Path, changed: Path) -> None:
    """An object a line."""
    changed.write_text(APP.replace("  retry -> allocate when STANDBY\n", ""))
    said = plutoc("diff", app, changed, "--format", "json")
    assert said.code == 1
    assert said.out == plutoc("check", changed, "--format", "json").out


def test_a_file_that_is_not_there_ends_with_2(plutoc: Call, app: Path) -> None:
    """It is named."""
    said = plutoc("diff", app, "nowhere.pluto")
    assert said.code == 2
    assert "there is no file nowhere.pluto" in said.err


def test_no_other_command_waits_for_it() -> None:
    """What it needs is loaded when it is called."""
    program = "import sys; from plutoc.cli import main; main(['explain', 'P1003']); "
    program += "print('plutoc.diff' in sys.modules, file=sys.stderr)"
    assert piped("-c", program).stderr == "False\n"


def test_a_name_that_is_too_long_is_told(plutoc: Call) -> None:
    said = plutoc("diff", "n" * 300, "-")
    assert said.code == 2
    assert "a name is too long" in said.err and "internal" not in said.err
