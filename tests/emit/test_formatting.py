"""Generated texts come out as Black writes them, though Black is seldom asked."""

from __future__ import annotations

import hypothesis.strategies as st
import pytest
from hypothesis import example, given, settings

from plutoc.emit import canonical, pieces, python
from plutoc.emit.canonical import are_well_apart, is_known, settled, text_of
from plutoc.emit.lines import Logical, logical_lines
from plutoc.emit.pieces import in_pieces
from plutoc.emit.python import black_asked
from tests.emit.texts import KNOWN, file_of, learned, texts, written


def test_the_known_shapes_are_those_that_black_writes(update: bool) -> None:
    """In the packages of our examples; `pytest tests/emit --update` writes the file."""
    if update:
        KNOWN.write_text(file_of(learned()), encoding="ascii")
        canonical.known.cache_clear()
    assert KNOWN.read_text(encoding="ascii") == file_of(learned())


def test_the_examples_need_no_black(monkeypatch: pytest.MonkeyPatch) -> None:
    """And come out as it would write them."""
    monkeypatch.setattr(python, "black_asked", pytest.fail)
    for text, wanted in zip(texts(), written(), strict=True):
        assert python._formatted(text) == wanted


NAMES = st.integers(1, 60).map(lambda length: ("a_long_name_of_something_" * 3)[:length].strip("_"))
TEXTS = st.integers(0, 70).map(lambda length: f'"{"some words " * 7:.{length}}"')
VALUES = st.one_of(
    NAMES,
    TEXTS,
    st.sampled_from(["0", "1.5", "5e-05", "None", "True", "'a'", '"\\"q\\""', '"é"', "(1,)", "()"]),
    NAMES.map(lambda name: f"run.mission.{name}"),
)
ARGUMENTS = st.lists(
    st.one_of(NAMES, st.tuples(NAMES, VALUES).map("=".join)), min_size=0, max_size=6
).map(", ".join)
CALLS = st.tuples(NAMES, ARGUMENTS).map(lambda call: f"{call[0]}({call[1]})")
NESTED = st.tuples(NAMES, NAMES, CALLS, ARGUMENTS).map(
    lambda parts: f"{parts[0]}({parts[1]}={parts[2]}{', ' if parts[3] else ''}{parts[3]})"
)
ANY_CALL = st.one_of(CALLS, NESTED)
STATEMENTS = st.one_of(
    ANY_CALL,
    ANY_CALL.map(lambda call: f"status = await {call}"),
    ANY_CALL.map(lambda call: f"return await {call}"),
    ANY_CALL.map(lambda call: f"status = {call}"),
    ANY_CALL.map(lambda call: f"x = [{call}, {call},]"),
    ANY_CALL.map(lambda call: f"x = {{'a': {call},}}"),
    ANY_CALL.map(lambda call: f"x = (\n{{indent}}    {call},\n{{indent}})"),
    st.tuples(NAMES, NAMES).map(lambda names: f"{names[0]}: {names[1]} | None = None"),
    st.tuples(NAMES, NAMES).map(
        lambda names: f"if status in (Status.{names[0]}, Status.{names[1]}):\n{{indent}}    return x"
    ),
    NAMES.map(lambda name: f"# {name} = Kind(a: 1)"),
)


def module(statements: list[str], depth: int) -> str:
    """Return a module with statements in so many blocks."""
    heads = "".join(f"{'    ' * number}if x:\n" for number in range(depth))
    indent = "    " * depth
    lines = (indent + one.replace("{indent}", indent) for one in statements)
    return heads + "\n".join(lines) + f"\n{indent}y = x\n"


@settings(max_examples=150)
@given(st.lists(STATEMENTS, min_size=1, max_size=4), st.integers(0, 6))
@example(["x = f(a,)", "x = (1,)", "x = {1,}"], 0)
@example(["status = await f(" + "a" * 78 + ")"], 1)
@example(["status = await f(" + "a" * 79 + ")"], 1)
def test_a_text_that_is_known_is_as_black_writes_it(statements: list[str], depth: int) -> None:
    """Whatever the lengths of its names, and however deep it stands."""
    text = module(statements, depth)
    lines = settled(text)
    wanted = black_asked(text)
    if are_well_apart(lines) and all(map(is_known, lines)):
        assert text_of(lines) == wanted


