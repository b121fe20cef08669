"""Declarations, as they are written: added, taken out, moved, and given values."""

from __future__ import annotations

from itertools import chain

from plutoc.block import Block, EventParam, HookKind, HookParam, Param
from plutoc.diagnostic import Fix
from plutoc.graph.built_in import EVENTS
from plutoc.graph.names import in_snake_case, reserved
from plutoc.graph.values import EXAMPLES
from plutoc.registry import STD, RegistryError, blocks
from plutoc.service.editing.draft import Draft
from plutoc.service.editing.flows import CannotEdit
from plutoc.source import Source, Span
from plutoc.syntax.fragment import tokens_of
from plutoc.syntax.parse import read
from plutoc.syntax.texts import quoted
from plutoc.syntax.tokens import span
from plutoc.syntax.tree import (
    ActionDecl,
    BadStatement,
    BlockDecl,
    CategoryDecl,
    EventDecl,
    FieldsDecl,
    File,
    FlowDecl,
    HookDecl,
    RequiresDecl,
    ResultDecl,
    Statement,
    VersionDecl,
)

Declaration = CategoryDecl | EventDecl | ActionDecl | HookDecl | BlockDecl
_ORDER = (
    *(VersionDecl, RequiresDecl, FieldsDecl),
    *(CategoryDecl, EventDecl, ActionDecl, ResultDecl, HookDecl, BlockDecl, FlowDecl),
)
"""Which statements stand before which, where an app is written as ours are."""
_BESIDE = ({VersionDecl, RequiresDecl}, {EventDecl, ActionDecl, HookDecl})
"""Between these stands no blank line."""


def declarations(file: File) -> list[Declaration]:
    """Return what an app declares."""
    return [each for each in file.app.statements if isinstance(each, Declaration)]


def declared(file: File, name: str) -> Declaration:
    """Return the declaration of a name; raise `CannotEdit` where there is none."""
    for each in declarations(file):
        if each.name.text == name:
            return each
    raise CannotEdit(f"the app declares no `{name}`")


def is_event(file: File, name: str) -> bool:
    """Return whether an arrow that begins with this name begins at an event."""
    found = {each.name.text: each for each in reversed(declarations(file))}
    return isinstance(found[name], EventDecl) if name in found else name in EVENTS


def taken(file: File) -> set[str]:
    """Return the names that are taken, in small letters: no two differ only in case."""
    names = {each.name.text for each in declarations(file)}
    names |= {
        bad.name.text for bad in file.app.statements if isinstance(bad, BadStatement) and bad.name
    }
    names |= {(use.alias or use.package).text for use in file.uses}
    return {name.lower() for name in names}


def free_name(wanted: str, used: set[str]) -> str:
    """Return a name like the one wanted that is free, and take it."""
    number, name = 2, wanted
    while name.lower() in used or reserved(name):
        name, number = f"{wanted}_{number}", number + 1
    used.add(name.lower())
    return name


def statements_in(text: str) -> tuple[Source, tuple[Statement, ...]]:
    """Read statements of an app; raise `CannotEdit` with what is wrong with them."""
    source = Source("", f"pluto 1\napp pasted {{\n{one_ending(text)}\n}}\n")
    file, found = read(source)
    if found or file.bad:
        why = found[0].message if found else "it cannot be read"
        raise CannotEdit(f"this is no Pluto text: {why}")
    return source, file.app.statements


def one_ending(text: str) -> str:
    """Return a text, its lines ended as an edit writes them."""
    return text.replace("\r\n", "\n")


def added(draft: Draft, text: str, kind: type) -> Draft:
    """Put a declaration below the last one of its sort, or where such ones stand."""
    statements = draft.file.app.statements
    before = [one for one in statements if _rank(one) <= _ORDER.index(kind)]
    if not before:
        return _first(draft, text)
    last = max(before, key=lambda one: (_rank(one), one.span.start))
    beside = type(last) is kind or any({type(last), kind} <= pair for pair in _BESIDE)
    blank = "" if beside else "\n"
    return draft.changed(draft.behind(last.span.end, f"{blank}{draft.indent(last)}{text}"))


def _first(draft: Draft, text: str) -> Draft:
    app = draft.file.app
    if not app.name.text:
        raise CannotEdit("the line that begins the app cannot be read: mend it first")
    head = app.title.span.end if app.title else app.name.span.end
    line = draft.source.text[head : draft.line_end(head)].partition("#")[0]
    brace = head + line.find("{")
    if brace < head:
        raise CannotEdit("the line that begins the app has no `{`: mend it first")
    statements = app.statements
    indent = draft.indent(statements[0]) if statements else "  "
    blank = "\n" if statements else ""
    return draft.changed(draft.behind(brace + 1, f"{indent}{text}{blank}"))


