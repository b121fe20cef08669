"""Random sequences of edits of an app, each held against what was meant."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from random import Random

from plutoc.diagnostic import Fix
from plutoc.edits import applied
from plutoc.service.document import Document
from plutoc.service.editing.edit import CannotEdit, Edited, edit
from plutoc.service.editing.operations import (
    AddBlock,
    Arrow,
    Bracket,
    Connect,
    Declare,
    Disconnect,
    Duplicate,
    Move,
    Operation,
    Paste,
    Redirect,
    RemoveBlocks,
    RemoveDeclaration,
    Rename,
    Rewrite,
    SetArgument,
    SetGuard,
    SetTitle,
)
from plutoc.source import Source, Span
from tests.kit.graphs.graph import random_source
from tests.paths import ROOT
from tests.service.model import App, after, app_of, comments

EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))
KINDS = (
    *("MissionCreator", "Clock", "DroneAllocator", "TripLauncher", "TripMonitor", "TimerMonitor"),
    *("GateFIFO", "GateFunnel", "MissionRepeater", "MissionEvaluator", "MissionModifier"),
    *("PriorityManager", "GapMonitor"),
)
STATUSES = ("UNEXECUTED", "RUNNING", "STANDBY", "COMPLETED", "FAILED")
DECLARATIONS = (
    "category {}(payload: 4 g) can measure, take_photo",
    "action {}(dose: mass = 50 mg) once",
    "action {} safe",
    "evaluator {}",
    "modifier {}(limit: time = 3 min) emits STANDBY, FAILED",
    "modifier {} emits FAILED writes f1, f2",
    "policy {}",
    "{} = Clock",
)
FIELDS = (
    "mission has {}: text",
    'mission has {}: text = "a, # b", {}_too: time = 3 min',
    "trip has {}: percent = 20 %, {}_too: bool = no  # fields",
    "trip has {}: mass",
)
FIELD = (
    "{}: text",
    "{}: length = 30 cm",
    "{}: bool = yes",
    '{}: text = "}},"',
    "{}: int, b: int",
    "{}: int  # c",
    "{}",
)
"""Of these, some are no field."""
LENGTH = 12
"""How many edits a sequence has."""


@dataclass(kw_only=True)
class Tally:
    """What was tried."""

    done: Counter[str] = field(default_factory=Counter)
    refused: Counter[str] = field(default_factory=Counter)


def beginning(rng: Random) -> str:
    """Return a text to begin with: an example or a random app, in any dress."""
    if rng.random() < 0.4:
        text = rng.choice(EXAMPLES).read_text(encoding="utf-8")
    else:
        text = random_source(rng)
        while not is_sound(text):
            text = random_source(rng)
    text = _dressed(text, rng)
    if rng.random() < 0.15:
        text = text.replace("\n", "\r\n")
    if rng.random() < 0.1:
        text = "\ufeff" + text
    return text.rstrip("\r\n") if rng.random() < 0.1 else text


def _dressed(text: str, rng: Random) -> str:
    """Put comments, breaks and blank lines where they may stand."""
    lines = []
    for line in text.split("\n"):
        if rng.random() < 0.08 and line.startswith("  "):
            lines.append(f"  # above {rng.randrange(1000)}")
        if rng.random() < 0.1 and " -> " in line and "#" not in line:
            breaks = f"  # amid {rng.randrange(1000)}" if rng.random() < 0.5 else ""
            line = line.replace(" -> ", f"{breaks}\n    -> ", 1)
        if rng.random() < 0.1 and "(" in line and "#" not in line and '"' not in line:
            line = line.replace("(", f"(  # within {rng.randrange(1000)}\n    ", 1)
        if rng.random() < 0.1 and line.startswith("app "):
            line += "\n  " + rng.choice(FIELDS).format("f1", "f1")
        if rng.random() < 0.08 and "#" not in line and line.strip():
            line += f"  # beside {rng.randrange(1000)}"
        lines.append(line)
        if rng.random() < 0.05 and line.startswith("  "):
            lines.append("")
    dressed = "\n".join(lines)
    return dressed if is_sound(dressed) else text


def is_sound(text: str) -> bool:
    """Return whether a text can be read, and has no edge twice."""
    try:
        app_of(text)
    except AssertionError:
        return False
    return True


def run(seed: int, tally: Tally) -> None:
    """Make a sequence of edits, and undo it; an AssertionError tells what is wrong."""
    rng = Random(seed)
    first = beginning(rng)
    texts, undo = [first], []
    for _ in range(LENGTH):
        text = texts[-1]
        app = app_of(text)
        operation = draw(rng, app, text)
        name = type(operation).__name__ + " field" * is_of_field(operation)
        try:
            edited = edit(Document(path="a.pluto", text=text), operation)
        except CannotEdit as why:
            tally.refused[name] += 1
            assert str(why), operation
            continue
        tally.done[name] += 1
        now = applied(Source("a.pluto", text), edited.edits)
        held(text, now, operation, edited)
        undo.append(inverse(text, edited.edits))
        texts.append(now)
    text = texts[-1]
    for back in reversed(undo):
        text = _put(text, back)
    assert text == first, "undone to the start, the bytes are others"


def held(text: str, now: str, operation: Operation, edited: Edited) -> None:
    """Hold an edit against what was meant."""
    before, behind = app_of(text), app_of(now)
    meant = after(before, operation, edited.names, behind)
    assert behind == meant, f"{operation}\n{text}\n=====\n{now}"
    lost = Counter(comments(text)) - Counter(comments(now))
    assert not lost, f"{operation} lost {lost}\n{text}\n=====\n{now}"
    for fix in edited.edits:
        where = foreign(text, fix.span, named(operation, before))
        assert not where, f"{operation} changed {where!r}\n{text}\n=====\n{now}"


def named(operation: Operation, app: App) -> set[str]:
    """Return the names whose statements an operation may change."""
    match operation:
        case RemoveBlocks(names=names) | Duplicate(names=names):
            return set(names)
        case Connect(arrow=arrow) | Disconnect(arrow=arrow) | SetGuard(arrow=arrow):
            return {arrow.source, arrow.target}
        case Redirect(arrow=arrow):
            return {arrow.source, arrow.target}
        case SetArgument(owner=owner):
            return {owner}
        case Rewrite(name=name) | RemoveDeclaration(name=name) | Rename(name=name):
            return {name.rpartition(".")[2]}
        case Move(name=name):
            return {name}
        case Bracket(source=source, targets=targets):
            return {source, *targets}
        case SetTitle():
            return {"app"}
    return set()


def foreign(text: str, span: Span, names: set[str]) -> str:
    """Return what an edit replaces of lines that name none of these; blanks count for nothing."""
    old = text[span.start : span.end]
    bare = re.sub(r"#[^\n]*", "", old)
    if not bare.strip():
        return ""
    start = text.rfind("\n", 0, span.start) + 1
    end = text.find("\n", span.end)
    # a statement that is broken over lines is one: go back to where it begins
    while start and re.match(r"\s*(->|\)|#|\w+\s*:|[\w, ]+\])", text[start:]):
        start = text.rfind("\n", 0, start - 1) + 1
    lines = text[start : len(text) if end < 0 else end]
    return "" if set(re.findall(r"\w+", lines)) & names else old


def inverse(text: str, fixes: tuple[Fix, ...]) -> list[tuple[int, int, str]]:
    """Return what takes edits back, as the history of an editor would keep it."""
    crlf = "\r\n" in text[: text.find("\n") + 1]
    shift, found = 0, []
    for fix in fixes:
        put = fix.text.replace("\n", "\r\n") if crlf else fix.text
        start = fix.span.start + shift
        found.append((start, start + len(put), text[fix.span.start : fix.span.end]))
        shift += len(put) - (fix.span.end - fix.span.start)
    return found


def _put(text: str, changes: list[tuple[int, int, str]]) -> str:
    for start, end, put in reversed(changes):
        text = text[:start] + put + text[end:]
    return text


def is_of_field(operation: Operation) -> bool:
    """Return whether it is about a field of the app's own, for the tally."""
    match operation:
        case Rewrite(name=name) | RemoveDeclaration(name=name) | Rename(name=name):
            return "." in name
        case Declare(text=text) | Paste(text=text):
            return text.startswith(("mission has", "trip has"))
    return False


