"""The hooks of the examples are tested as a developer would, by the kit of their own packages."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.kit.apps import EXAMPLES, compiled
from tests.kit.command import python

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
