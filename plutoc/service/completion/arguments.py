"""What may be given to a block or a category: parameters, values, units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lark import Token

from plutoc.block import AnyParam, Choice, EventParam, HookParam, Param
from plutoc.graph.categories import PARAMS
from plutoc.graph.results import WAYS
from plutoc.graph.values import EXAMPLES
from plutoc.service.answers import Sort
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.hole import Hole
from plutoc.service.known import Known, hook_of
from plutoc.service.reading import describe
from plutoc.syntax.tokens import NAME
from plutoc_runtime.domain.quantities import Type, units_of

_UNUSED, _REQUIRED = -20, -30


@dataclass(frozen=True, slots=True, kw_only=True)
class _Offer:
    """A parameter that can be given, with values that are right for it."""

    name: str
    values: tuple[str, ...]
    doc: str
    type: Type | None = None
    required: bool = False


def arguments(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand between the parentheses behind a kind, a category's name, or a way to show results."""
    offers = list(_offers(hole, known))
    last = hole.types[-1]
    if last in ("LPAR", "COMMA"):
        given = {name for name, _ in _given((*hole.before, *hole.behind))}
        for i, offer in enumerate(each for each in offers if each.name not in given):
            yield Candidate(
                label=offer.name,
                kind=Sort.PARAMETER,
                forms=(offer.name, *(f"{offer.name}: {value}" for value in offer.values)),
                detail=offer.type.value if offer.type else "",
                doc=offer.doc,
                rank=i + (_REQUIRED if offer.required else 0),
            )
    elif last == "COLON":
        name = str(hole.before[-2])
        yield from _values(hole, known, next((o for o in offers if o.name == name), None))


def _values(hole: Hole, known: Known, offer: _Offer | None) -> Iterator[Candidate]:
    if offer is None:
        return
    if hole.of_number:
        yield from units(hole, offer.type)
        return
    for i, value in enumerate(offer.values):
        hook = known.hook.get(value) if offer.type is None else None
        yield Candidate(
            label=value,
            kind=Sort.HOOK if hook else Sort.VALUE,
            detail=hook.kind.value if hook and hasattr(hook, "kind") else "",
            doc=describe.code(describe.hook_declaration(hook)) if hook else offer.doc,
            rank=i + (_UNUSED if value in known.unused else 0),
        )


def units(hole: Hole, kind: Type | None) -> Iterator[Candidate]:
    """Give the units of a number."""
    apart = "" if hole.of_number.endswith((" ", "\t")) else " "
    for unit in units_of(kind) if kind else ():
        yield Candidate(
            label=unit, kind=Sort.UNIT, forms=(apart + unit,), doc=describe.of_unit(unit)
        )


def values_of(kind: Type, default: object = None) -> tuple[str, ...]:
    """Return values of a type, as they are written."""
    found = []
    if isinstance(default, bool | int | float | str):
        found.append(describe.in_units(default, kind))
    if kind is Type.BOOL:
        found += ["yes", "no"]
    return tuple(dict.fromkeys((*found, EXAMPLES[kind])))


def written_kind(before: Sequence[Token]) -> str:
    """Return the kind in a block's declaration, as written: `survey.GridScan`."""
    end = next((i for i, token in enumerate(before) if token.type == "LPAR"), len(before))
    return "".join(before[2:end])


def required(known: Known, kind: str) -> Iterator[str]:
    """Give the ways to write what a block of a kind must be given: `(hook: find_blooms)`."""
    params = [_of_param(known, param) for param in known.kinds[kind].params]
    needed = [offer for offer in params if offer.required]
    if not needed:
        yield ""
        return
    for i in range(max(len(offer.values) for offer in needed)):
        given = [(o.name, o.values[min(i, len(o.values) - 1)]) for o in needed if o.values]
        passed = known.passed_by([value for _, value in given])
        given += [(p.name, values_of(p.type)[0]) for _, p in passed if p.default is None]
        yield f"({', '.join(f'{name}: {value}' for name, value in given)})"


def _offers(hole: Hole, known: Known) -> Iterator[_Offer]:
    if hole.types[0] == "CATEGORY":
        yield from (_of_param(known, param) for param in PARAMS)
        return
    if hole.types[0] == "RESULT":
        yield from (_of_param(known, param) for param in WAYS.get(str(hole.before[3]), ()))
        return
    block = known.kinds.get(written_kind(hole.before))
    if block is None:
        return
    yield from (_of_param(known, param) for param in block.params)
    values = [value for _, value in _given((*hole.before, *hole.behind))]
    for hook, own in known.passed_by(values):
        yield _Offer(
            name=own.name,
            values=values_of(own.type, own.default),
            doc=describe.of_parameter(own, hook),
            type=own.type,
            required=own.default is None,
        )


def _of_param(known: Known, param: AnyParam) -> _Offer:
    kind = hook_of(param)
    hooks = known.hooks(kind) if kind else ()
    doc = describe.of_any_param(param)
    match param:
        case Param():
            values = values_of(param.type, param.default)
            return _Offer(
                name=param.name, values=values, doc=doc, type=param.type, required=param.required
            )
        case Choice():
            others = [option for option in param.options if option != param.default]
            values = (param.default, *others, *hooks)
            return _Offer(name=param.name, values=values, doc=doc)
        case HookParam():
            return _Offer(name=param.name, values=hooks, doc=doc, required=param.required)
        case EventParam():
            return _Offer(name=param.name, values=known.events, doc=doc, required=param.required)


def _given(tokens: Sequence[Token]) -> list[tuple[str, str]]:
    """Return the arguments that a statement gives, by name."""
    return [
        (str(one), str(tokens[i + 2]) if i + 2 < len(tokens) else "")
        for i, one in enumerate(tokens)
        if one.type == NAME and i + 1 < len(tokens) and tokens[i + 1].type == "COLON"
    ]
