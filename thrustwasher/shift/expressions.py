"""Expressions of ``warnings.toml``, evaluated over a run; the page of a scene evaluates the same.

An expression is Python's syntax over numbers, texts, signals "part.variable" and arrays of points;
it becomes a tree of JSON types, ``[operation, *arguments]``. ``None`` is what is not known.
"""

import ast
import operator
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

Tree = Any  # a number, None, or [operation, *trees]
ALMOST = 1e-9  # of an end of a range

OPERATORS: dict[type, str] = {
    **{ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.USub: "neg", ast.Not: "not"},
    **{ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "=="},
    **{ast.NotEq: "!=", ast.And: "and", ast.Or: "or"},
}


class Missing(LookupError):
    """A signal that a run has not."""


@cache
def parsed(text: str) -> Tree:
    """Return the tree of an expression.

    >>> parsed("abs(washer.speed) > 2.0")
    ['>', ['abs', ['signal', ['text', 'washer.speed']]], 2.0]
    """
    return _tree(ast.parse(text, mode="eval").body)


def _tree(node: ast.AST) -> Tree:
    match node:
        case ast.Constant(value=str(text)):
            return ["text", text]
        case ast.Constant(value=number):
            return number
        case ast.Name(id=name):
            return ["name", name]
        case ast.Attribute(value=ast.Name(id=part), attr=variable):
            return ["signal", ["text", f"{part}.{variable}"]]
        case ast.JoinedStr(values=pieces):
            return ["fill", *map(_tree, pieces)]
        case ast.FormattedValue(value=value):
            return _tree(value)
        case ast.UnaryOp(op=op, operand=x):
            return [OPERATORS[type(op)], _tree(x)]
        case ast.BinOp(left=left, op=op, right=right):
            return [OPERATORS[type(op)], _tree(left), _tree(right)]
        case ast.BoolOp(op=op, values=values):
            return [OPERATORS[type(op)], *map(_tree, values)]
        case ast.Compare(left=left, ops=ops, comparators=others):
            ends = [_tree(x) for x in (left, *others)]
            pairs = [[OPERATORS[type(op)], *ends[i : i + 2]] for i, op in enumerate(ops)]
            return pairs[0] if len(pairs) == 1 else ["and", *pairs]
        case ast.IfExp(test=test, body=body, orelse=other):
            return ["if", _tree(test), _tree(body), _tree(other)]
        case ast.Call(func=ast.Name(id=name), args=args):
            return [name, *map(_tree, args)]
        case ast.Subscript(value=x, slice=ast.Slice(lower=low, upper=high)):
            return ["part", _tree(x), _tree(low) if low else 0, _tree(high) if high else None]
        case ast.Subscript(value=x, slice=i):
            return ["item", _tree(x), _tree(i)]
    raise SyntaxError(f"{ast.unparse(node)}: no expression of a rule")


def _place(found: Any, *, last: bool = False) -> int | None:
    """Return the first or last point where something holds."""
    places = np.flatnonzero(found)
    return int(places[-1 if last else 0]) if len(places) else None


def _before(x: Any, t: float, time: Any) -> Any:
    return x[max(int(np.searchsorted(time, t, side="right")) - 1, 0)]


FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{"+": operator.add, "-": operator.sub, "*": operator.mul, "/": np.divide},
    **{"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge},
    **{"==": operator.eq, "!=": operator.ne, "neg": operator.neg, "not": np.logical_not},
    **{
        "abs": np.abs,
        "sign": np.sign,
        "log": np.log,
        "copysign": np.copysign,
    },
    **{"larger": np.maximum, "smaller": np.minimum, "where": np.where, "finite": np.isfinite},
    "known": lambda x: x is not None and not (np.isscalar(x) and x != x),
    "item": lambda x, i: x[i],
    "part": lambda x, low, high: x[low:high],
    "size": len,
    "count": lambda x: int(np.count_nonzero(x)),
    "any": lambda x: bool(np.any(x)),
    "all": lambda x: bool(np.all(x)),
    "when": lambda x, value: _place(x == value),
    "first": _place,
    "last": lambda x: _place(x, last=True),
    "ever": np.logical_or.accumulate,
    "max": lambda x: float(np.max(x, initial=-np.inf)),
    "min": lambda x: float(np.min(x, initial=np.inf)),
    "highest": lambda x: int(np.argmax(x)),
    "sum": lambda x: float(np.sum(x)),
    "mean": lambda x: float(np.mean(x)),
    "median": lambda x: float(np.median(x)),
    "diff": np.diff,
    "beyond": lambda x, ends: (x < ends[0] * (1.0 - ALMOST)) | (x > ends[1] * (1.0 + ALMOST)),
}


class Scope:
    """Names of values, and of expressions that are evaluated once, when they are first needed.

    Parameters
    ----------
    values : numbers, texts and arrays by name
    figures : expressions by name
    outer : where other names stand, and the signals
    signals : (n,) arrays at ``values["time"]`` [s], "part.variable"
    """

    def __init__(
        self,
        values: Mapping[str, Any],
        figures: Mapping[str, Tree],
        outer: "Scope | None" = None,
        signals: Mapping[str, Any] | None = None,
    ) -> None:
        self._values, self._figures, self._outer = dict(values), figures, outer
        self.root: Scope = outer.root if outer else self
        self._signals = signals or {}
        self.warned: set[tuple[str, ...]] = set()

    def __getitem__(self, name: str) -> Any:
        if name not in self._values:
            if name in self._figures:
                self._values[name] = self.evaluated(self._figures[name])
            elif self._outer is not None:
                return self._outer[name]
        return self._values[name]

    def signal(self, name: str) -> Any:
        """Return a signal of the run; Missing: it has none of that name."""
        if self.root._signals.get(name) is None:
            raise Missing(name)
        return np.asarray(self.root._signals[name])

    def evaluated(self, tree: Tree) -> Any:
        """Return what an expression is here."""
        if not isinstance(tree, list):
            return tree
        operation, *args = tree
        match operation:
            case "text":
                return args[0]
            case "name":
                return self[args[0]]
            case "and" | "or":
                return self._joined(operation, args)
            case "if":
                return self.evaluated(args[1 if self.evaluated(args[0]) else 2])
        given = [self.evaluated(x) for x in args]
        match operation:
            case "fill":
                return "".join(given)
            case "signal":
                return self.signal(given[0])
            case "signals":
                return all(self.root._signals.get(name) is not None for name in given)
            case "joined":
                return np.concatenate([self.signal(name) for name in given[0]] or [[]])
            case "pick":
                return np.array([self.signal(name)[given[1]] for name in given[0]])
            case "at":
                return _before(given[0], given[1], self.root["time"])
            case "between":
                return float(np.interp(given[1], self.root["time"], given[0]))
            case "warned":
                return any(said[: len(given)] == tuple(given) for said in self.root.warned)
            case "quantity":
                return tuple(given)
        return FUNCTIONS[operation](*given)

    def _joined(self, operation: str, args: list[Tree]) -> Any:
        """Return what all, or some, of several say; further ones only where it is still open."""
        found: Any = operation == "and"
        join = np.logical_and if operation == "and" else np.logical_or
        for tree in args:
            if np.ndim(found) == 0 and bool(found) != (operation == "and"):
                return found
            found = join(found, self.evaluated(tree))
        return found
