"""Text → tree."""

from __future__ import annotations

import pytest

from plutoc.source import Source
from plutoc.syntax.parse import parse
from plutoc.syntax.tokens import OWNERS, SOFT_WORDS, WORDS
from plutoc.syntax.tree import (
    ActionDecl,
    BlockDecl,
    Bool,
    EventDecl,
    FieldsDecl,
    File,
    FlowDecl,
    HookDecl,
    List,
    Name,
    Number,
    Quantity,
    ResultDecl,
    Statement,
    Text,
    Value,
)
from tests.paths import CASES

SAMPLE = (CASES / "alfalfa" / "app.pluto").read_text("utf-8")


def parsed(text: str) -> File:
    """Parse a whole source."""
    return parse(Source("app.pluto", text))


def statements(text: str) -> tuple[Statement, ...]:
    """Parse what stands in an app's braces."""
    return parsed(f"pluto 1\napp demo {{\n{text}\n}}\n").app.statements


def value(text: str) -> Value:
    """Parse a value."""
    (block,) = statements(f"a = K(x: {text})")
    assert isinstance(block, BlockDecl)
    return block.arguments[0].value


def flow(text: str) -> list[tuple[str, ...]]:
    """Parse a flow: the names at its stops."""
    (found,) = statements(text)
    assert isinstance(found, FlowDecl)
    return [tuple(name.text for name in stop.names) for stop in found.stops]


def test_values() -> None:
    """Every kind of value."""
    match value('[3, -0.5, 5 min, 40%, 0.8 m/s, "a \\"b\\" \\\\", yes, no, nearest, [],]'):
        case List(
            items=(
                Number(value=3),
                Number(value=-0.5),
                Quantity(value=5, unit="min"),
                Quantity(value=40, unit="%"),
                Quantity(value=0.8, unit="m/s"),
                Text(value='a "b" \\'),
                Bool(value=True),
                Bool(value=False),
                Name(text="nearest"),
                List(items=()),
            )
        ):
            pass
        case other:
            pytest.fail(repr(other))


def test_hooks() -> None:
    """Parameters, emits and writes, each optional."""
    full, bare, action = statements(
        "modifier m(limit: time = 3 min, n: int,) emits STANDBY, FAILED writes delay, gap\n"
        "policy p\naction a(dose: mass) ask"
    )
    assert isinstance(full, HookDecl) and isinstance(bare, HookDecl)
    assert [p.name.text for p in full.parameters] == ["limit", "n"]
    assert isinstance(full.parameters[0].default, Quantity) and full.parameters[1].default is None
    assert [n.text for n in (*full.emits, *full.writes)] == ["STANDBY", "FAILED", "delay", "gap"]
    assert (full.kind, bare.kind, bare.parameters, bare.emits) == ("modifier", "policy", (), ())
    assert isinstance(action, ActionDecl) and action.repeat and action.repeat.text == "ask"


@pytest.mark.parametrize("word", SOFT_WORDS)
def test_words_of_settings_are_names_wherever_no_setting_begins(word: str) -> None:
    """Apps have blocks of such names: they stay as they are."""
    text = f"{word} = K\n{word} -> a\n{word}\n-> a\na -> {word}\na = {word}.K\naction {word}"
    assert [type(each) for each in statements(f"{text}\n[\n{word}, {word}]\n-> a -> {word}")] == [
        *(BlockDecl, FlowDecl, FlowDecl, FlowDecl, BlockDecl, ActionDecl, FlowDecl),
    ]
    file = parsed(f"pluto 1\nuse {word} as {word}\napp {word} {{\n{word} = K }}\n")
    assert (file.app.name.text, file.uses[0].package.text) == (word, word)


@pytest.mark.parametrize("on", OWNERS)
def test_fields_have_types_and_perhaps_defaults(on: str) -> None:
    """One statement declares several; their names may be those of the statement itself."""
    (one,) = statements(f"{on} has has: text, mission: time = 5 min, trip: bool = no,")
    assert isinstance(one, FieldsDecl)
    fields = [(field.name.text, field.type.text, field.default is None) for field in one.fields]
    assert (one.on, fields) == (
        on,
        [("has", "text", True), ("mission", "time", False), ("trip", "bool", False)],
    )


