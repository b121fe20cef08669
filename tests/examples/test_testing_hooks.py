"""Tests of hooks: those of the page on testing hooks, and those beside the examples, pass in the packages of their apps."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from pluto_fleet.shared.alone.testing import AppKit, Clock, HookCall, KitContext
from pluto_fleet.shared.events import testing as with_events
from tests.examples.test_docs import DOCS, blocks
from tests.kit.apps import EXAMPLES, compiled, compiled_file
from tests.kit.command import python

PAGE = DOCS / "testing-hooks.md"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the package of the page's app, with the page's tests instead of the generated ones."""
    folder = tmp_path_factory.mktemp("page")
    (app,) = blocks(PAGE, "pluto")
    (folder / "app.pluto").write_text(app, "utf-8")
    hooks, *tests = blocks(PAGE, "python")
    (folder / "hooks.py").write_text(hooks, "utf-8")
    made = compiled_file(folder / "app.pluto", folder / "greenhouse")
    for number, test in enumerate(tests):
        (made / f"tests/test_{number}.py").write_text(test, "utf-8")
    return made


@pytest.mark.long
@pytest.mark.process
def test_the_hooks_of_the_page_pass_its_tests(package: Path) -> None:
    """And the generated ones, which hold for any."""
    tests = sum(text.count("\ndef test_") for text in blocks(PAGE, "python"))
    assert tests == 10
    words = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "--ignore=tests/test_flow.py")
    ran = python(*words, cwd=package, PYTHONPATH="")
    assert f"{tests + 5} passed" in ran.out, ran.out + ran.err


def test_the_page_lists_what_there_is() -> None:
    """All that a test can use, and each fixture."""
    text = PAGE.read_text("utf-8")
    kits = (("kit", AppKit), ("kit", with_events.AppKit))
    for of, kind in (*kits, ("clock", Clock), ("call", HookCall)):
        for name in vars(kind):
            if not name.startswith("_"):
                assert re.search(rf"`{of}\.{name}[`(]", text), f"{of}.{name}"
    inner = {"lend", "take_back"}
    of_events = {"emitted", "stored", "missions", "cancelled", "see"}
    for name in {*vars(KitContext), "lines", "sensors", "written", *of_events} - inner:
        if not name.startswith("_"):
            assert re.search(rf"`context\.{name}[`(]", text), name


def test_the_page_lists_the_fixtures(package: Path) -> None:
    """Those of the conftest.py that is written."""
    fixtures = re.findall(
        r"^def (\w+)\(", (package / "tests/conftest.py").read_text("utf-8"), re.MULTILINE
    )
    table = PAGE.read_text("utf-8").partition("| fixture |")[2].partition("\n\n")[0]
    assert sorted(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)) == sorted(fixtures)


WITH_HOOKS = sorted(path.parent.name for path in EXAMPLES.glob("*/hooks.py"))


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("name", WITH_HOOKS)
def test_tests_beside_the_hooks_pass_in_the_package(name: str, tmp_path: Path) -> None:
    """Copied to where their first line says; every hook of the app is in them."""
    tests = EXAMPLES / name / "test_hooks.py"
    text = tests.read_text("utf-8")
    assert f"cp test_hooks.py {name}/tests/" in text.splitlines()[0]
    package = compiled(name, tmp_path)
    generated = (package / "tests/test_hooks.py").read_text("utf-8")
    hooks = {word.partition("(")[0] for word in generated.split("hooks.")[1:]}
    for hook in {one.partition(",")[0] for one in hooks if one.partition(",")[0].isidentifier()}:
        assert f"hooks.{hook}" in text
    shutil.copy(tests, package / "tests")
    words = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_hooks.py")
    ran = python(*words, cwd=package, PYTHONPATH="")
    assert ran.code == 0 and " passed" in ran.out, ran.out + ran.err
