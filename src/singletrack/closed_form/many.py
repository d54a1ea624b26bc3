"""Many designs by their structure's program, and the doubtful ones among them by the equations for arrays.

The program's statements run on arrays of some thousand designs, or compiled (:mod:`.compiled`): the same operations in
the same order, hence the same bits. What is not plainly sound is computed again by the equations for arrays, which know
every fault by name. Which way a design goes depends on that design alone.
"""

from __future__ import annotations

import dataclasses
from functools import cache
from importlib.util import find_spec
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import Fault, stretches
from singletrack.arrays.tape import WORDS, record
from singletrack.closed_form.programs import MATRICES, program_of, values_of
from singletrack.closed_form.round_tyres import on_round_tyres
from singletrack.closed_form.single import NAMES
from singletrack.closed_form.soundness import is_definite, sits
from singletrack.model import LinearModel
from singletrack.parameters.part import part_of_record
from singletrack.posture import STEER, TORSO_LEAN, Margins

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.arrays import Array, Number
    from singletrack.arrays.tape import Tape
    from singletrack.closed_form.programs import Program
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["many_designs", "use_compiled"]

#: Designs whose thousand scalars stay in the processor's cache together.
_BLOCK = 1536
#: Designs after which a program is recorded to be replayed.
_WORTH_RECORDING = 20_000
#: Designs after which a program is compiled, where numba is installed: by then it pays.
_WORTH_COMPILING = 3_000_000
#: The meaning of a program's words for arrays.
_OF_ARRAYS = {
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "where": np.where,
    "maximum": np.maximum,
    "abs": np.abs,
}


class _Kernels:
    """How many designs each program has computed, and those that have been compiled."""

    computed: dict[str, int] = {}  # noqa: RUF012  # one for the process
    compiled: dict[str, Any] = {}  # noqa: RUF012


def use_compiled(program: Program) -> bool:
    """Compile a program now, for long work; return whether that could be done. Both ways give the same bits.

    Parameters
    ----------
    program : Program
    """
    if program.name not in _Kernels.compiled and find_spec("numba") is not None:
        from singletrack.closed_form.compiled import compiled_program  # lazy: heavy, optional

        _Kernels.compiled[program.name] = compiled_program(program)
    return program.name in _Kernels.compiled


def many_designs(
    by_arrays: Callable[[Bicycle, Rider | None, Options], LinearModel],
    bicycle: Bicycle,
    rider: Rider | None,
    options: Options,
) -> LinearModel:
    """Return the model of designs on one axis, by a program where their structure has one.

    Parameters
    ----------
    by_arrays : callable
        Makes the model by the equations for arrays.
    bicycle, rider, options
        N designs.
    """
    no_rider = options.posture == "rigid" and not options.torso_lean and options.fit is None
    program = program_of(bicycle, rider, options) if rider is not None or no_rider else None
    values = None if program is None else _values(program, bicycle, rider)
    laws = None if program is None else _laws(options, program.freedoms)
    if program is None or values is None or laws is None or not any(map(np.ndim, values)):
        return by_arrays(bicycle, rider, options)
    with np.errstate(all="ignore"):  # what is out of range is doubtful
        found = _run(program, values)
        n = program.freedoms
        size = len(MATRICES) * n * n
        seated = None if rider is None else Margins(*found[size + 2 :])
        sound = np.isfinite(found.sum(axis=0)) & is_definite(found, n)
        if rider is not None and seated is not None:
            sound &= sits(seated, rider)
            sound &= _leans(_lean(program, values))
        M, C1, K0, K2 = (found[k * n * n : (k + 1) * n * n].reshape(n, n, -1).transpose(2, 0, 1) for k in range(4))
        names, (C0, S0) = NAMES[n], laws
        model = LinearModel(M, C1, K0, K2, bicycle.gravity, C0=C0, S0=S0, coordinates=names[0], inputs=names[1])
        model = on_round_tyres(model, bicycle, None if rider is None else (found[size], found[size + 1]))
    if sound.all():
        return model
    doubtful = np.flatnonzero(~sound)
    # Two at least: NumPy adds up a single design in another order.
    again = np.resize(doubtful, max(2, len(doubtful)))
    shape = sound.shape
    of_rider = None if rider is None else part_of_record(rider, again, shape)
    return _with(
        model, by_arrays(part_of_record(bicycle, again, shape), of_rider, options.part(again, shape)), doubtful
    )


