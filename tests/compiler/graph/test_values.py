"""Values of blocks and categories, and the settings of an app's package."""

from __future__ import annotations

import pytest

from plutoc.graph.model import Choose
from plutoc.graph.names import in_snake_case, near
from plutoc_runtime.domain.status import Status
from tests.compiler.graph.fakes import graph


def test_every_parameter_has_a_value() -> None:
    """Given or default, in SI units, in the order of the declaration."""
    node = graph("a = Work(level: 40 %, wait: 5 min, heat: 20 C)").node["a"]
    assert node.values == (
        ("wait", 300.0),
        ("tries", 3),
        ("factor", None),
        ("loud", False),
        ("label", ""),
        ("level", 0.4),
        ("heat", 293.15),
    )
    assert node.choices == (("way", Choose(name="left", hook=None, is_given=False)),)


def test_declaration_is_canonical_and_never_tells_a_text() -> None:
    """One line, as the formatter writes it."""
    node = graph('a = Work( label: "secret",\n wait:5min , loud: yes, factor: 0.50,\n)').node["a"]
    assert node.declaration == 'a = Work(label: "…", wait: 5 min, loud: yes, factor: 0.5)'


@pytest.mark.parametrize("value", ["1", "1.5", "-2"])
def test_whole_numbers_are_numbers(value: str) -> None:
    """A float parameter takes both, and is a float."""
    given = dict(graph(f"a = Work(factor: {value})").node["a"].values)["factor"]
    assert isinstance(given, float) and given == float(value)


def test_choice_can_be_a_hook_of_the_app() -> None:
    """The app's own policy, in the place of ours."""
    app = graph("policy mine\na = Work(way: mine)")
    assert app.node["a"].choices == (("way", Choose(name="mine", hook=app.hooks[0])),)


def test_hook_gets_its_parameters() -> None:
    """Given or default, in the hook's order."""
    app = graph(
        "modifier m(x: time, y: int = 3)\na = Call(y: 4, hook: m, x: 1 min)\nb = Call(hook: m, x: 1 s)"
    )
    assert app.node["a"].passed == (("x", 60.0), ("y", 4))
    assert app.node["b"].passed == (("x", 1.0), ("y", 3))


def test_hook_can_be_called_yes() -> None:
    """`yes` is a free name."""
    assert graph("modifier yes\na = Call(hook: yes)").node["a"].hook is not None


def test_emits_come_in_declared_order() -> None:
    """However the source orders them, each once."""
    app = graph("modifier m emits FAILED, STANDBY\na = Call(hook: m)")
    assert app.hooks[0].emits == (Status.STANDBY, Status.FAILED)
    assert app.node["a"].emitted(Status.RUNNING) == {Status.STANDBY, Status.FAILED}


def test_category_defaults() -> None:
    """10 g, 0.5 m/s, 7 min, 20 min, 20 %; without a category, one that can do everything."""
    (category,) = graph("").categories
    assert category.actions is None
    assert (category.payload, category.speed) == (0.01, 0.5)
    assert (category.flight_time, category.charge_time, category.reserve) == (420, 1200, 0.2)
    (scout,) = graph("category scout(speed: 3.6 km/h, reserve: 0 %) can take_photo").categories
    assert (scout.speed, scout.reserve, scout.actions) == (1.0, 0.0, ("take_photo",))


def test_a_drone_may_carry_nothing() -> None:
    (category,) = graph("category c(payload: 0 g) can measure").categories
    assert category.payload == 0.0


def test_action_takes_its_words() -> None:
    """Parameters in SI units; `once` unless it says otherwise."""
    one, two = graph("action spray(dose: mass = 50 mg, n: int)\naction look ask").actions
    assert [(p.name, p.default) for p in one.parameters] == [("dose", 5e-05), ("n", None)]
    assert (one.repeat, two.repeat) == ("once", "ask")


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
