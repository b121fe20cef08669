"""The names of an app: which are declared, as what, and whether they may be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors, names
from plutoc.graph.app_names import taken_app_name
from plutoc.graph.built_in import ACTIONS, EVENTS
from plutoc.graph.built_in import ALONG as ALONG_BUILT_IN
from plutoc.graph.names import Style
from plutoc.graph.uncertain_names import bad_statements
from plutoc.source import Source
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
    Name,
    RequiresDecl,
    ResultDecl,
    VersionDecl,
)

BLOCK, CATEGORY, ACTION, PREFIX = "a block", "a category", "an action", "a package's prefix"
EVENT = "an event"
ALONG = "along"
"""What an action declares that is done on the way."""
HOOK_ROLES = {
    "evaluator": "an evaluator",
    "modifier": "a modifier",
    "policy": "a policy",
    "creator": "a creator",
}
_HOOKS = frozenset({ACTION, *HOOK_ROLES.values()})
_BAD_ROLES = HOOK_ROLES | {"block": BLOCK, "category": CATEGORY, "action": ACTION, "use": PREFIX}
_BAD_ROLES |= {"event": EVENT}


@dataclass(frozen=True, slots=True, kw_only=True)
class Declared:
    """What a name stands for."""

    name: Name
    role: str
    again: bool = False
    """A built-in action, which the app says more of."""


Scope = dict[str, Declared]
"""By name; where a name is declared twice, the first one counts."""


def scope_of(file: File, found: list[Diagnostic]) -> Scope:
    """Collect all names of a file. A wrong statement declares its name all the same."""
    scope: Scope = {}
    lower: dict[str, Declared] = {}
    for declared in _declarations(file):
        name = declared.name
        first = lower.setdefault(name.text.lower(), declared)
        if declared.role in _HOOKS and name.text.lower() in ACTIONS and not declared.again:
            found.append(errors.built_in_name(file.source, name, ACTION, _may_be_along(declared)))
        elif declared.role == EVENT and name.text.lower() in EVENTS:
            found.append(errors.built_in_name(file.source, name, EVENT))
        elif first is not declared and first.name.text == name.text:
            found.append(
                errors.declared_twice(file.source, name, declared.role, first.name, first.role)
            )
        elif first is not declared:
            found.append(errors.differs_in_case_only(file.source, name, first.name))
        else:
            check_name(file.source, name, declared.role, found)
        scope.setdefault(name.text, declared)
    for bad in bad_statements(file):
        role = _BAD_ROLES.get(bad.kind or "")
        if role and bad.name:
            scope.setdefault(bad.name.text, Declared(name=bad.name, role=role))
    return scope


def _may_be_along(declared: Declared) -> bool:
    return declared.role == ACTION and declared.name.text in ALONG_BUILT_IN


def spoilt_names(source: Source, found: Sequence[Diagnostic]) -> list[str]:
    """Return the declared names that something was found about: others may have been meant."""
    return [source.quote(diagnostic.span) for diagnostic in found]


def _declarations(file: File) -> list[Declared]:
    declared = [Declared(name=use.alias or use.package, role=PREFIX) for use in file.uses]
    for statement in file.app.statements:
        match statement:
            case CategoryDecl():
                declared.append(Declared(name=statement.name, role=CATEGORY))
            case EventDecl():
                declared.append(Declared(name=statement.name, role=EVENT))
            case ActionDecl():
                again = is_built_in_along(statement)
                declared.append(Declared(name=statement.name, role=ACTION, again=again))
            case HookDecl():
                declared.append(Declared(name=statement.name, role=HOOK_ROLES[statement.kind]))
            case BlockDecl():
                declared.append(Declared(name=statement.name, role=BLOCK))
            case VersionDecl() | RequiresDecl() | FieldsDecl() | ResultDecl():
                pass
            case FlowDecl() | BadStatement():
                pass
    return declared


def is_built_in_along(declared: ActionDecl) -> bool:
    """Return whether a declaration says that a built-in action is done on the way, too."""
    word = declared.repeat.text if declared.repeat else ""
    return word == ALONG and declared.name.text in ACTIONS


def check_name(source: Source, name: Name, role: str, found: list[Diagnostic]) -> None:
    """Check a declared name by itself."""
    whose = names.reserved(name.text)
    if not names.is_well_formed(name.text):
        found.append(errors.malformed_name(source, name))
    elif whose:
        found.append(errors.reserved_name(source, name, whose))
    elif not names.has_style(name.text, Style.SNAKE):
        found.append(errors.wrong_style(source, name, f"the name of {role}", Style.SNAKE))


def check_app_name(source: Source, name: Name, found: list[Diagnostic]) -> None:
    """Check an app's name, which is its package's too."""
    taken = taken_app_name(name.text)
    if not name.text:
        return  # it cannot be read, which is told
    if taken:
        found.append(errors.taken_app_name(source, name, taken))
    else:
        check_name(source, name, "an app", found)