def _rank(statement: Statement) -> int:
    if isinstance(statement, BadStatement):
        return len(_ORDER)
    return _ORDER.index(type(statement))


def without(draft: Draft, name: str) -> Draft:
    """Take a declaration out; its comments stay."""
    return draft.changed(draft.without(declared(draft.file, name)))


def rewritten(draft: Draft, name: str, text: str) -> Draft:
    """Put another text in the place of a declaration."""
    old = declared(draft.file, name)
    source, statements = statements_in(text)
    if len(statements) != 1 or not isinstance(statements[0], type(old)):
        raise CannotEdit(f"in the place of `{name}` stands one declaration of the same sort")
    new = statements[0]
    assert isinstance(new, Declaration)
    if new.name.text != name:
        raise CannotEdit(
            f"this declares `{new.name.text}`: to rename `{name}` everywhere, rename it"
        )
    written = source.quote(new.span)
    kept = Draft.of(source).comments(new.span)
    lost = [comment for comment in draft.comments(old.span) if comment not in kept]
    return draft.changed(draft.written(old, written, lost))


def with_argument(draft: Draft, owner: str, parameter: str, value: str | None) -> Draft:
    """Give a parameter a value, or take it out."""
    one = declared(draft.file, owner)
    if not isinstance(one, BlockDecl | CategoryDecl):
        raise CannotEdit(f"`{owner}` is declared by a text of its own: rewrite that")
    if value is not None:
        value = _plain_value(parameter, value)
    given = next((each for each in one.arguments if each.name.text == parameter), None)
    if value is None:
        return _without_argument(draft, one, parameter) if given else draft
    if given:
        return draft.changed(Fix(span=given.value.span, text=value))
    if one.arguments:
        end = one.arguments[-1].span.end
        return draft.changed(Fix(span=Span(end, end), text=f", {parameter}: {value}"))
    end = one.kind.span.end if isinstance(one, BlockDecl) else one.name.span.end
    opening = draft.source.text[end : one.span.end].lstrip()[:1] == "("
    if opening:
        at = draft.source.text.index("(", end) + 1
        return draft.changed(Fix(span=Span(at, at), text=f"{parameter}: {value}"))
    return draft.changed(Fix(span=Span(end, end), text=f"({parameter}: {value})"))


def _plain_value(parameter: str, value: str) -> str:
    """Return a value without blanks around it; raise `CannotEdit` for what is more, as a comment."""
    source, statements = statements_in(f"a = B({parameter}: {value})")
    block = statements[0] if len(statements) == 1 else None
    given = block.arguments if isinstance(block, BlockDecl) else ()
    plain = one_ending(value).strip()
    if [source.quote(one.value.span) for one in given] != [plain]:
        raise CannotEdit(f"`{value}` is no value")
    return plain


def _without_argument(draft: Draft, one: BlockDecl | CategoryDecl, parameter: str) -> Draft:
    """Take an argument out with the comma that belongs to it; comments come above the statement."""
    names = [each.name.text for each in one.arguments]
    i = names.index(parameter)
    if i > 0:
        span = Span(one.arguments[i - 1].span.end, one.arguments[i].span.end)
    elif len(names) > 1:
        span = Span(one.arguments[0].span.start, one.arguments[1].span.start)
    else:
        start = one.kind.span.end if isinstance(one, BlockDecl) else one.name.span.end
        text = draft.source.text
        end = one.span.end if isinstance(one, BlockDecl) else _closing(draft, one)
        span = Span(start, max(end, text.index("(", start) + 1))
    rest = draft.text(Span(one.span.start, span.start)) + draft.text(Span(span.end, one.span.end))
    return draft.changed(draft.written(one, rest, draft.comments(span)))


def _closing(draft: Draft, one: CategoryDecl) -> int:
    """Return where a category's parentheses end: before `can`."""
    behind = one.arguments[-1].span.end
    return behind + draft.source.text[behind : one.can[0].span.start].rindex(")") + 1


def with_title(draft: Draft, title: str) -> Draft:
    """Give the app a title, or none."""
    app = draft.file.app
    if not app.name.text:
        raise CannotEdit("the line that begins the app cannot be read: mend it first")
    if any(not char.isprintable() for char in title):
        raise CannotEdit("a title is one line, of signs that a screen shows")
    end = app.title.span.end if app.title else app.name.span.end
    text = f" {quoted(title)}" if title else ""
    return draft.changed(Fix(span=Span(app.name.span.end, end), text=text))


