"""Calls to the code that the app's developer wrote, and what its faults become."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from .errors import ActionFailed, HookFault
from .kernel import WHATEVER, Cancelled, Kernel

Hook = Callable[..., object]


async def call_action(kernel: Kernel, hook: Hook, /, *args: object, **named: object) -> object:
    """Call an action; whatever it raises, `ActionFailed` aside, is a fault of the hook."""
    try:
        return await kernel.call_hook(hook, *args, **named)
    except (ActionFailed, Cancelled, GeneratorExit, KeyboardInterrupt):
        raise
    except WHATEVER as error:
        raise fault_of(hook, error) from error


def fault_of(hook: Hook, error: BaseException) -> HookFault:
    """Return what becomes of an error that a hook raised.

    Even `SystemExit` is a fault: it would end the flights of all others. An interrupt is the user's.
    """
    if isinstance(error, ActionFailed):
        reason = f"hook {hook_name(hook)} raised ActionFailed, which only an action may: {error}"
    else:
        reason = f"hook {hook_name(hook)} raised {said(error)}"
    return HookFault(reason, trace_of(error))


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
