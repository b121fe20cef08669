"""From the parser's tree to ours: one function a rule, each rule checked by the grammar before."""

from __future__ import annotations

from lark import Token, Tree

from plutoc.source import Source, Span
from plutoc.syntax import tree
from plutoc.syntax.texts import unescaped
from plutoc.syntax.tokens import span

Node = Tree[Token]
Child = Node | Token | None
"""None stands for what `[ ]` in a rule leaves out."""


def file(source: Source, node: Node) -> tree.File:
    """Build the tree of a source from the parser's."""
    _, *uses, app = _nodes(node)
    return tree.File(source=source, uses=tuple(map(_use, uses)), app=_app(app))


def empty(source: Source) -> tree.File:
    """Return the tree of a source that is not read at all."""
    nowhere = Span(0, 0)
    name = tree.Name(text="", span=nowhere)
    app = tree.AppDecl(name=name, title=None, statements=(), span=nowhere)
    return tree.File(source=source, uses=(), app=app)


def _use(node: Node) -> tree.Use:
    package, alias = node.children
    return tree.Use(
        package=_name(package),
        alias=_name(alias) if alias else None,
        span=Span(_span(node).start, _span(alias or package).end),
    )


def _app(node: Node) -> tree.AppDecl:
    name, title, *statements = node.children
    return tree.AppDecl(
        name=_name(name),
        title=_text(_token(title)) if title else None,
        statements=tuple(_statement(_node(statement)) for statement in statements),
        span=_span(node),
    )


def _statement(node: Node) -> tree.Statement:
    match node.data:
        case "version":
            return tree.VersionDecl(version=_text(_token(node.children[0])), span=_span(node))
        case "requires":
            return _requires(node)
        case "mission" | "trip":
            return _fields(node)
        case "result":
            return _result(node)
        case "category":
            return _category(node)
        case "event":
            return _event(node)
        case "action":
            return _action(node)
        case "block":
            return _block(node)
        case "flow":
            return _flow(node)
        case _:
            return _hook(node)


def _requires(node: Node) -> tree.RequiresDecl:
    libraries = tuple(_text(_token(child)) for child in node.children)
    return tree.RequiresDecl(libraries=libraries, span=_span(node))


def _fields(node: Node) -> tree.FieldsDecl:
    # Its span ends with its last field: a comma behind that is nothing of its own.
    return tree.FieldsDecl(on=str(node.data), fields=_parameters(node), span=_span(node))


def _result(node: Node) -> tree.ResultDecl:
    action, way, arguments = node.children
    return tree.ResultDecl(
        action=_name(action),
        way=_name(way),
        arguments=_arguments(arguments),
        span=_span(node),
    )


def _category(node: Node) -> tree.CategoryDecl:
    name, arguments, can = node.children
    return tree.CategoryDecl(
        name=_name(name), arguments=_arguments(arguments), can=_names(can), span=_span(node)
    )


def _event(node: Node) -> tree.EventDecl:
    name, fields = node.children
    return tree.EventDecl(name=_name(name), fields=_parameters(fields), span=_span(node))


def _action(node: Node) -> tree.ActionDecl:
    name, parameters, *details = node.children
    said = {str(each.data): each.children[0] for each in map(_node, details)}
    returns, repeat, takes = (said.get(word) for word in ("returns", "repeat", "takes"))
    return tree.ActionDecl(
        name=_name(name),
        parameters=_parameters(parameters),
        returns=_name(returns) if returns else None,
        repeat=_name(repeat) if repeat else None,
        takes=_value(takes) if takes else None,
        span=_span(node),
    )


def _hook(node: Node) -> tree.HookDecl:
    parameters, emits, writes = (*node.children[1:], None, None, None)[:3]
    return tree.HookDecl(
        kind=str(node.data),
        name=_name(node.children[0]),
        parameters=_parameters(parameters),
        emits=_names(emits),
        writes=_names(writes),
        span=_span(node),
    )


def _block(node: Node) -> tree.BlockDecl:
    name, prefix, kind, arguments = node.children
    return tree.BlockDecl(
        name=_name(name),
        prefix=_name(prefix) if prefix else None,
        kind=_name(kind),
        arguments=_arguments(arguments),
        span=_span(node),
    )


def _flow(node: Node) -> tree.FlowDecl:
    *stops, guard = node.children
    return tree.FlowDecl(
        stops=tuple(_stop(_node(stop)) for stop in stops),
        guard=_guard(_node(guard)) if guard else None,
        span=_span(node),
    )


def _stop(node: Node) -> tree.Stop:
    (only,) = node.children
    names = _names(only) if isinstance(only, Tree) else (_name(only),)
    return tree.Stop(names=names, span=_span(node))


def _guard(node: Node) -> tree.Guard:
    otherwise = node.data == "otherwise"
    statuses = () if otherwise else _names(node.children[0])
    return tree.Guard(statuses=statuses, otherwise=otherwise, span=_span(node))


def _arguments(child: Child) -> tuple[tree.Argument, ...]:
    return tuple(
        tree.Argument(
            name=_name(argument.children[0]),
            value=_value(argument.children[1]),
            span=_span(argument),
        )
        for argument in _nodes(child)
    )


def _parameters(child: Child) -> tuple[tree.Parameter, ...]:
    return tuple(_parameter(node) for node in _nodes(child))


def _parameter(node: Node) -> tree.Parameter:
    # Lark puts no None for a left out default: what it can be is a rule that it sees through.
    name, kind, *default = node.children
    return tree.Parameter(
        name=_name(name),
        type=_name(kind),
        default=_value(default[0]) if default else None,
        span=_span(node),
    )


def _value(child: Child) -> tree.Value:
    where = _span(child)
    if isinstance(child, Tree):
        items = tuple(_value(item) for item in child.children if item is not None)
        return tree.List(items=items, span=where)
    token = _token(child)
    match token.type:
        case "NUMBER":
            return tree.Number(value=_number(token), span=where)
        case "QUANTITY":
            unit = token.lstrip("-0123456789.").strip()
            number = token[: len(token) - len(unit)].strip()
            return tree.Quantity(value=_number(number), unit=unit, span=where)
        case "TEXT":
            return _text(token)
        case _ if token in ("yes", "no"):
            return tree.Bool(value=token == "yes", span=where)
        case _:
            return _name(token)


def _number(digits: str) -> int | float:
    return float(digits) if "." in digits else int(digits)


def _text(token: Token) -> tree.Text:
    return tree.Text(value=unescaped(token), span=_span(token))


def _names(child: Child) -> tuple[tree.Name, ...]:
    return tuple(map(_name, child.children)) if isinstance(child, Tree) else ()


def _name(child: Child) -> tree.Name:
    return tree.Name(text=str(child), span=_span(child))


def _span(child: Child) -> Span:
    if isinstance(child, Tree):
        return Span(child.meta.start_pos, child.meta.end_pos)
    return span(_token(child))


def _nodes(child: Child) -> list[Node]:
    children = child.children if isinstance(child, Tree) else []
    return [grandchild for grandchild in children if isinstance(grandchild, Tree)]


def _node(child: Child) -> Node:
    assert isinstance(child, Tree)
    return child


def _token(child: Child) -> Token:
    assert isinstance(child, Token)
    return child
