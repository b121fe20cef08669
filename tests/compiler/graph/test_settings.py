"""`version` and `requires`: what they come to, and what is said of mistakes in them."""

from __future__ import annotations

import pytest

from tests.compiler.graph.fakes import graph


def test_an_app_without_settings_has_a_version_and_requires_nothing() -> None:
    plain = graph("a = Pass")
    assert (plain.version, plain.version_span, plain.libraries) == ("0.1.0", None, ())


@pytest.mark.parametrize(
    ("written", "version"),
    [("1.2.0", "1.2.0"), ("1.2.0-beta", "1.2.0b0"), (" v2 ", "2"), ("2!1.0+here", "2!1.0+here")],
)
def test_a_version_is_as_installers_write_it(written: str, version: str) -> None:
    assert graph(f'version "{written}"').version == version


def test_libraries_are_as_written_and_named_as_installers_compare() -> None:
    libraries = graph(
        'requires "Field_Tools  >=2", "b[c]; os_name == \'nt\'", "d @ https://x.org/d"'
    ).libraries
    assert [(each.name, each.requirement, each.direct) for each in libraries] == [
        ("field-tools", "Field_Tools >=2", False),
        ("b", "b[c]; os_name == 'nt'", False),
        ("d", "d @ https://x.org/d", True),
    ]
