"""Values of blocks and categories."""

from __future__ import annotations

import pytest

from plutoc.graph.model import Choose
from plutoc_runtime.domain.status import Status
from tests.compiler.graph.fakes import codes, graph


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


@pytest.mark.parametrize(
    ("argument", "code"),
    [
        ("wait: 5", "P1018"),
        ("wait: 5 m", "P1019"),
        ("wait: 5 mins", "P1017"),
        ("wait: soon", "P1016"),
        ("wait: [5 s]", "P1016"),
        ("wait: -1 s", "P1020"),
        ("tries: 1.5", "P1016"),
        ("tries: 3 s", "P1019"),
        ("tries: -1", "P1020"),
        ("factor: yes", "P1016"),
        ("loud: 1", "P1016"),
        ("label: word", "P1016"),
        ("level: 101 %", "P1020"),
        ("heat: -1 K", "P1020"),
        ("way: up", "P1021"),
        ("way: 3", "P1016"),
        ("wait: 1 s, wait: 2 s", "P1014"),
        ("wat: 1 s", "P1013"),
    ],
)
def test_wrong_value_is_one_error(argument: str, code: str) -> None:
    """Each mistake has its code, and comes alone."""
    assert [found.split()[0] for found in codes(f"a = Work({argument})")] == [code]


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
    assert codes("modifier m(x: time)\na = Call(hook: m)") == ["P1015 a"]
    assert codes("modifier m(x: time)\na = Call(hook: m, x: 1 s, z: 1)") == ["P1013 z"]


def test_hook_of_another_kind_is_refused() -> None:
    """A modifier is no evaluator, a block is no hook, and nothing is nothing."""
    assert codes("policy p\na = Call(hook: p)") == ["P1023 p"]
    assert codes("a = Call(hook: a)") == ["P1023 a"]
    assert codes("a = Call(hook: q)") == ["P1022 q"]
    assert codes("a = Call") == ["P1015 a"]


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


@pytest.mark.parametrize(
    "argument",
    [
        *("payload: -1 g", "payload: 5000 kg", "speed: -1 m/s", "speed: 0.00000000000001 m/s"),
        *("speed: 5000 m/s", "flight_time: 0 s", "flight_time: 0.00000000000001 s"),
        *("charge_time: 0.5 s", "charge_time: 1000 h", "reserve: 100 %"),
    ],
)
def test_impossible_category_is_refused(argument: str) -> None:
    """No drone is so slow, or so fast, or so small; and the reserve is less than all."""
    assert [f.split()[0] for f in codes(f"category c({argument}) can measure")] == ["P1020"]


def test_a_drone_may_carry_nothing() -> None:
    (category,) = graph("category c(payload: 0 g) can measure").categories
    assert category.payload == 0.0


def test_action_takes_its_words() -> None:
    """Parameters in SI units; `once` unless it says otherwise."""
    one, two = graph("action spray(dose: mass = 50 mg, n: int)\naction look ask").actions
    assert [(p.name, p.default) for p in one.parameters] == [("dose", 5e-05), ("n", None)]
    assert (one.repeat, two.repeat) == ("once", "ask")
