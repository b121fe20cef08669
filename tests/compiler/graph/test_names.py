"""Names of an app."""

from __future__ import annotations

import pytest

from plutoc.diagnostic import Rejected
from plutoc.graph.names import in_snake_case, near
from tests.compiler.graph.fakes import codes, graph_of


def test_statement_with_a_mistake_declares_its_name() -> None:
    """A block of an unknown kind is there for edges: one error, not two."""
    assert codes("a = Make\nb = Nope\nstart -> a -> b -> end") == ["P1012 Nope"]


def test_hook_with_a_mistake_does_not_spoil_its_block() -> None:
    """What a hook with a wrong parameter takes is not certain: the block is not judged by it."""
    found = codes("modifier m(x: wight, y: time = 3 m)\na = Call(hook: m, x: 3 g, z: 1)")
    assert found == ["P1026 wight", "P1019 3 m"]


def test_name_used_in_many_places_but_never_declared_is_told_once() -> None:
    """A forgotten declaration is one mistake."""
    assert codes("a = Pass\nqqq -> a\na -> qqq\nqqq -> end") == ["P1032 qqq"]


def test_name_is_told_once_with_all_its_places() -> None:
    """Misspelt or forgotten, it is one mistake."""
    with pytest.raises(Rejected) as caught:
        graph_of("alpha = Pass\nalpa -> end\n" + "start -> alpa\n" * 5)
    (only,) = [d for d in caught.value.diagnostics if d.code == "P1032"]
    assert only.help == "did you mean `alpha`?"
    assert [r.label for r in only.related] == ["here, too"] * 2 + [
        "here, too, and in 2 more places"
    ]


def test_parameters_are_a_namespace_of_their_own() -> None:
    """A block may have the name of a hook's parameter, and words of the language are free there."""
    found = codes(
        "modifier m(limit: int = 1, policy: int = 1, match: int = 1)\nlimit = Call(hook: m)"
    )
    assert found == []


def test_free_names_are_free() -> None:
    """Names of Python's functions and modules are not refused."""
    assert codes("pause = Pass\nlimit = Pass\nprint = Pass\nsafe = Pass\nasyncio = Pass") == []
    assert codes("version = Pass\nrequires = Pass\nstart -> version -> requires -> end") == []


def test_all_errors_are_told_at_once() -> None:
    """One run, all mistakes, in the order of the source."""
    found = codes("A = Pass\nb = Work(wait: 3)\nc = Nope\nc -> d")
    assert found == ["P1002 A", "P1018 3", "P1012 Nope", "P1032 d"]


@pytest.mark.parametrize("name", ["alfalfa", "crop_watch", "x1"])
def test_title_defaults_to_the_name(name: str) -> None:
    """An app without a title is called by its name."""
    assert graph_of("")[0].title == "Demo"


def test_unused_evaluator_is_no_mistake_where_a_mission_can_choose_it() -> None:
    """A plan may name any evaluator of an app that judges."""
    assert codes("evaluator e\na = Judge(strictness: 1)") == []
    assert codes("evaluator e\na = Pass") == ["P1030 e"]


def test_without_categories_every_action_is_used() -> None:
    """The implicit category can do everything."""
    assert codes("action spray") == []
    assert codes("action spray\ncategory scout can measure") == ["P1031 spray"]


def test_near_names_come_nearest_first() -> None:
    """Case does not count, and nothing is proposed that is far off."""
    assert near("Nearst", ["first", "nearest", "nearer"])[0] == "nearest"
    assert near("clock", ["Clock", "clocks"]) == ["Clock"]
    assert near("zebra", ["clock"]) == []


def test_snake_case() -> None:
    """A name is proposed that can be written."""
    assert [in_snake_case(n) for n in ("TakePhoto", "GPSFix", "A", "a_B")] == [
        "take_photo",
        "gps_fix",
        "a",
        "a_b",
    ]


def test_used_package_gives_its_kinds() -> None:
    """With a prefix, never without."""
    use = "use survey as s"
    assert codes("a = s.Scan", use) == []
    assert codes("a = Scan\nb = s.Scan", use) == ["P1012 Scan"]
    assert codes("a = s.Pass", use) == ["P1012 Pass"]
    assert codes("a = Pass", use) == ["P1010 use survey as s"]


def test_broken_package_breaks_only_who_uses_it() -> None:
    """Another app does not notice."""
    assert codes("a = Pass") == []
    assert codes("a = broken.Scan\na -> end", "use broken") == ["P1009 broken"]