def _run(program: Program, values: tuple[Number, ...]) -> Array:
    """Return the entries (rows, N) that a program makes of values, arrays (N,) or numbers."""
    (count,) = np.broadcast_shapes(*map(np.shape, values))
    computed = _Kernels.computed[program.name] = _Kernels.computed.get(program.name, 0) + count
    if computed > _WORTH_COMPILING:
        use_compiled(program)
    compiled = _Kernels.compiled.get(program.name)
    if compiled is not None:
        result: Array = compiled(values, count)
        return result
    varied = sum(isinstance(value, np.ndarray) for value in values)
    # What does not vary is computed once, without a tape.
    taped = computed > _WORTH_RECORDING and 2 * varied > len(values)
    function, found = _tape(program).run if taped else _function(program), None
    for block in stretches(count, count if taped else _BLOCK):
        entries = function(*(value[block] if isinstance(value, np.ndarray) else np.float64(value) for value in values))
        if found is None:
            found = np.empty((len(entries), count))
        for row, entry in zip(found, entries, strict=True):
            row[block] = entry
    assert found is not None  # noqa: S101  # there is one block at least
    return found


@cache
def _function(program: Program) -> Callable[..., tuple[Number, ...]]:
    return program.function(_OF_ARRAYS)


@cache
def _tape(program: Program) -> Tape:
    return record(program.function(WORDS), len(program.of_bicycle) + len(program.of_rider))


def _values(program: Program, bicycle: Bicycle, rider: Rider | None) -> tuple[Number, ...] | None:
    """Return the values that a program takes, None if one is missing or complex."""
    found = values_of(program, bicycle, rider)
    if any(value is None or np.asarray(value).dtype.kind != "f" for value in found):
        return None
    return found


def _lean(program: Program, values: tuple[Number, ...]) -> Number:
    return values[len(program.of_bicycle) + program.of_rider.index("forward_lean_angle")]


def _leans(lean: Number) -> Array:
    """Tell whether a forward lean angle is between 0 and 90 degrees."""
    return np.asarray((lean > 0) & (lean < pi / 2))


def _laws(options: Options, freedoms: int) -> tuple[Array, Array] | None:
    """Return C0 and S0 of springs and dampers on the steer or the torso's lean; None for others."""
    found: list[Array] = []
    for amounts in (options.dampers, options.springs):
        total = np.zeros((freedoms, freedoms))
        for name, amount in amounts.items():
            place = 1 if name == STEER else 2
            if name not in (STEER, TORSO_LEAN) or place >= freedoms or np.asarray(amount).dtype.kind not in "fiu":
                return None
            law = np.zeros((*np.shape(amount), freedoms, freedoms))
            law[..., place, place] = amount
            total = total + law
        found.append(total)
    return found[0], found[1]


def _with(model: LinearModel, others: LinearModel, which: np.ndarray) -> LinearModel:
    """Return a model of designs (N,) of which some are replaced by the first of others, with their faults."""
    changed: Any = {}
    for name in (*MATRICES, "C0", "S0"):
        whole, new = getattr(model, name), np.asarray(getattr(others, name))
        if whole.ndim > 2 and name in MATRICES:
            whole[which] = new[: len(which)] if new.ndim > 2 else new
            changed[name] = whole
    faults = []
    for fault in others.faults:
        bad = np.zeros(len(model.M), dtype=bool)
        bad[which] = np.broadcast_to(fault.bad, (max(2, len(which)),))[: len(which)]
        values = {}
        for key, value in fault.values.items():
            some = np.broadcast_to(np.asarray(value), (max(2, len(which)),))[: len(which)]
            values[key] = np.zeros(len(bad), dtype=some.dtype)
            values[key][which] = some
        faults.append(Fault(bad, fault.text, values, fault.error, fault.parameters, fault.allowed))
    return dataclasses.replace(model, **changed, faults=tuple(faults))
