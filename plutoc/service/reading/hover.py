"""What is to be known about a place of an app."""

from __future__ import annotations

from plutoc.block import Choice
from plutoc.emit.stubs import stubs
from plutoc.graph.built_in import ACTIONS
from plutoc.graph.categories import PARAMS
from plutoc.graph.hooks import LAST_WORDS
from plutoc.graph.model import END, START, Edge
from plutoc.graph.results import SAID, WAYS
from plutoc.service.answers import Hover
from plutoc.service.document import Document
from plutoc.service.known import Known
from plutoc.service.reading import describe
from plutoc.service.reading.arrows import Arrow, arriving, arrows, carried, leaving, why_not
from plutoc.service.symbols import HOOKS, Occurrence, Role, at
from plutoc.source import Span
from plutoc.syntax.fragment import word_at
from plutoc.syntax.tree import BlockDecl
from plutoc_runtime.domain.quantities import UNITS, Type, to_si, units_of
from plutoc_runtime.domain.status import Status


def hover(document: Document, offset: int) -> Hover | None:
    """Return what is to be known about a place of the app's text."""
    found = at(document.names, offset)
    if found is not None:
        said = _of_name(document, found)
        return Hover(markdown=said, span=found.span) if said else None
    for arrow in arrows(document):
        if arrow.span.start <= offset <= arrow.span.end:
            return Hover(markdown=_of_arrow(document, arrow), span=_sign(document, arrow))
    return _of_word(document, offset)


def _of_name(document: Document, one: Occurrence) -> str:
    known = _known(document)
    match one.role:
        case Role.APP:
            title = document.graph.title
            return f"**{title}**\n\nThe app, and its package: `{one.name}`."
        case Role.PREFIX:
            package = known.prefixes.get(one.name, one.name)
            kinds = ", ".join(
                f"`{kind}`" for kind in known.kinds if kind.startswith(f"{one.name}.")
            )
            return describe.paragraphs((f"The installed package of blocks `{package}`.", kinds))
        case Role.CATEGORY:
            found = next((c for c in document.graph.categories if c.name == one.name), None)
            return describe.of_category(found) if found else ""
        case Role.KIND:
            return _of_kind(document, known, one)
        case Role.BLOCK:
            return of_block(document, one.name)
        case Role.EVENT:
            return _of_event(document, one.name)
        case Role.PARAMETER:
            return _of_parameter(document, known, one)
        case Role.TYPE:
            kind = next((kind for kind in Type if kind.value == one.name), None)
            return describe.of_type(kind) if kind else describe.of_photo(one.name)
        case Role.FIELD:
            own = document.graph.fields
            field = next((f for f in own if (f.on.value, f.name) == (one.owner, one.name)), None)
            return describe.of_field(field) if field else ""
        case Role.STATUS:
            return _of_status(document, one)
        case Role.TERMINAL:
            return _of_terminal(document, one.name)
        case Role.WAY:
            said = SAID.get(one.name)
            return f"`{one.name}`: {said}" if said else ""
        case Role.OPTION:
            return _of_option(document, known, one)
        case _ if one.role in HOOKS:
            return of_hook(document, one.name)
    return ""


def _known(document: Document) -> Known:
    return Known(
        file=document.file,
        graph=document.graph,
        names=document.names,
        installed=document.installed,
    )


def of_block(document: Document, name: str) -> str:
    """Describe a block: its declaration, what passes through it, its kind."""
    node = document.graph.node.get(name)
    if node is None:
        return ""
    passing = arriving(document, name), leaving(document, name)
    return describe.of_block(node, *passing)


def of_hook(document: Document, name: str) -> str:
    """Describe a hook, or an action: its declaration, and the function that it is in hooks.py."""
    hook = _known(document).hook.get(name)
    if hook is None:
        return describe.of_action(name) if name in ACTIONS else ""
    signature = ""
    if document.checked is not None:
        stub = next(one for one in stubs(document.checked) if one.name == name)
        signature = f"{stub.coroutine}def {stub.name}{stub.signature}: ..."
    return describe.of_hook(describe.hook_declaration(hook), signature)


def _of_kind(document: Document, known: Known, one: Occurrence) -> str:
    for statement in document.file.app.statements:
        if isinstance(statement, BlockDecl) and statement.kind.span == one.span:
            block = known.kind_of(statement)
            prefix = f"{statement.prefix.text}." if statement.prefix else ""
            return describe.of_kind(prefix + one.name, block) if block else ""
    return ""


