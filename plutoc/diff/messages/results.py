"""What is said of how the results of actions are shown."""

from __future__ import annotations

from plutoc.diff.messages.declared import told
from plutoc.diff.model import Change
from plutoc.diff.phrases import amount
from plutoc.graph.model import Shown
from plutoc.graph.results import WAYS


def result_added(one: Shown) -> Change:
    """The app says something of results of which it said nothing."""
    sentence = f"what `{one.action}` gives is now shown as {_said(one)}"
    return told("result_added", sentence, (None, _said(one)), now=one.span)


def result_removed(one: Shown) -> Change:
    """The app says nothing any more of results."""
    sentence = f"what `{one.action}` gives is no longer said to be shown as {_said(one)}"
    return told("result_removed", sentence, (_said(one), None), was=one.span)


def result_changed(was: Shown, now: Shown) -> Change:
    """Results are shown otherwise, or something else is said of them."""
    sentence = f"what `{now.action}` gives is now shown as {_said(now)}; before, as {_said(was)}"
    return told("result_changed", sentence, (_said(was), _said(now)), was.span, now.span)


def _said(one: Shown) -> str:
    kinds = {param.name: param.type for param in WAYS[one.way]}
    given = ", ".join(f"{name}: {amount(value, kinds[name])}" for name, value in one.given)
    return f"`{one.way}` ({given})" if given else f"`{one.way}`"
