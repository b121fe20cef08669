"""`version` and `requires`: what they come to, and what is said of mistakes in them."""

from __future__ import annotations

import pytest

from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.edits import applied
from plutoc.graph.resolve import resolved
from plutoc.source import Source
from plutoc.syntax.parse import read
from tests.compiler.graph.fakes import BLOCKS, codes, graph, graph_of


def said(text: str) -> list[str | None]:
    """Return the help of all errors."""
    with pytest.raises(Rejected) as caught:
        graph_of(text)
    return [found.help for found in caught.value.diagnostics]


def _warnings(text: str) -> tuple[Diagnostic, ...]:
    return graph_of(text)[1]


def test_an_app_without_settings_has_a_version_and_requires_nothing() -> None:
    plain = graph("a = Pass")
    assert (plain.version, plain.version_span, plain.libraries) == ("0.1.0", None, ())


@pytest.mark.parametrize(
    ("written", "version"),
    [("1.2.0", "1.2.0"), ("1.2.0-beta", "1.2.0b0"), (" v2 ", "2"), ("2!1.0+here", "2!1.0+here")],
)
def test_a_version_is_as_installers_write_it(written: str, version: str) -> None:
    assert graph(f'version "{written}"').version == version


@pytest.mark.parametrize(
    ("written", "meant"),
    [("1.2.x", "1.2"), ("2024-01-15", "2024.1.15"), ("1,2", "1.2"), ("release 3", "3")],
)
def test_the_version_that_was_meant_is_proposed(written: str, meant: str) -> None:
    assert said(f'version "{written}"') == [f'did you mean `version "{meant}"`?']


@pytest.mark.parametrize("written", ["", "final", "1" * 5000])
def test_a_version_that_cannot_be_guessed_is_refused_with_an_example(written: str) -> None:
    """One with more digits than Python reads, too."""
    assert said(f'version "{written}"') == [
        'a version has numbers with points between them: `version "1.2.0"`'
    ]


def test_libraries_are_as_written_and_named_as_installers_compare() -> None:
    libraries = graph(
        'requires "Field_Tools  >=2", "b[c]; os_name == \'nt\'", "d @ https://x.org/d"'
    ).libraries
    assert [(each.name, each.requirement, each.direct) for each in libraries] == [
        ("field-tools", "Field_Tools >=2", False),
        ("b", "b[c]; os_name == 'nt'", False),
        ("d", "d @ https://x.org/d", True),
    ]


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("numpy=>2", "numpy>=2"),
        ("numpy=<2,=>1", "numpy<=2,>=1"),
        ("numpy=2", "numpy==2"),
        ("numpy 2.1", "numpy>=2.1"),
        ("numpy^2", "numpy>=2"),
        ("numpy @ 2", "numpy>=2"),
        ("numpy>=2.x", "numpy>=2"),
        ("numpy==2.x", "numpy==2.*"),
        ("numpy>=2 <3", "numpy>=2,<3"),
        ("git+https://x.org/tools.git@main", "tools @ git+https://x.org/tools.git@main"),
    ],
)
def test_the_requirement_that_was_meant_is_proposed(written: str, meant: str) -> None:
    assert said(f'requires "{written}"') == [f'did you mean `"{meant}"`?']


def test_several_libraries_in_one_text_are_told_apart() -> None:
    assert said('requires "a>=1, b"') == ['each stands in quotes of its own: `"a>=1", "b"`']


@pytest.mark.parametrize("written", ["", "für", "a; " + "(" * 3000, "-r requirements.txt", "@"])
def test_what_is_no_requirement_at_all_is_refused(written: str) -> None:
    """However deep it is nested: Python's own reader of it gives up."""
    assert codes(f'requires "{written}"') == [f'P1041 "{written}"']


def test_each_mistake_of_a_list_is_told() -> None:
    found = codes('requires "a", "b=1", "pluto_fleet", "Demo"\nrequires "c d"\nversion "x"')
    assert found == [
        'P1041 "b=1"',
        'P1044 "pluto_fleet"',
        'P1044 "Demo"',
        'P1042 requires "c d"',
        'P1041 "c d"',
        'P1040 "x"',
    ]


def test_a_library_twice_is_warned_of_unless_its_conditions_differ() -> None:
    """And one requirement for both is proposed."""
    one, other = "a>=1; os_name == 'nt'", "a>=2; os_name != 'nt'"
    assert _warnings(f'requires "{one}", "{other}"') == ()
    (found,) = _warnings(f'requires "{one}", "b", "A[c]<3; os_name == \'nt\'"')
    assert found.code == "P1043"
    assert found.help == "write one for both: `\"a[c]>=1,<3; os_name == 'nt'\"`"
    assert found.fix is None


def test_the_very_same_library_twice_is_taken_out() -> None:
    """By `plutoc check --fix`."""
    (found,) = _warnings('requires "a>=1", "b", "A >= 1"')
    assert found.fix
    assert 'requires "a>=1", "b"\n' in applied(found.source, [found.fix])


def test_a_broken_setting_declares_no_name() -> None:
    """What stands there is no block: it is unknown elsewhere, as ever."""
    source = Source("app.pluto", "pluto 1\napp demo {\nrequires qqqq\nqqqq -> end\n}\n")
    file, mistakes = read(source)
    _, found = resolved(file, BLOCKS)
    assert [each.code for each in (*mistakes, *found)] == ["P0001", "P1032"]
