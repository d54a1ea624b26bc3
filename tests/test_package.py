"""The package as a whole: light to import, documented, modules of a readable size."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import singletrack

SOURCE = Path(singletrack.__file__).parent
MODULES = sorted(SOURCE.rglob("*.py"))
HEAVY = ("numpy", "scipy", "matplotlib", "xarray", "pint", "pydantic", "casadi", "control", "rich", "typer", "jax")


def test_import_is_light():
    code = f"import sys, singletrack; print([m for m in {HEAVY} if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_public_names_exist():
    for name in singletrack.__all__:
        assert getattr(singletrack, name) is not None
    assert dir(singletrack) == sorted(singletrack.__all__)
    with pytest.raises(AttributeError, match="no attribute 'coeficients'"):
        _ = singletrack.coeficients


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SOURCE)))
def test_modules_are_documented_and_readable(path):
    text = path.read_text()
    tree = ast.parse(text)
    assert ast.get_docstring(tree), "no module docstring"
    assert text.count("\n") <= 330, "module too long"
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            assert (node.end_lineno or node.lineno) - node.lineno < 75, f"{node.name} needs scrolling"


def test_kernels_never_import_presentation_libraries():
    for layer in ("body", "posture", "linear", "multibody"):
        for path in (SOURCE / layer).glob("*.py"):
            for heavy in ("matplotlib", "rich", "typer", "pint"):
                assert f"import {heavy}" not in path.read_text(), path
