"""The grammar as tables in Python: what `plutoc_grammar/tables.py` must be.

For those who change the grammar; no command of the compiler comes here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap

from lark import Lark
from lark.grammar import Rule, Terminal
from lark.lexer import BasicLexer, PatternStr
from lark.parsers.lalr_analysis import Shift

from plutoc.syntax.grammar import START, made

_HEAD = '''\
"""What Lark makes of pluto.lark. Written by a test: `pytest tests/syntax/test_tables.py --update`.

TERMINALS are tried in their order; WORDS are those names and signs that are terminals of their own.
RULES: a name, how many parts it takes, and its children: n is the n-th part, ~n the children of the
n-th, None an empty place; None for them all is every part as it is. STATES: for what comes next the
next state, or ~n where the n-th rule is complete.
"""

from __future__ import annotations

# fmt: off
'''
_WIDTH = 100

Action = int | Rule


def tabulated() -> str:
    """Return the text of the module."""
    lark = made()
    lexer = BasicLexer(lark.lexer_conf)
    words = {
        each.pattern.value: each.name
        for each in lexer.terminals
        if isinstance(each.pattern, PatternStr)
        and (each.pattern.value.isidentifier() or len(each.pattern.value) == 1)
    }
    terminals = [
        (each.name, each.pattern.to_regexp())
        for each in lexer.terminals
        if each.name not in words.values()
    ]
    # One pattern for all signs. It stands behind what can begin like one, and before `UNKNOWN`.
    signs = "".join(re.escape(word) for word in words if not word.isidentifier())
    terminals.insert([name for name, _ in terminals].index("_ARROW") + 1, ("SIGN", f"[{signs}]"))
    rules = sorted(lark.rules, key=lambda rule: (rule.origin.name, rule.order))
    states, accepts = _numbered(lark)
    parts = (
        ("TERMINALS: tuple[tuple[str, str], ...] = (", map(repr, terminals), ")"),
        ("IGNORED = (", map(repr, sorted(lexer.ignore_types)), ")"),
        ("WORDS = {", (f"{word!r}: {words[word]!r}" for word in sorted(words)), "}"),
        (
            "RULES: tuple[tuple[str, int, tuple[int | None, ...] | None], ...] = (",
            (repr((str(rule.origin.name), len(rule.expansion), _kept(rule))) for rule in rules),
            ")",
        ),
        (f"ACCEPTS = {accepts}\nSTATES: tuple[dict[str, int], ...] = (", _rows(states, rules), ")"),
    )
    return "\n".join([_HEAD, *(_literal(*part) for part in parts)])


def _literal(begin: str, items: Iterable[str], end: str) -> str:
    return "\n".join([begin, *(f"    {item}," for item in items), end, ""])


def _rows(states: Sequence[dict[str, Action]], rules: Sequence[Rule]) -> Iterator[str]:
    for state in states:
        row = {
            symbol: action if isinstance(action, int) else ~rules.index(action)
            for symbol, action in state.items()
        }
        yield "\n     ".join(wrap(repr(row), _WIDTH - 6, break_long_words=False))


def _numbered(lark: Lark) -> tuple[list[dict[str, Action]], int]:
    """Return the states, and which of them accepts, in an order that is the same in every run.

    Lark numbers them as they come out of its sets.
    """
    table = lark.parser.parser._parse_table
    order = [table.start_states[START]]
    found: list[dict[str, Action]] = []
    for number in order:  # it grows on the way
        row: dict[str, Action] = {}
        for symbol, (action, goal) in sorted(table.states[number].items()):
            if action is Shift and goal not in order:
                order.append(goal)
            row[str(symbol)] = order.index(goal) if action is Shift else goal
        found.append(row)
    return found, order.index(table.end_states[START])


def _kept(rule: Rule) -> tuple[int | None, ...] | None:
    """Say which children a rule has: what Lark's ParseTreeBuilder makes of its options."""
    options = rule.options
    assert rule.expansion and not rule.alias, "lalr.py knows no rule that is empty or has two names"
    assert not (options.expand1 or options.keep_all_tokens), "nor one that is left out at times"
    kept: list[int | None] = []
    expansion = iter(enumerate(rule.expansion))
    for is_empty in options.empty_indices or [False] * len(rule.expansion):
        if is_empty:
            kept.append(None)
            continue
        i, symbol = next(expansion)
        if not isinstance(symbol, Terminal):
            kept.append(~i if symbol.name.startswith("_") else i)
        elif not symbol.filter_out:
            kept.append(i)
    return None if kept == list(range(len(rule.expansion))) else tuple(kept)