def _of_parameter(document: Document, known: Known, one: Occurrence) -> str:
    if one.owner == Role.CATEGORY.value:
        of_category = next((param for param in PARAMS if param.name == one.name), None)
        return describe.of_param(of_category) if of_category else ""
    of_way = next((param for param in WAYS.get(one.owner, ()) if param.name == one.name), None)
    if of_way is not None:
        return describe.of_param(of_way)
    event = next((each for each in document.graph.events if each.name == one.owner), None)
    if event is not None:
        field = next((each for each in event.fields if each.name == one.name), None)
        return describe.of_parameter(field, one.owner) if field else ""
    hook = known.hook.get(one.owner)
    if hook is not None:
        own = next((each for each in hook.parameters if each.name == one.name), None)
        return describe.of_parameter(own, one.owner) if own else ""
    block = known.kinds.get(one.owner)
    param = block.param(one.name) if block else None
    return describe.of_any_param(param) if param else ""


def _of_option(document: Document, known: Known, one: Occurrence) -> str:
    if one.name in LAST_WORDS:
        return f"`{one.name}`: {describe.KEYWORDS[one.name]}"
    for block in document.file.app.statements:
        for argument in block.arguments if isinstance(block, BlockDecl) else ():
            if argument.value.span == one.span and isinstance(block, BlockDecl):
                kind = known.kind_of(block)
                param = kind.param(argument.name.text) if kind else None
                if isinstance(param, Choice) and one.name in param.options:
                    return f"`{one.name}`, one of these: {describe.of_any_param(param)}"
    return ""


def _of_status(document: Document, one: Occurrence) -> str:
    """Describe a status; in a guard, also whether it passes there."""
    status = Status.__members__.get(one.name)
    if status is None:
        return ""
    parts = [describe.of_status(status)]
    for edge in document.graph.edges:
        guard = edge.guard_span
        if guard and guard.start <= one.span.start < guard.end:
            reason = dict(why_not(document, edge)).get(status)
            arrow = f"`{edge.source} -> {edge.target}`"
            said = f"cannot pass: {reason}" if reason else "passes"
            parts.append(f"Along {arrow} it {said}.")
    return describe.paragraphs(parts)


def _of_terminal(document: Document, name: str) -> str:
    said = f"`{name}`: {describe.KEYWORDS[name]}"
    if name == END:
        passing = describe.listed(arriving(document, END))
        return describe.paragraphs((said, f"Missions end with {passing}."))
    targets = [edge.target for edge in document.graph.outgoing[START]]
    return describe.paragraphs((said, f"It leads to `{targets[0]}`." if targets else ""))


def _of_event(document: Document, name: str) -> str:
    graph = document.graph
    event = next((each for each in graph.events if each.name == name), None)
    return describe.of_event(name, event, (edge.target for edge in graph.outgoing.get(name, ())))


def _of_arrow(document: Document, arrow: Arrow) -> str:
    parts = [of_edge(document, edge) for edge in arrow.edges]
    whole = "" if len(parts) == 1 else f"All together: {describe.listed(carried(document, arrow))}."
    return describe.paragraphs((*parts, whole))


def of_edge(document: Document, edge: Edge) -> str:
    """Describe an edge: the statuses that pass along it, and why others do not."""
    passing = describe.listed(document.carries.get(edge, ()))
    reasons = [f"- `{status.value}` cannot pass: {why}." for status, why in why_not(document, edge)]
    return describe.paragraphs(
        (f"**{edge.source} → {edge.target}** carries {passing}.", "\n".join(reasons))
    )


def _sign(document: Document, arrow: Arrow) -> Span:
    at = document.text.find("->", arrow.span.start, arrow.span.end)
    return Span(at, at + 2) if at >= 0 else arrow.span


def _of_word(document: Document, offset: int) -> Hover | None:
    """Describe a word of the language, or a quantity."""
    word = word_at(document.text, offset)
    if word is None:
        return None
    text, span, kind = word
    if kind == "QUANTITY":
        unit = text.lstrip("-0123456789.").strip()
        said = _of_quantity(text, unit) if unit in UNITS else ""
    else:
        said = f"`{text}`: {describe.KEYWORDS[text]}" if text in describe.KEYWORDS else ""
    return Hover(markdown=said, span=span) if said else None


def _of_quantity(text: str, unit: str) -> str:
    kind = UNITS[unit][0]
    number = float(text[: len(text) - len(unit)].strip())
    plain = describe.in_si(to_si(number, unit), kind)
    return f"`{text}`: a {kind.value}, {plain} in hooks.\n\nUnits: {', '.join(units_of(kind))}."