def draw_of_fields(rng: Random, app: App) -> Operation:
    """Draw an operation of the app's own fields; some of them cannot be done."""
    there = [name for name, _ in app.fields]
    on = rng.choice(("mission", "trip"))
    name = rng.choice([*there, *there, f"{on}.f{rng.randrange(9)}"])
    called = name.partition(".")[2]
    new = rng.choice((f"f{rng.randrange(9)}", f"f{rng.randrange(99)}", "status", "Big", "class"))
    match rng.randrange(6):
        case 0 | 1:
            one = rng.choice((called, new))
            return Declare(text=rng.choice(FIELDS).format(one, one))
        case 2:
            return Rewrite(
                name=name, text=rng.choice(FIELD).format(rng.choice((called,) * 4 + (new,)))
            )
        case 3:
            return RemoveDeclaration(name=name)
        case 4:
            return Paste(text=f"trip has p{rng.randrange(9)}: text  # pasted\nnew_1 = Clock\n")
        case _:
            return Rename(name=name, new=new)


def draw(rng: Random, app: App, text: str) -> Operation:
    """Draw an operation; some of them cannot be done."""
    if rng.random() < 0.2:
        return draw_of_fields(rng, app)
    blocks = list(app.blocks) or ["none"]
    others = [words[1] for words in sorted(app.others) if words[0] not in ("version", "requires")]
    edges = sorted(app.edges, key=lambda one: (one[0], one[1], sorted(one[2]), one[3]))
    arrow = _arrow(rng, blocks)
    old = _of(rng.choice(edges)) if edges else arrow
    some = tuple(rng.sample(blocks, min(len(blocks), rng.choice((1, 1, 1, 2, 3)))))
    match rng.randrange(16):
        case 0:
            return AddBlock(
                kind=rng.choice(KINDS), name=rng.choice(("", "", f"b{rng.randrange(99)}"))
            )
        case 1:
            return RemoveBlocks(names=some)
        case 2:
            return Duplicate(names=some)
        case 3:
            a, b = rng.choice(blocks), f"new_{rng.randrange(99)}"
            return Paste(text=f"{a} = Clock\n{b} = GateFIFO  # pasted\n{a} -> {b} when FAILED\n")
        case 4 | 5:
            return Connect(arrow=arrow)
        case 6:
            return Disconnect(arrow=old)
        case 7:
            side = rng.random() < 0.5
            other = rng.choice([*blocks, "end", "start"])
            return Redirect(arrow=old, source=other if side else "", target="" if side else other)
        case 8:
            when = tuple(rng.sample(STATUSES, rng.choice((0, 1, 1, 2))))
            return SetGuard(arrow=old, when=when, otherwise=rng.random() < 0.3)
        case 9:
            value = rng.choice(
                ("5 min", "3", '"a # b"', "nearest", "[a, b]", ") x", "yes # no", None, None)
            )
            owners = [*blocks, *others]
            given = app.blocks.get(owner := rng.choice(owners), ("", {}))[1]
            parameter = rng.choice([*given, "default", "policy"])
            return SetArgument(owner=owner, parameter=parameter, value=value)
        case 10:
            return SetTitle(title=rng.choice(("", "Another title", 'With "quotes" and \\', "a\nb")))
        case 11:
            name = rng.choice((f"d{rng.randrange(99)}", rng.choice([*blocks, *others])))
            return Declare(text=rng.choice(DECLARATIONS).format(name))
        case 12:
            name = rng.choice([*blocks, *others])
            word = next((words[0] for words in sorted(app.others) if words[1] == name), "{}")
            fitting = [text for text in DECLARATIONS if text.startswith(word)]
            return Rewrite(name=name, text=rng.choice(fitting or DECLARATIONS).format(name))
        case 13:
            if others and rng.random() < 0.4:
                return RemoveDeclaration(name=rng.choice(others))
            new = rng.choice((f"other_{rng.randrange(99)}", rng.choice(blocks), "end", "Big", "ü"))
            return Rename(name=rng.choice([*blocks, *others]), new=new)
        case 14:
            unguarded: dict[str, list[str]] = {}
            for a, b, when_, otherwise in edges:
                if not when_ and (not otherwise or b == "end"):
                    unguarded.setdefault(a, []).append(b)
            forks = [(a, tuple(b)) for a, b in unguarded.items() if len(b) > 1]
            source, targets = rng.choice(forks) if forks else (blocks[0], some)
            return Bracket(source=source, targets=targets)
        case _:
            return Move(
                name=rng.choice([*blocks, *others]), before=rng.choice(["", *blocks, *others])
            )


def _arrow(rng: Random, blocks: list[str]) -> Arrow:
    when = tuple(rng.sample(STATUSES, rng.choice((0, 0, 1, 2))))
    return Arrow(
        source=rng.choice([*blocks, "start"]),
        target=rng.choice([*blocks, "end"]),
        when=when,
        otherwise=not when and rng.random() < 0.3,
    )


def _of(one: tuple[str, str, frozenset[str], bool]) -> Arrow:
    return Arrow(source=one[0], target=one[1], when=tuple(sorted(one[2])), otherwise=one[3])
