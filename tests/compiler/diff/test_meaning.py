"""What is said is what has changed: no more, and no less."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import islice
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.compile import planned
from plutoc.diagnostic import Rejected
from plutoc.diff.model import Version
from plutoc.diff.run import compare
from plutoc.format.run import format_source
from plutoc.graph.model import END
from plutoc.plan.show import show
from plutoc.source import Source
from tests.compiler.diff.pairs import EXAMPLES, difference, sentences, version
from tests.format.layouts import Liberty, laid_out, words_of
from tests.soundness.app import App, thesis_graphs
from tests.soundness.mutants import mutants

GRAPHS = thesis_graphs()
SHARE = 40
"""One mutant of so many is looked at here."""
SEEDS = st.integers(min_value=0, max_value=10**6)


@cache
def checked(name: str) -> Version:
    """Check one of the thesis's graphs, once."""
    return version(GRAPHS[name].text)


def accepted(app: App) -> Version | None:
    """Check an app, if it has no errors."""
    try:
        return version(app.text)
    except Rejected:
        return None


@pytest.mark.parametrize("name", GRAPHS)
def test_an_app_differs_in_nothing_from_itself(name: str) -> None:
    """Nor from its canonical form."""
    text = GRAPHS[name].text
    assert sentences(text, text) == []
    assert sentences(text, format_source(Source("app.pluto", text))) == []


@settings(max_examples=12)
@given(st.sampled_from(sorted(EXAMPLES)), SEEDS)
def test_layout_and_comments_mean_nothing(name: str, seed: int) -> None:
    """In any order of the source."""
    text = EXAMPLES[name]
    other = laid_out(words_of(text), Random(seed), Liberty(comments=0.2))
    assert sentences(text, other) == []


@settings(max_examples=12)
@given(st.sampled_from(sorted(GRAPHS)), SEEDS)
def test_the_order_of_declarations_means_nothing(name: str, seed: int) -> None:
    """Nor that of the edges, as long as the branches of a fork keep theirs."""
    app, random = GRAPHS[name], Random(seed)
    rest, blocks, arrows = list(app.rest), list(app.blocks), list(app.arrows)
    random.shuffle(rest)
    random.shuffle(blocks)
    random.shuffle(arrows)
    places = [arrow.source for arrow in arrows]
    kept = {source: [a for a in app.arrows if a.source == source] for source in places}
    in_turn = tuple(kept[source].pop(0) for source in places)
    other = replace(app, rest=tuple(rest), blocks=tuple(blocks), arrows=in_turn)
    assert sentences(app.text, other.text) == []


@settings(max_examples=12)
@given(st.sampled_from(sorted(GRAPHS)), SEEDS)
def test_other_names_are_recognised_and_nothing_else_is_said(name: str, seed: int) -> None:
    """However many of the blocks have one."""
    app, random = GRAPHS[name], Random(seed)
    chosen = [block.name for block in app.blocks if random.random() < 0.5]
    other = renamed(app, {name: f"{name}_{random.randint(0, 9)}" for name in chosen})
    found = difference(app.text, other.text).changes
    assert [change.kind for change in found] == ["block_renamed"] * len(chosen)
    assert all("nothing else about it changes" in change.sentence for change in found)


def renamed(app: App, names: dict[str, str]) -> App:
    """Call some blocks otherwise."""

    def called(name: str) -> str:
        return names.get(name, name)

    return replace(
        app,
        blocks=tuple(replace(block, name=called(block.name)) for block in app.blocks),
        arrows=tuple(
            replace(arrow, source=called(arrow.source), target=called(arrow.target))
            for arrow in app.arrows
        ),
    )


def seen(app: Version) -> object:
    """Return what the checks found out of the ways of missions, and what stands on them.

    An end without an edge is an end; that there is none is a warning.
    """
    found, graph = app.checked, app.checked.graph
    ways = [
        (edge.source, edge.target, s.value) for edge in graph.edges for s in found.carries[edge]
    ]
    return (
        sorted(ways + [(name, END, status.value) for name, status in found.implicit_ends]),
        sorted((fork.node, fork.status.value, fork.gate) for fork in found.forks),
        [(node.name, node.block.name, node.values) for node in graph.nodes],
    )


@pytest.mark.parametrize("name", GRAPHS)
def test_every_edit_that_changes_the_checked_graph_is_told(name: str) -> None:
    """And of others nothing is said but what the compiler warns of."""
    old = checked(name)
    silent: list[Version] = []
    for mutant in islice(mutants(GRAPHS[name]), len(name) % SHARE, None, SHARE):
        new = accepted(mutant.app)
        if new is None:
            continue
        changes, back = compare(old, new).changes, compare(new, old).changes
        told = [change for change in changes if not change.kind.startswith("warning")]
        assert bool(told) == (seen(old) != seen(new)), (mutant.what, changes)
        assert bool(back) == bool(changes), mutant.what
        assert changes or new.checked.implicit_ends == old.checked.implicit_ends
        if not changes:
            silent.append(new)
    plain = show(planned(old.checked))
    for new in Random(name).sample(silent, min(3, len(silent))):
        assert show(planned(new.checked)) == plain, "nothing was said, and the code is another"
