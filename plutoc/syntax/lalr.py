"""From tokens to a tree, by the tables that Lark makes of the grammar.

All that Lark's own loop does for a source in order, and nothing for one that is not: there its
parser is asked what it would have taken (state.py).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plutoc.syntax.newlines import END
from plutoc.syntax.tokens import Token
from plutoc_grammar.tables import ACCEPTS, RULES, STATES


class Node:
    """A rule, and what it was made of. As Lark's tree, with the place of all that it covers."""

    __slots__ = ("children", "data", "end_pos", "start_pos")

    def __init__(self, data: str, children: list[Child], start_pos: int, end_pos: int) -> None:
        self.data = data
        self.children = children
        self.start_pos = start_pos
        self.end_pos = end_pos


Child = Node | Token | None
"""None stands for what `[ ]` in a rule leaves out."""


def tree_of(tokens: Iterable[Token]) -> Node | None:
    """Return the tree of a whole source, or None where its tokens are not in order."""
    states = [0]
    values: list[Node | Token] = []
    for token in tokens:
        kind = token.type
        while True:
            action = STATES[states[-1]].get(kind)
            if action is None:
                return None
            if action >= 0:
                states.append(action)
                values.append(token)
                break
            name, size, kept = RULES[~action]
            parts = values[-size:]
            del values[-size:], states[-size:]
            children: list[Child] = [*parts] if kept is None else _children(parts, kept)
            # Every rule takes something, so that it begins and ends with what has a place.
            node = Node(name, children, parts[0].start_pos, parts[-1].end_pos)
            states.append(STATES[states[-1]][name])
            values.append(node)
            if kind == END and states[-1] == ACCEPTS:
                return node
    return None


def _children(parts: Sequence[Node | Token], kept: Iterable[int | None]) -> list[Child]:
    """Return what a rule keeps of its parts, as Lark does."""
    children: list[Child] = []
    for place in kept:
        if place is None:
            children.append(None)
        elif place >= 0:
            children.append(parts[place])
        else:
            helper = parts[~place]
            assert isinstance(helper, Node)
            if children:
                children += helper.children
            else:  # nobody else has it: a list of thousands grows and is not copied each time
                children = helper.children
    return children
