"""What the results of an app's actions are, and as which layers of the map they are shown.

An app says it (`result ACTION as WAY`, which its package hands on as data); what it does not say has
the meaning that such actions have in every app.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any, Literal

from ...shared.domain.actions import MEASURE, PHOTO, PICK, RELEASE
from ...shared.domain.quantities import UNITS, Type, units_of

if TYPE_CHECKING:
    from ..wire import Layer, Quantity

Kind = Literal["measurement", "photo", "result", "handling"]
Said = Mapping[str, Any]
"""One statement of an app: `action`, `as`, and perhaps `type`, `quantity`, `unit`, `label`, …"""

SIMULATED_UNITS: Mapping[str, str] = {"temperature": "°C", "pm10": "µg/m³"}
"""The units of what a simulated world measures; of a real sensor's only an app can know."""

REACH = 3.0
"""Metres around its place for which a value of a heat map speaks, unless the app says otherwise."""

HEAT, VALUES, FINDINGS, PHOTOS, HANDLING = "heat", "values", "findings", "photos", "handling"

_ALWAYS: tuple[Said, ...] = (
    {"action": MEASURE, "as": HEAT},
    {"action": PHOTO, "as": PHOTOS},
    {"action": PHOTO, "as": FINDINGS},
    {"action": PICK, "as": HANDLING},
    {"action": RELEASE, "as": HANDLING},
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Meaning:
    """What the results of an action are: of `measure`, for one quantity."""

    kind: Kind
    layers: tuple[str, ...] = ()
    """The ids of the layers that show them."""
    quantity: str | None = None
    unit: str | None = None
    type: Type | None = None
    """The quantity's type where the value is in SI units, and `unit` one of that type's."""
    finds: str | None = None
    """What a `True` is called as a finding; None: results are no findings."""

    def number(self, value: object) -> Quantity | None:
        """Return a value as a number in its unit; None: it is none, or none that is finite."""
        if self.quantity is None or isinstance(value, bool) or not isinstance(value, int | float):
            return None
        try:
            plain = float(value)
        except OverflowError:
            return None
        if not isfinite(plain):
            return None
        if self.type is not None and self.unit is not None:
            _, factor, offset = UNITS[self.unit]
            plain = float(f"{(plain - offset) / factor:.12g}")
        return {"quantity": self.quantity, "value": plain, "unit": self.unit}


class Meanings:
    """What all results of an app are."""

    def __init__(
        self, said: Sequence[Said], actions: Iterable[str], units: Mapping[str, str]
    ) -> None:
        """`said` is what the app says; `units` are those of quantities where it says nothing."""
        self._units = units
        known = {*actions}
        spoken = {one["action"] for one in said}
        # Of `measure` the app speaks quantity by quantity, so the others keep their usual meaning.
        silenced = any(one["action"] == MEASURE and one["as"] == HANDLING for one in said)
        usual = [
            one
            for one in _ALWAYS
            if one["action"] not in spoken or (one["action"] == MEASURE and not silenced)
        ]
        self._said = [one for one in (*said, *usual) if one["action"] in known]

    @property
    def layers(self) -> list[Layer]:
        """The layers of the map, those that the app names first."""
        return [self._layer(one) for one in self._said if one["as"] != HANDLING]

    def of(self, action: str, quantity: object = None) -> Meaning:
        """Return what an action's results are; `quantity` is what a measurement was asked for."""
        said = [one for one in self._said if one["action"] == action]
        if action == MEASURE:
            mine = [one for one in said if one.get("quantity", quantity) == quantity]
            said = mine[:1]  # what the app says of the quantity comes before what is usual
        if any(one["as"] == HANDLING for one in said):
            return Meaning(kind="handling")
        number = next((one for one in said if one["as"] in (HEAT, VALUES)), None)
        finds = next((one for one in said if one["as"] == FINDINGS), None)
        return Meaning(
            kind=_kind(action),
            layers=tuple(_id(one) for one in said),
            quantity=self._quantity(number, quantity) if number is not None else None,
            unit=self._unit(number, quantity) if number is not None else None,
            type=_type(number) if number is not None else None,
            finds=None if finds is None else finds.get("label") or in_words(action),
        )

    def _layer(self, one: Said) -> Layer:
        number = one["as"] in (HEAT, VALUES)
        quantity = self._quantity(one, None) if number else None
        return {
            "id": _id(one),
            "action": one["action"],
            "kind": one["as"],
            "title": one.get("label"),
            "quantity": quantity,
            "unit": self._unit(one, quantity) if number else None,
            "low": one.get("low"),
            "high": one.get("high"),
            "reach": one.get("reach", REACH) if one["as"] == HEAT else None,
        }

    def _quantity(self, one: Said, measured: object) -> str | None:
        if one["action"] == MEASURE:
            return str(one["quantity"]) if "quantity" in one else _text(measured)
        return str(one.get("quantity") or in_words(one["action"]))

    def _unit(self, one: Said, measured: object) -> str | None:
        kind = _type(one)
        if "unit" in one:
            return str(one["unit"])
        if kind is not None:
            return si_unit(kind)
        quantity = one.get("quantity", measured)
        return self._units.get(str(quantity)) if one["action"] == MEASURE else None


def _kind(action: str) -> Kind:
    return "measurement" if action == MEASURE else "photo" if action == PHOTO else "result"


def _id(one: Said) -> str:
    """Return the id of a layer: `measure:pm10`, `measure` for all other quantities, `take_photo:photos`."""
    if one["action"] == MEASURE:
        return f"{MEASURE}:{one['quantity']}" if "quantity" in one else MEASURE
    return f"{one['action']}:{one['as']}"


def _type(one: Said) -> Type | None:
    return Type(one["type"]) if "type" in one else None


def _text(value: object) -> str | None:
    return None if value is None else str(value)


def in_words(action: str) -> str:
    """Return an action's name as people read it."""
    return action.replace("_", " ")


def si_unit(kind: Type) -> str:
    """Return the unit in which a quantity is shown where nothing says another one."""
    si = (unit for unit in units_of(kind) if UNITS[unit][1:] == (1.0, 0.0))
    return next(si, units_of(kind)[0])
