"""What a gesture changes: operations on the picture, fixes, stubs and the canonical form as changes of texts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from plutoc.diagnostic import Fix, Rejected
from plutoc.editor.app_files import AppFiles
from plutoc.editor.asked import Refused
from plutoc.editor.changes import Edit, Edits, between, in_order
from plutoc.editor.history import Change, File
from plutoc.editor.wire import Wire
from plutoc.edits import applied
from plutoc.format.run import TooLarge, format_source
from plutoc.report.layout import Point
from plutoc.service.document import Document
from plutoc.service.editing.edit import edit
from plutoc.service.editing.operations import AddBlock, Operation, RemoveBlocks, Rename, operation
from plutoc.service.reading.fixes import with_stub
from plutoc.source import Source


@dataclass(frozen=True, slots=True, kw_only=True)
class Gesture:
    """What is to be changed in one step, and which blocks are new."""

    changes: Sequence[Change]
    names: Sequence[str] = ()
    note: str = ""
    """What is left to people."""


@dataclass(slots=True)
class _Drawn:
    """The app after some operations, and how it came to that."""

    document: Document
    hooks: Source | None
    app_edits: list[Edits] = field(default_factory=list)
    hooks_edits: list[Edits] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    note: str = ""
    moved: dict[str, Point | None] = field(default_factory=dict)
    added: str = ""
    """The block that was added last: operations call it ""."""


def operations(
    files: AppFiles, given: Sequence[object], positions: Mapping[str, Point | None]
) -> Gesture:
    """Do operations one after the other; raise `CannotEdit` or `NotAnOperation` where one is none."""
    drawn = _Drawn(files.document, files.hooks)
    for one in given:
        _do(drawn, operation(_named(one, drawn.added)), files)
    for name, at in positions.items():
        if name or drawn.added:
            drawn.moved[name or drawn.added] = at
    changes: list[Change] = []
    if drawn.app_edits:
        changes.append(_change(files, File.APP, drawn.app_edits, drawn.document.text))
    if drawn.hooks_edits and drawn.hooks is not None:
        changes.append(_change(files, File.HOOKS, drawn.hooks_edits, drawn.hooks.text))
    if drawn.moved:
        changes.append(files.history.placed(drawn.moved))
    names = tuple(dict.fromkeys(drawn.names))
    return Gesture(changes=changes, names=names, note=drawn.note)


def _do(drawn: _Drawn, meant: Operation, files: AppFiles) -> None:
    edited = edit(drawn.document, meant)
    if edited.edits:
        source = drawn.document.source
        drawn.app_edits.append(own_edits(source.text, edited.edits))
        text = applied(source, edited.edits)
        drawn.document = files.document_of(text, drawn.hooks)
    if edited.hooks and drawn.hooks is not None:
        drawn.hooks_edits.append(own_edits(drawn.hooks.text, edited.hooks))
        drawn.hooks = Source(drawn.hooks.path, applied(drawn.hooks, edited.hooks))
        drawn.document = files.document_of(drawn.document.text, drawn.hooks)
    drawn.names += edited.names
    drawn.note = edited.note or drawn.note
    at = files.history.positions
    match meant:
        case AddBlock():
            drawn.added = edited.names[-1]
        case Rename(name=name, new=new) if name in at:
            drawn.moved |= {name: None, new: at[name]}
        case RemoveBlocks(names=names):
            drawn.moved |= {name: None for name in names if name in at}
        case _:
            pass


def _named(given: object, added: str) -> object:
    """Return an operation's data with the name of the block added last where an end is ""."""
    if not added or not isinstance(given, dict):
        return given
    ends: dict[str, object] = {
        name: added for name in ("source", "target", "owner") if given.get(name) == ""
    }
    if "arrow" in given:
        ends["arrow"] = _named(given["arrow"], added)
    return {**given, **ends}


def fix(files: AppFiles, index: int) -> Gesture:
    """Mend a problem, as it certainly can be."""
    found = files.document.diagnostics
    one = found[index] if 0 <= index < len(found) else None
    if one is None or one.fix is None:
        raise Refused("there is no certain way to mend that: its help says what to do")
    if one.source == files.document.source:
        edits = [own_edits(files.history.app, [one.fix])]
        return Gesture(changes=[_change(files, File.APP, edits, "")])
    return Gesture(
        changes=[_change(files, File.HOOKS, [own_edits(one.source.text, [one.fix])], "")]
    )


def formatted(files: AppFiles) -> Gesture:
    """Bring the app's text into its canonical form."""
    try:
        text = format_source(files.document.source)
    except Rejected as rejected:
        raise Refused(f"it has mistakes in its syntax: {rejected.diagnostics[0].message}") from None
    except TooLarge:
        raise Refused("in canonical form it would be too large") from None
    return Gesture(changes=[files.history.edited(File.APP, between(files.history.app, text))])


def stub(files: AppFiles, name: str) -> Gesture:
    """Add the stub of a hook to hooks.py, or make that file with the stubs of all."""
    document = files.document
    if document.checked is None:
        raise Refused("the app has errors: a stub is written when they are mended")
    graph = document.checked.graph
    if name not in {*(one.name for one in graph.hooks), *(one.name for one in graph.actions)}:
        raise Refused(f"the app declares no hook `{name}`")
    fixes = with_stub(document, name)
    if not fixes:
        raise Refused(f"hooks.py defines `{name}` already, or cannot be read")
    text = files.hooks.text if files.hooks else ""
    return Gesture(changes=[_change(files, File.HOOKS, [own_edits(text, fixes)], "")])


def own_edits(text: str, fixes: Sequence[Fix]) -> Edits:
    """Return fixes of a text as edits of it, with its line ends."""
    end = Wire(text).line_end
    return in_order(
        Edit(one.span.start, one.span.end, one.text.replace("\n", end)) for one in fixes
    )


def _change(files: AppFiles, file: File, steps: Sequence[Edits], after: str) -> Change:
    """Return the change of one or several steps, of which the last gives this text."""
    before = files.history.text(file)
    if file is File.APP:
        edits = steps[0] if len(steps) == 1 else between(before, after)
        return files.history.edited(file, edits)
    hooks = Wire(before)  # steps are of its text as Python reads it
    edits = steps[0] if len(steps) == 1 else between(hooks.shown, after)
    shown = Wire(hooks.shown, marked=False)
    return files.history.edited(
        file,
        tuple(
            Edit(
                hooks.in_file(shown.on_wire(one.start)),
                hooks.in_file(shown.on_wire(one.end)),
                hooks.own(one.text),
            )
            for one in edits
        ),
    )
