"""Flying Crazyflies comes with an extra, in the version that was read and measured."""

from __future__ import annotations

from importlib.metadata import version

from tests.paths import ROOT


def test_the_extra_names_the_version_that_the_tests_fly_with() -> None:
    """With its mends; another minor version may do otherwise."""
    for file in ("plutoc/emit/templates/pyproject.toml.jinja", "runtime/pyproject.toml"):
        assert 'crazyflie = ["cflib>=0.1.34,<0.2"]' in (ROOT / file).read_text(encoding="utf-8")
    major, minor, *mend = map(int, version("cflib").split(".")[:3])
    assert (major, minor) == (0, 1)
    assert mend >= [34]