@settings(max_examples=50)
@given(st.lists(STATEMENTS, min_size=1, max_size=4), st.integers(0, 6))
def test_lines_that_black_gets_alone_come_out_as_in_their_module(
    statements: list[str], depth: int
) -> None:
    """So a large module can be given to it in pieces."""
    text = module(statements, depth)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces, "LARGE", 0)
        patch.setattr(pieces, "are_well_apart", lambda lines: True)
        patch.setattr(
            pieces, "is_known", lambda line: line.lines[0].startswith(" " * 4 * depth) is False
        )
        found = in_pieces(logical_lines(text), black_asked)
    assert found in (None, black_asked(text))


def test_a_large_module_is_given_to_black_in_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    """It gets what is unknown, and nothing else."""
    asked: list[str] = []

    def ask(text: str) -> str:
        asked.append(text)
        return black_asked(text)

    odd = "        x  =  'odd'\n"
    text = "async def f(x: y) -> z:\n    while True:\n" + "        x = y\n" * 500 + odd
    lines = logical_lines(text)
    monkeypatch.setattr(pieces, "are_well_apart", lambda lines: True)
    monkeypatch.setattr(pieces, "is_known", lambda line: line.lines[0].strip() != odd.strip())
    assert in_pieces(lines, ask) == black_asked(text)
    assert len(asked) == 1
    assert asked[0].count("\n") == 4


@pytest.mark.parametrize(
    "odd",
    [
        "x = 'single'\n",
        "x = '\"'\n",
        "x = '\"\\''\n",
        'x = "\\""\n',
        "x = b'\"'\n",
        "x = 0XFF\n",
        "x = 1_000 if y else 1E5\n",
        "x = f'{y}'\n",
        "x = a if b else c\n",
        "x = 1 # type: ignore\n",
        "x = 1  # fmt: skip\n",
        "#comment\n",
        "# comment \n",
        "x = (yield)\n",
        "x = ((y))\n",
        "x =  y\n",
        "x = y ;z = x\n",
        "x = [\n  y\n]\n",
        'x = """\\\ntext"""  \n',
        'def f() -> x:\n    """ text"""\n',
        'def f() -> x:\n    """text\n  more\n    """\n',
        'def f() -> x:\n    """text """\n',
        'def f() -> x:\n    """text\n\n    """\n',
        "x = y\n\n\n\nx = y\n",
        "def f() -> x:\n\n    return x\n",
        "def f() -> x:\n    return x\nx = y\n",
        "x = y\n\n",
        "\nx = y\n",
        "x = (\n    y\n)\n",
        "x = f(\n    y\n)\n",
        "x = f(\n    y,\n    z\n)\n",
        "x = f(\n    y, z,\n)\n",
        "x = f(\n    # fmt: off\n    y,\n)\n",
        "if x :\n    pass\n",
        "x = \\\n    y\n",
        "x\t= y\n",
        "x = 'a' 'b'\n",
        "f(a)(b)\n",
        f"x = {'y' * 97}\n",
        f"# {'y ' * 60}y\n",
        f"x = f(\n    # {'y ' * 60}y\n    y,\n)\n",
        f"x = f({'é' * 60})\n",
    ],
)
def test_what_black_would_change_is_never_taken_as_it_is(odd: str) -> None:
    """Nor what nobody knows about."""
    assert python._formatted(odd) == black_asked(odd)


def test_a_text_comes_out_the_same_with_and_without_what_was_kept(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A cache changes when a package is there, and not what is in it."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("empty")))
    for _ in range(2):
        for text, wanted in zip(texts(), written(), strict=True):
            assert python.formatted(text) == wanted


def test_logical_lines_are_a_text_again() -> None:
    """Nothing of it gets lost."""
    for text in (*texts(), *written()):
        lines: list[Logical] = logical_lines(text)
        assert text_of(lines).strip("\n") == text.strip("\n")
