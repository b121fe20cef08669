"""Names of functions in `flow.py`: none hides another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from plutoc.emit.callables import imports_of, names_of
from plutoc.emit.embed import Carried
from plutoc.emit.python import import_lines


def carried(package: str, module: str, name: str) -> Carried:
    """Return a function that an installed module of that name would have."""

    def function() -> None: ...

    made: Callable[..., Any] = function
    made.__module__, made.__name__ = module, name
    return Carried(package=package, function=made)


def lines(*functions: Carried) -> list[str]:
    return import_lines(imports_of(names_of(functions)))


OURS = carried("std", "blocks.scan.step", "scan")
SURVEY = carried("survey", "pluto_survey.scan.step", "scan")


def test_a_name_that_is_free_is_kept() -> None:
    """No alias where none is needed."""
    assert lines(SURVEY) == ["from ._runtime.blocks.survey.scan import scan"]


def test_ours_keeps_its_name() -> None:
    """A further package in the graph changes no line of what was there."""
    assert lines(SURVEY, OURS) == [
        "from ._runtime.blocks.scan import scan",
        "from ._runtime.blocks.survey.scan import scan as survey_scan",
    ]


def test_two_packages_of_others_are_treated_alike() -> None:
    """Neither has the bare name."""
    other = carried("mapping", "pluto_mapping.scan", "scan")
    assert list(names_of((SURVEY, other)).values()) == ["survey_scan", "mapping_scan"]


def test_words_of_the_flow_itself_are_avoided() -> None:
    """`run`, `status` and the like mean something there; a leading `_` is for branches."""
    functions = [carried("survey", "s.a", name) for name in ("run", "hooks", "_watch")]
    names = names_of(tuple(functions)).values()
    assert list(names) == ["survey_run", "survey_hooks", "survey_watch"]


def test_what_is_still_the_same_is_numbered() -> None:
    """Two modules of one package may name functions alike."""
    other = carried("survey", "pluto_survey.more", "scan")
    third = carried("std", "blocks.x", "survey_scan")
    assert list(names_of((SURVEY, other, third)).values()) == [
        "survey_scan",
        "survey_scan_2",
        "survey_scan_3",
    ]
