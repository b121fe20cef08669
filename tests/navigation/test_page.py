"""The page on navigation shows what there is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from plutoc_runtime.drones import errors, kinds
from plutoc_runtime.drones.conformance import NavigationContract

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "navigation.md").read_text()


@pytest.mark.parametrize("name", ["wren", "lines"])
def test_the_page_shows_the_files_as_they_are(name: str) -> None:
    text = (DOCS / f"navigation/{name}.py").read_text()
    assert text.partition("from __future__ import annotations\n\n")[2] in PAGE


def test_the_page_has_every_method_that_is_called() -> None:
    groups = [kinds.NAVIGATION_METHODS, *kinds.CAPABILITIES, kinds.LOCALIZATION_METHODS]
    for method in [method for group in groups for method in group]:
        called = f"{method.name}({', '.join(method.takes)})"
        if method.shape is kinds.Shape.PROPERTY:
            called = method.name
        assert f"`{called}`" in PAGE or f"`await {called}`" in PAGE or f"def {method.name}(" in PAGE


def test_the_page_has_every_failure() -> None:
    for error in errors.NavigationError.__subclasses__():
        assert f"`{error.__name__}`" in PAGE
        assert f'`"{error.failure}"`' in PAGE


def test_the_page_has_all_that_an_author_may_give() -> None:
    given = re.findall(r"`(\w+)(?: = True|\(.*?\))?`", PAGE.partition("it also tries")[2])
    names = [
        name
        for name in vars(NavigationContract.__mro__[1])
        if not name.startswith("_") and name not in ("rest", "connect_limit", "make")
    ]
    assert sorted({*names} - {*given}) == []
