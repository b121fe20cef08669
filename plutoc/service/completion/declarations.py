"""What may stand in a declaration: names, kinds, actions, types, and the words between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from plutoc.block import IN_GRAPH, HookParam
from plutoc.graph.built_in import ACTIONS
from plutoc.graph.hooks import LAST_WORDS, PHOTO
from plutoc.graph.model import Action
from plutoc.graph.results import HANDLING, HEAT, SAID, VALUES, ways_of
from plutoc.report.block_page import first_line
from plutoc.service.answers import Sort
from plutoc.service.completion.arguments import required, units, values_of
from plutoc.service.completion.candidate import Candidate
from plutoc.service.completion.hole import Hole
from plutoc.service.known import Known
from plutoc.service.reading import describe
from plutoc.service.symbols import Role
from plutoc.syntax.tokens import ARROW, EQUAL, NAME
from plutoc.syntax.tree import BlockDecl
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.quantities import Type

_NEW = {
    "category": ("drone", "scout", "carrier"),
    "action": ("my_action",),
    "evaluator": ("judge_mission",),
    "modifier": ("change_mission",),
    "policy": ("choose_drone",),
    "event": ("sighting",),
    "creator": ("make_mission",),
}
"""Names for what is new, where nothing says which is wanted."""

_TYPICAL = {
    Type.TIME: "limit",
    Type.LENGTH: "distance",
    Type.MASS: "dose",
    Type.SPEED: "pace",
    Type.PERCENT: "share",
    Type.INT: "count",
    Type.TEXT: "note",
}
"""Names of parameters, likewise."""

_SEVERAL = 1_000
"""Most kinds stand in an app once: what it has already comes later."""

_OFTEN = (Type.TIME, Type.MASS, Type.LENGTH, Type.TEXT, Type.FLOAT, Type.INT, Type.BOOL)


def kinds(known: Known, prefix: str = "") -> Iterator[Candidate]:
    """Give the kinds of blocks, with what each of them must be given; of one package, or all."""
    there = [node.block for node in known.graph.nodes]
    for i, (written, block) in enumerate(known.kinds.items()):
        if not written.startswith(prefix):
            continue
        label = written[len(prefix) :]
        forms = (label, *(label + given for given in required(known, written)))
        new = [f"{label}(hook: {name})\n  {kind} {name}" for kind, name in _lacked(known, written)]
        yield Candidate(
            label=label,
            kind=Sort.KIND,
            forms=(*forms, *new),
            detail=first_line(block),
            doc=describe.of_kind(written, block),
            rank=i + (_SEVERAL if block in there else 0),
            judged=True,
        )


def _lacked(known: Known, written: str) -> Iterator[tuple[str, str]]:
    """Give the hook that a kind needs where the app declares none of that sort."""
    needed = [p for p in known.kinds[written].params if isinstance(p, HookParam) and p.required]
    if len(needed) == 1 and needed[0].name == "hook" and not known.hooks(needed[0].kind):
        kind = needed[0].kind.value
        yield kind, known.fresh(_NEW[kind][0])


def names(role: Role, known: Known) -> Iterator[Candidate]:
    """Give names for what is declared: those that are used already, or else new ones."""
    sort = {Role.BLOCK: Sort.BLOCK, Role.CATEGORY: Sort.CATEGORY}.get(role, Sort.HOOK)
    lacking = known.lacking.get(role, ())
    if role is Role.EVENT:  # what an arrow begins at may be an event as well as a block
        lacking += known.lacking.get(Role.BLOCK, ())
    for i, name in enumerate(lacking or map(known.fresh, _NEW.get(role.value, ()))):
        detail = "used, and not declared yet" if lacking else "a free name"
        forms = (name, f"{name} can {', '.join(known.usual)}") if role is Role.CATEGORY else ()
        yield Candidate(
            label=name, kind=sort, forms=forms, detail=detail, rank=i, judged=bool(lacking)
        )


def category(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand in a category outside of its parentheses."""
    if "CAN" in hole.types:
        if hole.types[-1] in ("CAN", "COMMA"):
            yield from _actions(hole, known)
    elif hole.types == ("CATEGORY",):
        yield from names(Role.CATEGORY, known)
    else:
        forms = ("can", f"can {', '.join(known.usual)}")
        yield keyword("can", *forms)


