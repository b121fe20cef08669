"""`compile`: the package of an app, on the disk."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc.check.model import Checked
from plutoc.cli.endings import CLEAN, ERRORS, REFUSED, UsageError
from plutoc.cli.files import read_app
from plutoc.cli.options import Options
from plutoc.cli.say import say, speak, worded
from plutoc.compile import Compiled, analyse, compile_source, planned
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit.embed import NoLibrary
from plutoc.emit.errors import never_written, outdated, place_of
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.lock import only_forgets
from plutoc.emit.write import CannotWrite, Changes, Refused, write
from plutoc.project.hooks import default_folder, find_hooks, hooks_path, passed_over
from plutoc.project.package import changes_of, known_hooks
from plutoc.project.reading import shown
from plutoc.source import Source
from plutoc_runtime.domain.text import counted, printable

if TYPE_CHECKING:
    from plutoc.graph.model import Graph
    from plutoc.plan.model import Plan


@dataclass(slots=True, kw_only=True, eq=False)
class _Messages:
    """What there is to say, gathered: some formats are one document."""

    found: list[Diagnostic] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)


def compile_(options: Options, written: Callable[[], None] = lambda: None) -> int:
    """Write an app's package, or say what would be written.

    `written` is called when files were written, and nothing is said yet.
    """
    said, code = _Messages(), CLEAN
    try:
        _compile(options, said, written)
    except Rejected as rejected:
        said.found += rejected.diagnostics
        code = REFUSED if isinstance(rejected, Refused) else ERRORS
    except NoLibrary as error:
        raise UsageError(f"--carry fleet: {error}") from None
    except UsageError as error:
        say(said.found, options.format, [str(error)])
        raise
    text = options.format == "text"
    speak(worded(said.found, options.format))
    speak((text, line) for line in said.lines)  # other formats have standard output for themselves
    return code


def _compile(options: Options, said: _Messages, written: Callable[[], None]) -> None:
    source = read_app(options.file)
    if options.show is not None:
        _show(source, options, options.show, said)
        return
    try:
        compiled = compile_source(
            source,
            source_name=options.file.name,
            find_hooks=lambda checked: _hooks(options, checked),
            optimise=not options.plain,
            carry=options.carry is not None,
            known_hooks=lambda checked: known_hooks(
                checked, _folder(options, checked), force=options.force
            ),
        )
        said.found += compiled.warnings
        said.found += _of_hooks_beside(options, compiled)
        changes = changes_of(
            compiled,
            _folder(options, compiled.checked),
            asks_for_stubs=options.add_stubs,
            force=options.force,
        )
        if options.diff:
            from plutoc.project.patch import patch

            said.lines += patch(changes)
        if options.check:
            changes = _drift(changes)
            _refuse(compiled.checked, changes)
        elif not options.diff:
            write(changes)
            written()
    except CannotWrite as error:
        raise UsageError(f"{printable(str(error))}; nothing was changed") from None
    if options.format == "text" and not options.diff:
        said.lines += _outcome(compiled, changes)


def _show(source: Source, options: Options, what: str, said: _Messages) -> None:
    checked, warnings = analyse(source)
    said.found += warnings
    if what == "graph":
        from plutoc.report.pictures import mermaid

        text = mermaid(checked)
    else:
        from plutoc.plan.show import show

        text = show(_plan(checked, options, what))
    said.lines.append(text.rstrip("\n"))


def _plan(checked: Checked, options: Options, what: str) -> Plan:
    """Return the last plan, or the one after the pass that is named behind `plan=`."""
    _, asked, name = what.partition("=")
    if not asked:
        return planned(checked, optimise=not options.plain)
    from plutoc.plan.build import build
    from plutoc.plan.optimise import stages

    plans = dict(stages(build(checked)))
    if name not in plans:
        known = ", ".join(plans)
        raise UsageError(f"--show plan={printable(name)}: there is no such pass, only {known}")
    return plans[name]


def _folder(options: Options, checked: Checked) -> Path:
    return options.folder or default_folder(options.file, checked.graph)


def _hooks(options: Options, checked: Checked) -> Source | None:
    """Return the developer's code, with stubs for what is missing if that was asked for."""
    hooks = find_hooks(checked.graph, options.file, _folder(options, checked))
    if hooks is None or not options.add_stubs:
        return hooks
    from plutoc.hooks.add import with_stubs

    return Source(hooks.path, with_stubs(checked, hooks))


def _of_hooks_beside(options: Options, compiled: Compiled) -> Iterator[Diagnostic]:
    """Warn of a hooks.py beside the app that looks like the code that counts, and is not."""
    folder, hooks = _folder(options, compiled.checked), compiled.hooks
    beside = passed_over(compiled.checked.graph, options.file, folder)
    if beside is not None and hooks is not None and beside.text != hooks.text:
        from plutoc.hooks.errors import passed_over as not_read

        yield not_read(beside, hooks)


def _drift(changes: Changes) -> Changes:
    """Return what makes a package out of date: not that a hook was deleted, as we had asked for."""
    for change in changes.files if len(changes.files) == 1 else ():
        if change.path == LOCK and only_forgets(change.before or "", change.after or ""):
            return replace(changes, files=())
    return changes


def _refuse(checked: Checked, changes: Changes) -> None:
    """`--check`: raise `Rejected` if the package is not what writing would make it."""
    place, folder = place_of(checked.graph), shown(changes.folder)
    if changes.first:
        raise Rejected([never_written(place, folder)])
    if changes.files:
        paths = [change.path for change in changes.files]
        raise Rejected([outdated(place, folder, paths, settles_merge=changes.settles_merge)])


def _outcome(compiled: Compiled, changes: Changes) -> Iterator[str]:
    folder = shown(changes.folder)
    if changes.first:
        yield f"{folder}: a new package of {counted(len(changes.files), 'file')}"
        graph = compiled.checked.graph
        own = f"{folder}/{hooks_path(graph)}"
        if compiled.hooks is not None:
            yield f"  {compiled.hooks.path} was copied to {own}: edit that one from now on"
        elif graph.hooks or graph.actions:
            yield f"  your own code goes into {own}"
        path = os.path.join(".", changes.folder)
        if printable(path) == path:  # else a shell would need it otherwise than can be shown
            yield from _installing(graph, path)
    elif changes.files:
        settled = ", and a merge is settled" if changes.settles_merge else ""
        yield f"{folder}: {counted(len(changes.files), 'file')} changed{settled}"
        for change in changes.files:
            mark = "+" if change.before is None else "-" if change.after is None else "~"
            yield f"  {mark} {shown(Path(change.path))}"
    else:
        yield f"{folder}: up to date"


def _installing(graph: Graph, path: str) -> Iterator[str]:
    """Yield how a new package is installed, alone and with the library that flies."""
    from shlex import quote

    why = "; by -e what you edit there counts at once" if graph.hooks or graph.actions else ""
    fleet, name = quote(f"{path}[fleet]"), quote(f"{graph.name.rstrip('_')}[fleet]")
    yield f"  install it with: pip install -e {quote(path)}{why}"
    yield f"  so it checks and simulates; to fly it needs pluto-fleet: pip install -e {fleet}"
    yield f"    without an index, from Pluto's sources: pip install -e {fleet} PLUTO/runtime"
    yield f"    without a network: pip wheel -w wheels PLUTO/runtime {fleet}, and there:"
    yield f"    pip install --no-index --find-links wheels {name}"
