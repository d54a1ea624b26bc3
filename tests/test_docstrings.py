"""Every public function says what its arguments are, arrays say their shape, numbers their unit."""

from __future__ import annotations

import ast
import contextlib
import functools
import importlib
import inspect
import re
import runpy
from pathlib import Path
from typing import cast

import pytest

import singletrack

SOURCE = Path(singletrack.__file__).parent
#: Words that tell the shape of an array: "shape (..., 3)", "(n,)", "(...)", "(2, 2)", "scalar".
SHAPE = re.compile(r"\bshape\b|\bscalar\b|\((?:\.\.\.|[0-9a-z]+,)[^)]*\)|\(\)")
#: Words that tell the unit of a number, or that it has none.
UNIT = re.compile(
    r"(?<![\w.])(?:(?:1/)?(?:m|mm|kg|s|rad|deg|N|J|W|Hz|SI|Pa)|[kc]?m/(?:s|h))(?![\w'])|µs|%"
    r"|(?i:\b(?:units?|dimensionless|ratio|fractions?|shares?|probability|relative|inch(?:es)?|pixels|points|indices|counts?"
    r"|digits|number of|seed|true|tell whether|mask)\b)"
)
SHAPES = re.compile(r"shape \([^)]*\)|\(\w+,\)")  # a length of m is no metre
NUMBERS = re.compile(r"\b(Array|ArrayLike|Number|ndarray|NDArray|Float|Complex|float|complex)\b")
ARRAYS = re.compile(r"\b(Array|ndarray|NDArray|Float|Complex)\b")


@functools.cache
def api() -> set[str]:
    """Return the names that the pages of the API tell (docs/_ext): of those each number has to say its unit."""
    pages = runpy.run_path(str(Path(__file__).parents[1] / "docs" / "_ext" / "api_pages.py"))
    return cast("set[str]", pages["public_names"]())


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


def entries(text: str) -> dict[str, str]:
    """Return what the section on parameters says of each."""
    section = re.search(r"^Parameters\n-+\n(.*?)(?=^\w[\w ]*\n-+\n|\Z)", text, re.DOTALL | re.MULTILINE)
    told: dict[str, str] = {}
    names: list[str] = []
    for line in section[1].splitlines() if section else []:
        if line and not line.startswith(" "):
            heading, _, kind = line.partition(":")
            names = [name.strip().lstrip("*") for name in heading.split(",")]
            told |= dict.fromkeys(names, kind)
        else:
            told |= {name: f"{told[name]} {line.strip()}" for name in names}
    return told


def without_unit(node: ast.FunctionDef, of_class: str) -> list[str]:
    """Return numbers, arguments or the result, of which no unit is told: in their entry, or in the first words."""
    text = SHAPES.sub("", (ast.get_docstring(node) or "").partition("\nExamples\n")[0])
    if re.search(r"[Aa]rguments as|[Aa]s for :|[Aa]s in :|Parameters and errors as", text):
        return []  # told once, elsewhere
    first, told = text.partition("\nParameters\n")[0], entries(text)
    arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    numbers = [a.arg for a in arguments if a.annotation is not None and NUMBERS.search(ast.unparse(a.annotation))]
    missing = [name for name in numbers if not UNIT.search(told.get(name, "")) and not UNIT.search(first)]
    returned = node.returns is not None and NUMBERS.search(ast.unparse(node.returns))
    return missing + ["result"] * bool(returned and not UNIT.search(text + of_class.partition("\nExamples\n")[0]))


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


def test_units_are_documented() -> None:
    """All of the API at once: a thousand tests more would take longer than what they test."""
    told = api()
    public = [one for one in FUNCTIONS if {f"singletrack.{one[0]}", f"singletrack.{one[0]}".rpartition(".")[0]} & told]
    assert len(public) > 300
    missing = {name: without_unit(node, of_class) for name, node, of_class in public}
    assert {name: numbers for name, numbers in missing.items() if numbers} == {}


def test_a_missing_unit_is_found() -> None:
    words = "Return a speed (m/s).\n\n    Parameters\n    ----------\n    radius : float, shape (m,)\n        In m."
    told = f'def f(radius: float) -> float:\n    """{words}\n    """'
    untold = told.replace(" (m/s)", "").replace("In m.", "Of it.")
    other = told.replace(" (m/s)", "").replace("radius: float", "radius: float, mass: float")
    first, second, third = (cast("ast.FunctionDef", ast.parse(text).body[0]) for text in (told, untold, other))
    assert without_unit(first, "") == []
    assert without_unit(second, "") == ["radius", "result"]
    assert without_unit(second, "All in SI units.") == ["radius"]
    assert without_unit(third, "") == ["mass"]


def test_no_part_of_the_api_is_undocumented() -> None:
    """What the pages tell is documented, classes included; functions are looked at one by one above."""
    silent = [name for name in sorted(api()) if not (inspect.getdoc(_thing(name)) or "").strip()]
    assert silent == []


def _thing(name: str) -> object:
    parts = name.split(".")
    for depth in range(len(parts) - 1, 0, -1):
        with contextlib.suppress(ImportError):
            found: object = importlib.import_module(".".join(parts[:depth]))
            return functools.reduce(getattr, parts[depth:], found)
    raise AssertionError(name)