def _actions(hole: Hole, known: Known) -> Iterator[Candidate]:
    given = {str(token) for token in (*hole.before, *hole.behind)}
    for i, name in enumerate(known.actions):
        if name in given:
            continue
        own = known.hook.get(name)
        doc = describe.code(describe.hook_declaration(own)) if own else describe.of_action(name)
        lacked = name in known.unused
        yield Candidate(
            label=name, kind=Sort.HOOK, doc=doc, detail="action", rank=i - (20 if lacked else 0)
        )


def hook(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand in the declaration of an action or a hook."""
    word, last = hole.types[0], hole.types[-1]
    if len(hole.types) == 1:
        yield from names(Role(word.lower()), known)
    elif hole.opened:
        yield from _parameters(hole, known)
    elif word == "ACTION":
        if last == ARROW:
            yield from _results()
        elif last == "TAKES":
            yield from _durations(hole)
        elif last in (NAME, "RPAR", "QUANTITY"):
            if ARROW not in hole.types:
                yield Candidate(label="->", kind=Sort.KEYWORD, forms=("-> float",), doc=_GIVES)
            for repeat in LAST_WORDS:
                yield keyword(repeat)
            if "TAKES" not in hole.types:
                yield keyword("takes", "takes", "takes 5 s")
    elif word == "MODIFIER":
        lists = [each for each in hole.types if each in ("EMITS", "WRITES")]
        if lists and last in (*lists, "COMMA"):
            yield from _statuses(hole) if lists[-1] == "EMITS" else _attributes(hole, known)
        else:
            if not lists:
                yield keyword("emits", "emits", "emits STANDBY, COMPLETED, FAILED")
            if "WRITES" not in lists:
                yield keyword("writes", "writes", "writes trips")


def _durations(hole: Hole) -> Iterator[Candidate]:
    """Give how long an action can be said to take: one of its parameters that is a time, or a time."""
    if hole.of_number:
        yield from units(hole, Type.TIME)
        return
    for name, colon, kind in zip(hole.before, hole.before[1:], hole.before[2:], strict=False):
        if colon.type == "COLON" and kind == Type.TIME.value:
            yield Candidate(label=str(name), kind=Sort.PARAMETER, detail=Type.TIME.value, rank=-1)
    yield Candidate(label="30 s", kind=Sort.VALUE, doc=describe.of_type(Type.TIME))


def _statuses(hole: Hole) -> Iterator[Candidate]:
    given = {str(token) for token in (*hole.before, *hole.behind)}
    for status in IN_GRAPH:
        if status.value not in given:
            yield Candidate(
                label=status.value,
                kind=Sort.STATUS,
                doc=describe.of_status(status),
                judged=True,
                rank=-IN_GRAPH.index(status),
            )


def _attributes(hole: Hole, known: Known) -> Iterator[Candidate]:
    given = {str(token) for token in (*hole.before, *hole.behind)}
    own = [need.name for node in known.graph.nodes for need in node.block.needs]
    own += [field.name for field in known.graph.fields if field.on is Entity.MISSION]
    for name in dict.fromkeys(("trips", "reason", *own)):
        if name not in given:
            yield Candidate(label=name, kind=Sort.ATTRIBUTE, detail="of the mission")


def _parameters(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give names, types and defaults of parameters that are declared."""
    last, name = hole.types[-1], str(hole.before[1])
    if last in ("LPAR", "COMMA"):
        given = {str(token) for token in (*hole.before, *hole.behind)}
        lacking = dict.fromkeys(each for each in _passed_to(name, known) if each not in given)
        free = [(word, kind) for kind, word in _TYPICAL.items() if word not in given]
        for each in lacking:
            forms = (each, *(f"{each}: {kind.value}" for kind in (*_OFTEN, *Type)))
            yield Candidate(label=each, kind=Sort.PARAMETER, forms=forms, detail="given by a block")
        for word, kind in () if lacking else free:
            forms = (word, f"{word}: {kind.value}")
            yield Candidate(label=word, kind=Sort.PARAMETER, forms=forms, detail=kind.value)
    else:
        yield from _typed(hole)


def fields(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand in a statement that declares fields of missions or of trips."""
    last = hole.types[-1]
    if len(hole.types) == 1:
        yield keyword("has", *(f"has {word}: {kind.value}" for kind, word in _TYPICAL.items()))
    elif last in ("HAS", "COMMA"):
        given = {str(token) for token in (*hole.before, *hole.behind)}
        for kind, word in _TYPICAL.items():
            if word not in given:
                forms = (word, f"{word}: {kind.value}")
                yield Candidate(label=word, kind=Sort.PARAMETER, forms=forms, detail=kind.value)
    else:
        yield from _typed(hole)


def result(hole: Hole, known: Known) -> Iterator[Candidate]:
    """Give what may stand in a statement that says what the results of an action are."""
    last, own = hole.types[-1], {action.name: action for action in known.graph.actions}
    if last == "RESULT":
        for name in known.actions:
            forms = (name, f"{name} as {next(iter(_ways(name, own)))}")
            yield Candidate(label=name, kind=Sort.HOOK, forms=forms, detail="action")
    elif last == NAME and len(hole.types) == 2:
        yield keyword("as", *(f"as {way}" for way in _ways(str(hole.before[1]), own)))
    elif last == "AS":
        for way in _ways(str(hole.before[1]), own):
            yield Candidate(label=way, kind=Sort.VALUE, forms=_forms(way), doc=SAID[way])


def _ways(name: str, own: Mapping[str, Action]) -> tuple[str, ...]:
    """Return the ways in which an action's results can be shown, the likeliest first."""
    known = name in own or name in ACTIONS
    return (*(ways_of(name, own.get(name)) if known else ()), HANDLING)


def _forms(way: str) -> tuple[str, ...]:
    return (way, f'{way}(quantity: "temperature")') if way in (HEAT, VALUES) else (way,)


_GIVES = "What the action gives to the result store: its type stands behind the arrow."


def _results() -> Iterator[Candidate]:
    """Give the types of what an action can give."""
    for kind in dict.fromkeys((Type.FLOAT, *_OFTEN, *Type)):
        yield Candidate(label=kind.value, kind=Sort.TYPE, doc=describe.of_type(kind))
    yield Candidate(label=PHOTO, kind=Sort.TYPE, doc=describe.of_photo(PHOTO))


def _typed(hole: Hole) -> Iterator[Candidate]:
    """Give the type, or the default, of a parameter or a field."""
    last = hole.types[-1]
    if last == "COLON":
        for kind in dict.fromkeys((*_OFTEN, *Type)):
            yield Candidate(label=kind.value, kind=Sort.TYPE, doc=describe.of_type(kind))
    elif last == EQUAL:
        wanted = next((kind for kind in Type if kind.value == hole.before[-2]), None)
        if wanted and hole.of_number:
            yield from units(hole, wanted)
        elif wanted:
            for value in values_of(wanted):
                yield Candidate(label=value, kind=Sort.VALUE, doc=describe.of_type(wanted))


def _passed_to(hook: str, known: Known) -> Iterator[str]:
    """Give the arguments that blocks give to a hook, by all that is known."""
    for block in known.file.app.statements:
        if isinstance(block, BlockDecl) and (kind := known.kind_of(block)):
            written = {known.file.source.quote(a.value.span) for a in block.arguments}
            if hook in written:
                names = (a.name.text for a in block.arguments)
                yield from (name for name in names if kind.param(name) is None)


def keyword(word: str, *forms: str, rank: int = 0) -> Candidate:
    """Return a word of the language, with how a whole statement of it may be written."""
    return Candidate(
        label=word, kind=Sort.KEYWORD, forms=forms, doc=describe.KEYWORDS[word], rank=rank
    )
