"""Calls to the code that the app's developer wrote, and what its faults become."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from .errors import ActionFailed, HookFault
from .kernel import Cancelled, Kernel

Hook = Callable[..., object]


async def call_hook(kernel: Kernel, hook: Hook, /, *args: object, **named: object) -> object:
    """Call a hook; whatever it raises, `ActionFailed` aside, is a fault of the hook.

    Even `SystemExit` is: it would end the flights of all others. An interrupt is the user's.
    """
    try:
        return await kernel.call_hook(hook, *args, **named)
    except (ActionFailed, Cancelled, GeneratorExit, KeyboardInterrupt):
        raise
    except BaseException as error:
        raise HookFault(f"hook {hook_name(hook)} raised {said(error)}", trace_of(error)) from error


def said(error: BaseException) -> str:
    """Return an error's type and its text, if it has any to give."""
    with suppress(Exception):
        return f"{type(error).__name__}: {error}".removesuffix(": ")
    return type(error).__name__


def hook_name(hook: Hook) -> str:
    """Return a hook's name, as its declaration has it."""
    inner = getattr(hook, "func", hook)  # functools.partial carries its function so
    return str(getattr(inner, "__name__", inner))


def trace_of(error: BaseException) -> str:
    """Return the traceback of a hook's error, for the log."""
    import traceback  # not needed by those who only declare blocks

    return "".join(traceback.format_exception(error)).rstrip()