@pytest.mark.parametrize(
    ("text", "gives", "repeat"),
    [
        ("action a", None, None),
        ("action a -> float", "float", None),
        ("action a(b: mass)\n  -> float once", "float", "once"),
        ("action a() once -> photo", "photo", "once"),
        ("action a safe", None, "safe"),
    ],
)
def test_an_action_may_say_what_it_gives(text: str, gives: str | None, repeat: str | None) -> None:
    """Before the word that says whether it may be repeated, or behind it."""
    (one,) = statements(text)
    assert isinstance(one, ActionDecl)
    given = [each and each.text for each in (one.returns, one.repeat)]
    assert given == [gives, repeat]


@pytest.mark.parametrize("word", [*WORDS, *SOFT_WORDS])
def test_words_are_names_inside_brackets(word: str) -> None:
    """A parameter, a value and a stop in brackets may be called so."""
    (block,) = statements(f"a = K({word}: {word})")
    assert isinstance(block, BlockDecl)
    assert (block.arguments[0].name.text, block.arguments[0].value) == (
        word,
        Name(text=word, span=block.arguments[0].value.span),
    )
    assert flow(f"[a, {word}] -> b") == [("a", word), ("b",)]


@pytest.mark.parametrize(
    "text",
    [
        "a -> b -> c",
        "a\n  -> b\n  -> c",
        "a\n\n  # why\n  -> b  # that\n-> c",
        "\n\na -> b -> c\n\n",
        "a->b->c",
        "a\r\n  -> b -> c\r\n",
        "[\n a,\n] -> [b\n] -> c",
    ],
)
def test_newlines_that_end_nothing(text: str) -> None:
    """Inside brackets and before an arrow, a statement goes on."""
    assert flow(text) == [("a",), ("b",), ("c",)]


@pytest.mark.parametrize("space", ["", " ", "\n", "\n\n  \n", "  # empty\n"])
def test_empty_app(space: str) -> None:
    """An app without statements is for the checks to refuse."""
    assert statements(space) == ()


@pytest.mark.parametrize("end", ["", "\n", "\n\n# the end", "\r\n"])
def test_app_on_one_line(end: str) -> None:
    """A brace ends the last statement."""
    file = parsed("pluto 1\napp demo { a -> b }" + end)
    assert len(file.app.statements) == 1


def test_spans_are_places_in_the_source() -> None:
    """Of every statement, with all that stands before it."""
    source = Source("a", "\ufeffpluto 1\r\n# ü 日本\r\napp demo {\r\n  a = K(x: 5 min)  # x\r\n}")
    (block,) = parse(source).app.statements
    assert source.quote(block.span) == "a = K(x: 5 min)"
    assert isinstance(block, BlockDecl)
    assert source.quote(block.arguments[0].value.span) == "5 min"
    assert source.quote(parse(source).app.span).endswith("}")


def test_result_is_a_word_only_where_it_begins_its_statement() -> None:
    """A block, or anything else, may be called so, as before there was that word."""
    text = "result = K\nresult -> result\nresult x as heat(result: 1)"
    block, flow, said = statements(text)
    assert isinstance(block, BlockDecl)
    assert isinstance(flow, FlowDecl)
    assert isinstance(said, ResultDecl)
    assert (said.action.text, said.way.text) == ("x", "heat")
    assert [one.name.text for one in said.arguments] == ["result"]


def test_event_and_creator_are_words_only_where_they_begin_their_statements() -> None:
    """And `along` stands where an action says whether it is repeated."""
    text = 'event = K(creator: event)\nevent -> creator\nevent event(event: text = "a")\ncreator creator\naction along along'
    block, flow, event, creator, action = statements(text)
    assert isinstance(block, BlockDecl)
    assert isinstance(flow, FlowDecl)
    assert isinstance(event, EventDecl)
    assert (event.name.text, [one.name.text for one in event.fields]) == ("event", ["event"])
    assert isinstance(creator, HookDecl)
    assert (creator.kind, creator.name.text) == ("creator", "creator")
    assert isinstance(action, ActionDecl)
    assert action.repeat is not None
    assert (action.name.text, action.repeat.text) == ("along", "along")
