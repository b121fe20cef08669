"""What can be wrong with the code that a developer added: P3."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

from plutoc.diagnostic import Diagnostic, Fix, Related, error, warning
from plutoc.emit.lock import PROBE
from plutoc.graph.wording import all_of, article
from plutoc.hooks.expected import Expected
from plutoc.source import Source, Span
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class At:
    """A place in the function of a hook."""

    app: Source
    hooks: Source
    hook: Expected
    span: Span

    def on(self, span: Span) -> At:
        """Return another place in the same function."""
        return replace(self, span=span)

    def error(self, code: str, message: str, *, label: str, waits: bool = False) -> Diagnostic:
        """Return an error here, with the first line that the function should have."""
        line = self.hook.first_line
        return error(
            code,
            message,
            self.hooks,
            self.span,
            label=label,
            related=(Related(source=self.app, span=self.hook.span, label="declared here"),),
            help="let it begin like this:\n"
            + (f"async {line}" if waits and not line.startswith("async ") else line),
        )


def not_python(hooks: Source, span: Span, why: str) -> Diagnostic:
    """A hooks.py that Python itself would refuse."""
    return error(
        "P3001",
        f"this is not Python: {why}",
        hooks,
        span,
        label="Python stops here",
        help=_MEND_FIRST,
    )


def unreadable(hooks: Source, why: str) -> Diagnostic:
    """A hooks.py that cannot be read at all."""
    return error(
        "P3002", f"`{hooks.path}` cannot be read: {why}", hooks, Span(0, 0), help=_MEND_FIRST
    )


_MEND_FIRST = "mend it first: hooks can only be checked in a file that Python can read"


def missing(app: Source, hook: Expected, path: str, near: str | None) -> Diagnostic:
    """A hook that the app declares and hooks.py does not define."""
    similar = f"there is a `{near}`: rename it if it is meant, or " if near else ""
    return error(
        "P3003",
        f"`{path}` has no `{hook.name}`",
        app,
        hook.span,
        label=f"this {hook.kind.value} is a function that you write",
        help=f"{similar}write it there, as `plutoc compile --add-stubs` does, to begin with like "
        f"this:\n{hook.stub}",
    )


def not_a_function(at: At) -> Diagnostic:
    """A class with the name of a hook."""
    return at.error(
        "P3004",
        f"`{at.hook.name}` is a class, and the app calls it as a function",
        label="a class",
    )


def wrong_count(at: At, takes: Sequence[str]) -> Diagnostic:
    """A hook with too few parameters for what it gets by position."""
    got = f"only {all_of(takes)}" if takes else "nothing"
    return at.error(
        "P3005",
        f"`{at.hook.name}` gets {all_of(at.hook.passed)}, and takes {got}",
        label=f"too few parameters for {article(at.hook.kind.value)}",
    )


def wrong_order(at: At, name: str, gets: str) -> Diagnostic:
    """A parameter with the name of what comes in another place."""
    return at.error(
        "P3006",
        f"`{name}` of `{at.hook.name}` would get the {gets}",
        label=f"the {gets} arrives here",
    )


def missing_parameter(at: At, name: str) -> Diagnostic:
    """A parameter that the app declares and the hook does not take."""
    return at.error(
        "P3007",
        f"`{at.hook.name}` does not take `{name}`, which the app declares",
        label=f"no parameter `{name}`",
    )


def renamed_parameter(at: At, given: str, name: str) -> Diagnostic:
    """A declared parameter that the hook calls by another name."""
    return at.error(
        "P3007",
        f"`{at.hook.name}` does not take `{name}`, which the app declares, but `{given}`",
        label=f"nothing gives `{given}` a value; is it `{name}`?",
    )


def unfilled_parameter(at: At, name: str) -> Diagnostic:
    """A parameter that is given no value."""
    return at.error(
        "P3008",
        f"`{at.hook.name}` asks for `{name}`, and nothing gives it a value",
        label="neither declared in the app nor with a default",
    )


def by_position_only(at: At, name: str) -> Diagnostic:
    """A parameter that is given by name and can only be given by its place."""
    return at.error(
        "P3009",
        f"`{at.hook.name}` takes `{name}` only by its place, and the app gives it by name",
        label="write it behind a `*`",
    )


def may_not_wait(at: At) -> Diagnostic:
    """A policy that is an `async def`."""
    return at.error(
        "P3010",
        f"{article(at.hook.kind.value)} answers at once: `{at.hook.name}` cannot be an `async def`",
        label="write `def`",
    )


def generator(at: At) -> Diagnostic:
    """A hook with a `yield`, which the app would never run."""
    return at.error(
        "P3011",
        f"`{at.hook.name}` contains `yield`, so calling it does nothing",
        label="a generator",
    )


def unknown_annotation(at: At, name: str, near: str | None, exported: bool) -> Diagnostic:
    """A name in the types of a hook that the file does not have."""
    label = f"did you mean `{near}`?" if near else "nothing of this name"
    return at.error(
        "P3012",
        f"`{name}`, a type of `{at.hook.name}`, is neither imported nor defined in this file",
        label=f"write `from . import {name}`" if exported else label,
    )


def wrong_annotation(at: At, name: str, written: str, gets: str) -> Diagnostic:
    """A parameter with the type of something else than what arrives."""
    return at.error(
        "P3013",
        f"`{name}` of `{at.hook.name}` is written as `{written}`, and gets {_article(gets)} `{gets}`",
        label=f"{_article(gets)} `{gets}` arrives here",
    )


def wrong_return(at: At, written: str, wanted: str) -> Diagnostic:
    """A hook that says that it returns what the app can do nothing with."""
    nothing = f"{article(at.hook.kind.value)} without `emits` returns nothing"
    return at.error(
        "P3014",
        f"`{at.hook.name}` returns `{written}`, and "
        + (nothing if wanted == "None" else f"the app needs {_article(wanted)} `{wanted}`"),
        label=f"must be `{wanted}`",
    )


def must_wait(at: At) -> Diagnostic:
    """A hook with an `await` that is no `async def`."""
    return at.error(
        "P3015",
        f"`{at.hook.name}` waits for something, and only an `async def` can",
        label=f"needs `async def {at.hook.name}`",
        waits=True,
    )


def policy_waits(at: At) -> Diagnostic:
    """A policy with an `await`."""
    return at.error(
        "P3010",
        f"{article(at.hook.kind.value)} answers at once: `{at.hook.name}` cannot wait for anything",
        label="waits",
    )


def passed_over(beside: Source, own: Source) -> Diagnostic:
    """A hooks.py beside the app that is not read any more, and is not what counts."""
    return warning(
        "P3016",
        f"`{beside.path}` is not read any more: `{own.path}` counts, and the two differ",
        beside,
        _first_difference(beside.text, own.text),
        label="here they begin to differ" if beside.text else "",
        help=f"edit `{own.path}`, and take over what it lacks; then delete or rename"
        f" `{beside.path}`",
    )


def left_over(app: Source, hooks: Source, span: Span, name: str, kind: str) -> Diagnostic:
    """A function of a hook that the app has declared, and does not declare any more."""
    if kind == PROBE:
        action = name.removesuffix("_done")
        was = f"told whether `{action}` was done, and the app has no action `{action}` any more"
    else:
        was = f"was {article(kind)} of the app, which does not declare it any more"
    return warning(
        "P3017",
        f"`{name}` {was}",
        hooks,
        span,
        label="never called",
        help=f"delete it, or declare {'that action' if kind == PROBE else 'it'} in `{app.path}`"
        " again",
    )


def undeclared_return(at: At, said: str, emits: Sequence[str]) -> Diagnostic:
    """A modifier that returns what it does not declare, so that its mission fails."""
    declares = f"emits only {all_of(emits)}" if emits else "declares no `emits`"
    what = "nothing" if said == "None" else f"`{said}`"
    mend = "return one of these" + (
        ", or write the other behind `emits` too" if said in Status.__members__ else ""
    )
    return error(
        "P3019",
        f"`{at.hook.name}` returns {what}, and {declares}",
        at.hooks,
        at.span,
        label="fails its mission" if emits else "it must return nothing",
        related=(Related(source=at.app, span=at.hook.span, label="declared here"),),
        help=mend if emits else _NO_EMITS,
    )


def undeclared_result(at: At, said: str, result: str) -> Diagnostic:
    """An action that returns a value of another type than it declares."""
    return error(
        "P3020",
        f"`{at.hook.name}` returns {said if said == 'nothing' else f'`{said}`'}, and declares"
        f" {_article(result)} `{result}`",
        at.hooks,
        at.span,
        label="fails its mission",
        related=(Related(source=at.app, span=at.hook.span, label="declared here"),),
        help=f"return {_article(result)} `{result}`, or declare what it returns",
    )


_NO_EMITS = "return nothing, or say behind `emits` with which statuses it goes on"


def forgotten_await(
    hooks: Source,
    span: Span,
    called: str,
    function: str,
    fix: Fix | None,
    *,
    waits: bool,
    may_wait: bool,
) -> Diagnostic:
    """A call that does nothing, as what it returns is not awaited."""
    help = f"write `await {called}(…)`"
    if not may_wait:
        help = (
            f"a policy answers at once, and cannot wait for anything: `{function}` must do without"
        )
    elif not waits:
        help = f"`{function}` is a plain `def`: make it an `async def` first, then {help}"
    return error(
        "P3018",
        f"`{function}` calls `{called}` without `await`, so it is not done",
        hooks,
        span,
        label="only makes a coroutine, which is never run",
        help=help,
        fix=fix,
    )


def _first_difference(text: str, other: str) -> Span:
    """Return the first line of a text that is not as in the other."""
    start = 0
    for line, theirs in zip_longest(
        text.splitlines(keepends=True), other.splitlines(keepends=True)
    ):
        if line is None or line != theirs:
            return Span(start, start + len((line or "").rstrip()))
        start += len(line)
    return Span(start, start)


def _article(word: str) -> str:
    return "an" if word[0].lower() in "aeiou" else "a"


# Events that hooks raise

WANTED = {Type.BOOL: "True or False", Type.TEXT: "a text", Type.INT: "a whole number"}
"""What a field of an event must be; of all other types, a number."""


def unknown_event(hooks: Source, span: Span, name: str, meant: str | None) -> Diagnostic:
    """A hook raises what the app does not declare."""
    return error(
        "P3021",
        f"the app has no event `{name}`",
        hooks,
        span,
        label="nothing comes of it",
        help=f"did you mean `{meant}`?" if meant else f"declare it in the app: `event {name}`",
    )


def unknown_event_field(
    hooks: Source, span: Span, event: str, name: str, meant: str | None
) -> Diagnostic:
    """A hook says something of an event that the event does not have."""
    return error(
        "P3022",
        f"the event `{event}` has no `{name}`",
        hooks,
        span,
        help=f"did you mean `{meant}`?" if meant else "declare it with the event, or leave it out",
    )


def set_event_field(hooks: Source, span: Span, event: str, name: str) -> Diagnostic:
    """A hook says what the app knows by itself."""
    return error(
        "P3022",
        f"`{name}` of the event `{event}` is set by the app",
        hooks,
        span,
        help="leave it out; to name another one, give the event a field of its own",
    )


def wrong_event_field(hooks: Source, span: Span, event: str, name: str, wanted: str) -> Diagnostic:
    """A hook says something of an event that is of another type."""
    return error(
        "P3022",
        f"`{name}` of the event `{event}` must be {wanted}",
        hooks,
        span,
    )


def missing_event_field(
    hooks: Source, span: Span, event: str, missing: Sequence[str]
) -> Diagnostic:
    """A hook leaves out what has no default."""
    return error(
        "P3022",
        f"the event `{event}` needs {all_of(missing)}",
        hooks,
        span,
        help="name it here, or give it a default where the event is declared",
    )


def unraised(app: Source, span: Span, event: str, path: str) -> Diagnostic:
    """An event that no hook raises, and that hooks.py does not even name."""
    return warning(
        "P3023",
        f"no hook raises the event `{event}`",
        app,
        span,
        label="it must come from elsewhere",
        help=f'raise it in a hook, `context.emit("{event}")`; if it comes from outside, say so in a '
        f"comment of {path}: `{event}` in backquotes is enough",
    )