def moved(draft: Draft, name: str, before: str) -> Draft:
    """Move a declaration's lines, with the comments right above it."""
    one = declared(draft.file, name)
    lines = _lines(draft, one)
    if before == name:
        return draft
    if before:
        at = _lines(draft, declared(draft.file, before)).start
    else:
        at = _lines(draft, declarations(draft.file)[-1]).end
    if lines.start <= at <= lines.end:
        return draft
    text = draft.text(lines).removesuffix("\n")
    begins = draft.source.text[:at].endswith("\n")  # else it is the end of an app without its brace
    return draft.changed(
        Fix(span=lines, text=""),
        Fix(span=Span(at, at), text=f"{text}\n" if begins else f"\n{text}"),
    )


def _lines(draft: Draft, one: Declaration) -> Span:
    """Return the whole lines of a declaration, and of the comments right above it."""
    text = draft.source.text
    start = text.rfind("\n", 0, one.span.start) + 1
    end = text.find("\n", one.span.end)
    end = len(text) if end < 0 else end + 1
    tail = text[one.span.end : end].strip()
    if text[start : one.span.start].strip() or (tail and not tail.startswith("#")):
        raise CannotEdit(f"`{one.name.text}` shares its line with something else")
    while start:
        above = text.rfind("\n", 0, start - 1) + 1
        if not text[above:start].lstrip().startswith("#"):
            break
        start = above
    return Span(start, end)


def new_block(draft: Draft, kind: str, name: str, arguments: dict[str, str]) -> tuple[Draft, str]:
    """Declare a block, with what it cannot do without; return its name."""
    draft, block = _kind(draft, kind)
    used = taken(draft.file)
    if name and name.lower() in used:
        raise CannotEdit(f"`{name}` is declared already")
    whole = in_snake_case(block.name)
    short = whole.rsplit("_", 1)[-1]
    wanted = whole if short in used or reserved(short) else short
    called = name or free_name(wanted, used)
    given = dict(arguments)
    for param in block.params:
        if param.name in given:
            continue
        if isinstance(param, HookParam) and param.required:
            draft, given[param.name] = _hook(draft, param.kind, called)
        elif isinstance(param, Param) and param.required:
            given[param.name] = EXAMPLES[param.type]
        elif isinstance(param, EventParam):
            own = (one.name.text for one in declarations(draft.file) if isinstance(one, EventDecl))
            given[param.name] = next(chain(own, EVENTS))
    values = ", ".join(f"{parameter}: {value}" for parameter, value in given.items())
    text = f"{called} = {kind}({values})" if values else f"{called} = {kind}"
    _one_block(text)
    return added(draft, text, BlockDecl), called


def _one_block(text: str) -> None:
    _, statements = statements_in(text)
    if len(statements) != 1 or not isinstance(statements[0], BlockDecl):
        raise CannotEdit(f"`{text}` declares no block")


def _kind(draft: Draft, kind: str) -> tuple[Draft, Block]:
    """Return a kind's declaration, its package used by the app."""
    prefix, _, name = kind.rpartition(".")
    used = {(use.alias or use.package).text: use.package.text for use in draft.file.uses}
    package = used.get(prefix, prefix) if prefix else STD
    try:
        known = blocks().of(package)
    except RegistryError as error:
        raise CannotEdit(str(error)) from None
    if name not in known:
        raise CannotEdit(f"there is no kind of block `{kind}`")
    if prefix and prefix not in used:
        uses = draft.file.uses
        head = uses[-1].span.end if uses else _header_end(draft)
        draft = draft.changed(draft.behind(head, f"use {prefix}"))
    return draft, known[name]


def _header_end(draft: Draft) -> int:
    """Return where the line `pluto 1` ends: comments may stand above it."""
    first = next(iter(tokens_of(draft.source.text)), None)
    if first is None or first.type != "PLUTO":
        raise CannotEdit("the app does not begin with `pluto 1`: mend it first")
    return draft.line_end(span(first).end)


def _hook(draft: Draft, kind: HookKind, block: str) -> tuple[Draft, str]:
    """Return the app's first hook of a sort; declare one where there is none."""
    for each in declarations(draft.file):
        if isinstance(each, HookDecl) and each.kind == kind.value:
            return draft, each.name.text
        if isinstance(each, ActionDecl) and kind is HookKind.ACTION:
            return draft, each.name.text
    used = taken(draft.file) | {block.lower()}
    name = free_name(f"my_{kind.value}", used)
    sort = ActionDecl if kind is HookKind.ACTION else HookDecl
    return added(draft, f"{kind.value} {name}", sort), name
