"""Every public function says what its arguments are, and arrays say their shape."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import cast

import pytest

import singletrack

SOURCE = Path(singletrack.__file__).parent
#: Words that tell the shape of an array: "shape (..., 3)", "(n,)", "(...)", "(2, 2)", "scalar".
SHAPE = re.compile(r"\bshape\b|\bscalar\b|\((?:\.\.\.|[0-9a-z]+,)[^)]*\)|\(\)")
ARRAYS = re.compile(r"\b(Array|ndarray|NDArray|Float|Complex)\b")


def public_functions() -> list[tuple[str, ast.FunctionDef, str]]:
    """Return (name, definition, docstring of its class) of all public functions and methods, in order."""
    found = []
    for path in sorted(SOURCE.rglob("*.py")):
        module = ".".join(path.relative_to(SOURCE).with_suffix("").parts)
        if module.startswith("commands"):  # typer reads its help texts
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        public = next(
            (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign) and _is_all(node)), ()
        )
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and node.name in public:
                found.append((f"{module}.{node.name}", node, ""))
            if isinstance(node, ast.ClassDef) and node.name in public:
                # Overloads tell types alone; the function that follows them has the docstring.
                methods = [part for part in node.body if isinstance(part, ast.FunctionDef) and not _is_overload(part)]
                own = ast.get_docstring(node) or ""
                found += [(f"{module}.{node.name}.{m.name}", m, own) for m in methods if not m.name.startswith("_")]
    return found


def _is_overload(node: ast.FunctionDef) -> bool:
    return any(ast.unparse(decorator) == "overload" for decorator in node.decorator_list)


def _is_all(node: ast.Assign) -> bool:
    return any(isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets)


FUNCTIONS = public_functions()


def undocumented(node: ast.FunctionDef, of_class: str) -> list[str]:
    """Return what a reader misses: arguments that are not named, shapes that are not given."""
    text = ast.get_docstring(node) or ""
    arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    names = [argument.arg for argument in arguments if argument.arg not in {"self", "cls"}]
    missing = [name for name in names if not re.search(rf"\b{re.escape(name)}\b|{name.rstrip('s')}", text)]
    if re.search(r"[Aa]rguments as|[Aa]s for :|[Aa]s in :|Parameters and errors as", text):
        missing = []  # told once, elsewhere
    arrays = [a.arg for a in arguments if a.annotation is not None and ARRAYS.search(ast.unparse(a.annotation))]
    returned = "" if node.returns is None else ast.unparse(node.returns)
    if (arrays or ARRAYS.search(returned)) and not SHAPE.search(text + of_class):
        missing.append("a shape")
    return missing if text else ["a docstring"]


@pytest.mark.parametrize(("name", "node", "of_class"), FUNCTIONS, ids=[name for name, _, _ in FUNCTIONS])
def test_arguments_and_shapes_are_documented(name: str, node: ast.FunctionDef, of_class: str) -> None:
    assert undocumented(node, of_class) == [], name


def test_an_undocumented_argument_or_shape_is_found() -> None:
    told = 'def f(mass: Array) -> Array:\n    """Return the weight (...) of a mass (...)."""'
    untold = 'def f(mass: Array, arm: float) -> Array:\n    """Return the weight of a mass."""'
    silent = "def f(mass): ..."
    first, second, third = (cast("ast.FunctionDef", ast.parse(text).body[0]) for text in (told, untold, silent))
    assert undocumented(first, "") == []
    assert undocumented(second, "") == ["arm", "a shape"]
    assert undocumented(third, "") == ["a docstring"]
