"""The house: no import within a function without a reason, no circle, nothing that needs scrolling.

import-linter keeps the layers; here is what it does not see.
"""

from __future__ import annotations

import ast
import re
import statistics
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import singletrack

SOURCE = Path(singletrack.__file__).parent
PATHS = sorted(SOURCE.rglob("*.py"))
TREES = {path: ast.parse(path.read_text(encoding="utf-8")) for path in PATHS}

#: Packages that may be imported where they are used: optional, or slow to import and seldom needed.
HEAVY = {
    "SALib": "optional: global sensitivity",
    "control": "slow: only where a system of it is asked for",
    "dask": "optional: sweeps on several machines",
    "distributed": "optional: sweeps on several machines",
    "flint": "optional: exact arithmetic",
    "jax": "optional: arrays of JAX",
    "matplotlib": "slow: only where something is drawn",
    "numba": "optional: compiled kernels",
    "pint": "slow: only where a unit is converted",
    "pymoo": "optional: design by several aims",
    "scipy": "slow: only where something is integrated, fitted or solved",
    "xarray": "slow: only where a labelled result is asked for",
    "yaml": "slow: only where a parameter set is read",
    "yeadon": "optional: riders by 95 measurements",
    "zarr": "optional: stores of sweeps",
}
#: Everything else that is imported within a function: module, what, why.
DOORS = {
    ("singletrack", "importlib"): "public names are loaded on first use: `import singletrack` stays light",
    ("singletrack.linear.eigenvalues", "singletrack.linear.jax_pencil"): "needs jax",
    ("singletrack.linear.eigenvalues", "singletrack.linear.quartic.jax"): "needs jax",
    ("singletrack.closed_form.many", "singletrack.closed_form.compiled"): "needs numba",
    ("singletrack.linear.quartic.solve", "singletrack.linear.quartic.compiled"): "needs numba",
    ("singletrack.sweep.reading", "singletrack.sweep.checked_zarr"): "needs zarr",
}


def name_of(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


NAMES = {name_of(path) for path in PATHS}


def is_type_checking(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")


def imports(node: ast.AST, within: bool = False, typing: bool = True):
    """Yield (import statement, whether within a function), with or without those for type checkers."""
    for child in ast.iter_child_nodes(node):
        if is_type_checking(child) and not typing:
            continue
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child, within
        inside = within or isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        yield from imports(child, inside, typing)


def targets(statement: ast.Import | ast.ImportFrom, resolve: bool = True) -> list[str]:
    """Return the modules that a statement imports; of ``from a import b`` the module a.b if there is one, else a."""
    if isinstance(statement, ast.Import):
        return [alias.name for alias in statement.names]
    base = statement.module or ""
    if not resolve:
        return [base]
    return [f"{base}.{alias.name}" if f"{base}.{alias.name}" in NAMES else base for alias in statement.names]


def imports_within_functions() -> set[tuple[str, str]]:
    return {
        (name_of(path), target)
        for path, tree in TREES.items()
        for statement, within in imports(tree)
        for target in targets(statement, resolve=False)
        if within and target.partition(".")[0] not in HEAVY
    }


def test_imports_within_functions_have_a_reason():
    without = imports_within_functions() - set(DOORS)
    assert without == set(), "import at the top of the module, or say why not in DOORS"


def test_no_import_circle_even_within_functions_and_for_type_checkers():
    graph: dict[str, set[str]] = {}
    for path, tree in TREES.items():
        module = name_of(path)
        graph[module] = {
            target
            for statement, _ in imports(tree)
            for target in targets(statement)
            if target in NAMES and not module.startswith(f"{target}.") and target != module
        }
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"an import circle: {' -> '.join(error.args[1])}")


#: Rooms that compute: what is presented is given, their records are known to type checkers only.
COMPUTING = ("analysis", "body", "closed_form", "library", "linear", "measuring", "multibody", "posture", "public")


def test_present_computes_nothing():
    for path in (path for path in PATHS if path.is_relative_to(SOURCE / "present")):
        for statement, _ in imports(TREES[path], typing=False):
            rooms = {target.split(".")[1] for target in targets(statement) if target.startswith("singletrack.")}
            assert not rooms & set(COMPUTING), (path.name, ast.unparse(statement))


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_nothing_needs_scrolling(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 300
    for node in ast.walk(TREES[path]):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            assert length_without_docstring(node) <= 50, node.name


def length_without_docstring(node: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    length = (node.end_lineno or node.lineno) - node.lineno + 1
    first = node.body[0]
    if ast.get_docstring(node) is not None:
        length -= (first.end_lineno or first.lineno) - first.lineno + 1
    return length


def test_modules_are_short():
    lengths = [len(path.read_text(encoding="utf-8").splitlines()) for path in PATHS]
    assert statistics.median(lengths) < 150


def test_the_page_on_the_house_names_every_room_and_only_what_is_there():
    text = (Path(__file__).parent.parent / "docs" / "architecture.md").read_text(encoding="utf-8")
    rooms = [path.name for path in SOURCE.iterdir() if path.is_dir() and path.name not in {"__pycache__", "data"}]
    assert [room for room in rooms if f"`{room}/`" not in text] == []
    named = [name for name in re.findall(r"`([a-z_/]+(?:/|\.py))`", text) if name.count("/") - name.endswith("/")]
    there = [SOURCE, SOURCE / "multibody", SOURCE.parent.parent]
    assert [name for name in named if not any((folder / name).exists() for folder in there)] == []
    assert len(named) > 15
