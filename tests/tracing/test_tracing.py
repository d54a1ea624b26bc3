"""Traced programs give what the function gives, to rounding, also away from the inputs at which pivots were chosen."""

from __future__ import annotations

import math
import shutil
import subprocess
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError
from singletrack.tracing import Graph, javascript_function, python_function, trace

jax = pytest.importorskip("jax", reason="programs are traced by JAX, which is not installed")
jnp = jax.numpy
X = np.array([0.7, -1.3, 2.1, 0.4, 1.9, -0.6, 0.3, 1.1, 2.4])


@pytest.fixture(autouse=True)
def _double(monkeypatch: pytest.MonkeyPatch) -> Any:
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", val=True)
    yield
    jax.config.update("jax_enable_x64", before)


def run(function: Any, nominal: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Trace at ``nominal``, run the Python text at ``at``, return all outputs on one axis."""
    graph, outputs = trace(function, nominal)
    names: dict[str, Any] = {"math": math}
    exec(python_function("program", graph, outputs), names)  # noqa: S102  # what this module is about
    found = np.zeros(sum(output.size for output in outputs))
    names["program"](at.tolist(), found)
    return found


FUNCTIONS: dict[str, Any] = {
    "arithmetic": lambda x: (x[0] + x[1] * x[2] - x[3] / x[4], -x[5], x[:3] ** 3, x[2] ** -2, jnp.square(x)),
    "functions": lambda x: jnp.stack([jnp.sin(x), jnp.cos(x), jnp.tan(x), jnp.exp(x), jnp.abs(x), jnp.sign(x)]),
    "roots": lambda x: (jnp.sqrt(x * x + 1), jax.lax.rsqrt(x * x + 1), jnp.log(x * x + 1), jnp.power(x * x, 0.3)),
    "angles": lambda x: (jnp.arctan2(x[0], x[1]), jnp.arctan(x), jnp.arcsin(x / 3), jnp.arccos(x / 3)),
    "choices": lambda x: (jnp.where(x > 0, x, 2 * x), jnp.maximum(x, 0.5), jnp.minimum(x, x[0]), jnp.clip(x, 0, 1)),
    "truths": lambda x: jnp.where(((x >= 1) | (x <= -1)) & (x != 2.1) & ~(x == 0.3) & jnp.isfinite(x), x, 0.0),
    "shapes": lambda x: (x.reshape(3, 3).T, x[::-1], x[jnp.array([2, 0, -1])], jnp.pad(x, 1), jnp.roll(x, 2)),
    "pieces": lambda x: (jnp.concatenate([x[:2], x[5:]]), jnp.broadcast_to(x[:3], (2, 3)), x.at[1].set(5.0)),
    "sums": lambda x: (x.sum(), x.reshape(3, 3).sum(axis=1), x.max(), x.min(), x.prod(), (x > 0).all(), (x > 0).any()),
    "products": lambda x: (x.reshape(3, 3) @ x.reshape(3, 3), jnp.einsum("ij,kj->ik", x.reshape(3, 3), jnp.eye(3))),
    "stacks": lambda x: jnp.matmul(jnp.stack([x.reshape(3, 3)] * 2), x[:3, None]),
    "inverse": lambda x: jnp.linalg.inv(x.reshape(3, 3)),
    "solution": lambda x: jnp.linalg.solve(x.reshape(3, 3), x[:3]),
    "transposed": lambda x: jax.scipy.linalg.solve_triangular(x.reshape(3, 3) + 3 * jnp.eye(3), x[:3], trans=1),
    "compiled": jax.jit(lambda x: jnp.linalg.det(x.reshape(3, 3))),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@settings(max_examples=5, deadline=None)
@given(seed=st.integers(0, 1000))
def test_programs_equal_their_function(name: str, seed: int) -> None:
    function = FUNCTIONS[name]
    at = X * (1 + 0.05 * np.random.default_rng(seed).uniform(-1, 1, X.size))
    expected = function(jnp.asarray(at))
    expected = expected if isinstance(expected, tuple) else (expected,)
    flat = np.concatenate([np.ravel(np.asarray(part, dtype=float)) for part in expected])
    np.testing.assert_allclose(run(function, X, at), flat, rtol=1e-11, atol=1e-13)


def test_nothing_is_computed_twice_or_for_nothing() -> None:
    graph, outputs = trace(lambda x: (x[0] * x[1] + 0.0 * x[2], (x[1] * x[0]) * 1.0, x[3] - 0.0), X)
    assert outputs[0] == outputs[1]
    needed = [graph.nodes[node].operation for node in graph.needed(int(output) for output in outputs)]
    assert sorted(needed) == ["input", "input", "input", "mul"]


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript engine (node) on this machine")
def test_javascript_and_python_give_the_same_numbers() -> None:
    function = FUNCTIONS["solution"]
    graph, outputs = trace(function, X)
    text = javascript_function("program", graph, outputs).replace("export ", "")
    call = f"{text}\nconst o = []; program({X.tolist()}, o); console.log(JSON.stringify(o));"
    printed = subprocess.run(["node", "-e", call], capture_output=True, text=True, check=True).stdout  # noqa: S607
    found = np.array([float(number) for number in printed.strip("[]\n").split(",")])
    np.testing.assert_array_equal(found, run(function, X, X))


def test_what_is_no_scalar_program_is_refused_by_name() -> None:
    with pytest.raises(InputError, match="the operation while cannot be written"):
        trace(lambda x: jax.lax.while_loop(lambda y: y[0] < 3, lambda y: y + 1, x), X)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
def test_simplified_nodes_have_the_value_they_replace(a: float, b: float) -> None:
    graph = Graph()
    x, y = graph.input(a), graph.constant(b)
    for operation, expected in (("add", a + b), ("sub", a - b), ("mul", a * b)):
        assert graph.nodes[graph.apply(operation, x, y)].value == pytest.approx(expected, abs=1e-300)
    assert graph.nodes[graph.apply("sub", x, x)].value == 0.0
    assert graph.apply("neg", graph.apply("neg", x)) == x
