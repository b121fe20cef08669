"""How a plan is spoken of to whoever draws it on a screen, and never sees its file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...files.reading import Wording

if TYPE_CHECKING:
    from collections.abc import Container, Sequence

    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Trip

_CALLED = {
    "name": "the name",
    "target": "the place",
    "source": "the place where the flight begins",
    "mass": "the mass",
}
_MISSING = {
    "action": "has no action yet: choose one",
    "target": "has no place yet: drag it onto the floor plan, or type x and y",
    "name": "the item has no name yet",
    "mass": "the item has no mass yet: write it like 4 g",
}


def on_a_screen(app: App) -> Wording:
    """Return the words for screens, which have labels where files have keys."""
    called = {**_CALLED, **{field.name: field.label for field in app.fields}}
    return Wording(
        called=lambda key: called.get(key, key),
        missing=lambda key: _MISSING.get(key, f"has no {called.get(key, key)} yet"),
        no_trips=lambda: "has no trips yet: drag an action onto the floor plan",
        item_missing=lambda action: f"{action} needs an item: give its name and its mass",
    )


def own_names(app: App) -> frozenset[str]:
    """Return the names of the app's that a sentence may begin with."""
    parameters = (one.name for action in app.actions.values() for one in action.parameters)
    return frozenset((*app.actions, *parameters))


def sentence(text: str, names: Container[str]) -> str:
    """Begin a sentence with a capital, unless one of these names begins it."""
    return text if text.partition(" ")[0] in names else text[:1].upper() + text[1:]


def in_one_go(trips: Sequence[Trip], reason: str) -> str:
    """Say why nobody can fly these trips, beside the first of them."""
    if len(trips) == 1:
        return reason
    return f"from here to trip {trips[-1].name} one drone must fly all: {reason}"
