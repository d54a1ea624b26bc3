"""Texts of what a SPACAR file's model does, from plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["motion_text", "statics_text"]

_MOST_FACTORS = 6


def _row(values: Iterable[float]) -> str:
    return " ".join(f"{value:13.6g}" for value in values)


def _table(title: str, rows: Mapping[int, Iterable[float]]) -> list[str]:
    return ["", title, *(f"  {number:5d} {_row(values)}" for number, values in rows.items())]


def motion_text(data: Mapping[str, Any]) -> str:
    """Return the state at the end of a run, and the eigenvalues about it, as a text.

    Parameters
    ----------
    data
        From :func:`singletrack.multibody.spacar.report.report`.

    Examples
    --------
    >>> linear = {"coordinates": ["e 1 1"], "eigenvalues": [[-1.0, 2.0]]}
    >>> print(motion_text({"time": 0.5, "x": {2: [1.0]}, "e": {}, "ed": {}, "edd": {}, "linear": linear}))
    at 0.5 s
    <BLANKLINE>
    coordinates by node
          2             1
    <BLANKLINE>
    eigenvalues of small motions in e 1 1, 1/s
      -1 + 2i
    """
    lines = [f"at {data['time']:g} s"]
    for title, name in (
        ("coordinates by node", "x"),
        ("deformations by element", "e"),
        ("their rates", "ed"),
        ("their accelerations", "edd"),
    ):
        if data[name]:
            lines += _table(title, data[name])
    linear = data["linear"]
    if linear["coordinates"]:
        lines += ["", f"eigenvalues of small motions in {', '.join(linear['coordinates'])}, 1/s"]
        lines += [f"  {re:.6g} {'-' if im < 0 else '+'} {abs(im):.6g}i" for re, im in linear["eigenvalues"]]
    return "\n".join(lines)


def statics_text(data: Mapping[str, Any]) -> str:
    """Return an equilibrium, its frequencies, and buckling factors as a text.

    Parameters
    ----------
    data
        From :func:`singletrack.multibody.spacar.report.statics`.

    Examples
    --------
    >>> print(statics_text({"buckling": {"factors": [2.5], "modes": [[1.0]]}}))
    factors of the loads at which the drawn equilibrium buckles
      2.5
    """
    lines: list[str] = []
    if "x" in data:
        lines += ["equilibrium under the constant loads", *_table("coordinates by node", data["x"])]
        lines += [*_table("deformations by element", data["e"]), *_table("stresses by element", data["stresses"]), ""]
        if data["frequencies"] is None:
            lines += [f"no natural frequencies: {data['no_frequencies']}"]
        elif data["frequencies"]:
            lines += ["natural frequencies, rad/s (negative: unstable, growth in 1/s)"]
            lines += [f"  {value:.6g}" for value in data["frequencies"]]
    if "buckling" in data:
        lines += [""] * bool(lines) + ["factors of the loads at which the drawn equilibrium buckles"]
        lines += [f"  {factor:.6g}" for factor in data["buckling"]["factors"][:_MOST_FACTORS]]
    return "\n".join(lines)
