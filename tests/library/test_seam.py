"""An app and a library have the same seam, or one sentence says what to do."""

from __future__ import annotations

from typing import NoReturn

import pytest
from packaging.specifiers import SpecifierSet

from pluto_fleet import __version__, entry
from pluto_fleet.seam import problem
from pluto_fleet.shared.domain.app import SEAM, library_for


def told(seam: int) -> str:
    return (
        f"greenhouse speaks seam {seam}, pluto-fleet {__version__} speaks seam {SEAM}:"
        f' compile greenhouse again, or pip install "pluto-fleet==0.{seam}.*"'
    )


def test_what_an_app_requires_is_the_library_that_speaks_its_seam() -> None:
    assert SpecifierSet(library_for(SEAM)).contains(__version__)
    assert not SpecifierSet(library_for(SEAM + 1)).contains(__version__)


def test_the_same_seam_is_no_problem() -> None:
    assert problem("greenhouse", SEAM) is None


@pytest.mark.parametrize("seam", [SEAM - 1, SEAM + 1, SEAM + 9])
def test_any_other_seam_is_refused_before_the_app_is_loaded(
    seam: int, capsys: pytest.CaptureFixture[str]
) -> None:
    def load() -> NoReturn:
        raise AssertionError("nothing of the app may be run")

    class App:
        name = "greenhouse"

    assert entry.start("greenhouse", load, brain="greenhouse._runtime", seam=seam) == 2
    assert entry.main(App(), ["--version"], brain="greenhouse._runtime", seam=seam) == 2
    assert capsys.readouterr() == ("", f"{told(seam)}\n" * 2)
