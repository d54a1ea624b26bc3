"""``singletrack design``."""

from __future__ import annotations

import hashlib
import json as jsonlib
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from singletrack.analysis.aims import LowestWeave, StableBetween, TargetMatrices, WidestRange
from singletrack.analysis.effort_aim import LeastEffort
from singletrack.analysis.pareto import Front, pareto_front, worth
from singletrack.analysis.problem import Found, Keep, Problem
from singletrack.analysis.quantities import quantity, quantity_unit
from singletrack.analysis.search import search
from singletrack.body.fit import elbow_angle, fit
from singletrack.commands.model_options import ModelOptions
from singletrack.commands.options import BicycleArgument, JsonOption
from singletrack.commands.printing import deliver, print_json, show
from singletrack.commands.sensitivity import design_from, parse_bounds
from singletrack.commands.writing import check_output, text_of
from singletrack.errors import InputError
from singletrack.files.source import read_text
from singletrack.linear import critical_speeds
from singletrack.model import LinearModel
from singletrack.output import check_writable, write_whole
from singletrack.parameters.steps import step_of
from singletrack.parameters.units import parse_quantity
from singletrack.present.tables import critical_speeds_text, rows_table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.analysis.aims import Aim
    from singletrack.analysis.designs import Design

__all__ = ["run"]

_SMOOTH = 1e-3  # of the aim, per range of a parameter: what is left of the gradient at an optimum
_AIMS = "stable=LOW:HIGH, widest, widest=TOP, weave, effort=SPEED[,SPEED..], or matrices=FILE.json"


def run(
    bicycle: BicycleArgument,
    options: ModelOptions,
    aims: Annotated[
        list[str], typer.Option("--aim", metavar="AIM", help=f"{_AIMS}; two of them: the front between them.")
    ],
    vary: Annotated[
        list[str],
        typer.Option("--vary", metavar="NAME=LOW:HIGH", help="May change so far: trail=20mm:80mm; repeatable."),
    ],
    keep: Annotated[
        list[str] | None,
        typer.Option("--keep", metavar="NAME=LOW:HIGH", help="Stays so, an end may be empty: front_clearance=280mm:."),
    ] = None,
    starts: Annotated[int, typer.Option("--starts", min=1, max=1000, help="Designs to search from.")] = 6,
    points: Annotated[int, typer.Option("--points", min=3, max=99, help="On the front of two aims.")] = 7,
    seed: Annotated[int, typer.Option("--seed", min=0)] = 0,
    state: Annotated[
        Path | None, typer.Option("--state", metavar="FILE", help="Keep what is done here; the same command goes on.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="Write the bicycle found, e.g. found.toml.")
    ] = None,
    json: JsonOption = False,
) -> None:
    """Search a design by aim."""
    for file, check in ((output, check_output), (state, check_writable)):
        if file is not None:
            check(file)
    design = _adapting(design_from(bicycle, options, [text.partition("=")[0].strip() for text in vary]), options)
    goals = [_aim(text) for text in aims]
    if len(goals) > 2:
        raise InputError(f"--aim: found {len(goals)}, must be one or two")
    problem = Problem(design, goals[0], parse_bounds(design, vary, "--vary"), _keeps(design, keep or []))
    asked = (bicycle, *aims, *vary, *(keep or []), repr(options), str(seed))
    if len(goals) == 2:
        if output is not None:
            raise InputError("-o: is for one aim; a front has many designs")
        known, tell = _resumed(state, problem, (*asked, str(points), str(starts)))
        _print_front(problem, goals[1], pareto_front(problem, goals[1], points, starts, seed, tell, known), json=json)
        return
    known, tell = _resumed(state, problem, asked)
    found = search(problem, starts, seed, known, tell)
    best = found[0]
    if output is not None:
        deliver(text_of(problem.at(best.x).bicycle, output), output)
    if json:
        _print_as_json(problem, best, found)
    else:
        _print(problem, best, found)


def _print_as_json(problem: Problem, best: Found, found: Sequence[Found]) -> None:
    own = problem.at(best.x).values()
    parameters = {name: float(own[name]) for name in problem.names}
    ends = {"starts": [one.value for one in found]}
    print_json({"aim": problem.aim.name, "parameters": parameters, **best.to_dict(), **ends})


def _adapting(design: Design, options: ModelOptions) -> Design:
    """Return the design; with ``--fit`` the rider leans so that the elbows stay as bent as they are."""
    if not options.fit or design.rider is None:
        return design
    angle = float(elbow_angle(design.bicycle, design.rider))
    return replace(design, options=replace(design.options, fit=angle))


def _aim(text: str) -> Aim:
    kind, _, value = (part.strip() for part in text.partition("="))
    try:
        if kind == "stable":
            low, high = (parse_quantity(end.strip(), "m/s").value for end in value.split(":"))
            return StableBetween(low, high)
        if kind == "widest":
            return WidestRange(parse_quantity(value, "m/s").value) if value else WidestRange()
        if kind == "weave" and not value:
            return LowestWeave()
        if kind == "effort":
            return LeastEffort(tuple(parse_quantity(v.strip(), "m/s").value for v in value.split(",")))
        if kind == "matrices":
            return TargetMatrices(LinearModel.from_dict(jsonlib.loads(read_text(Path(value)))))
    except InputError as error:
        raise error.at("--aim") from None
    except ValueError:
        raise InputError(f"--aim {text!r}: must be {_AIMS}") from None
    raise InputError(f"--aim {text!r}: must be {_AIMS}")


def _keeps(design: Design, texts: Sequence[str]) -> tuple[Keep, ...]:
    found = []
    for text in texts:
        name, sign, both = (part.strip() for part in text.partition("="))
        ends = both.split(":")
        if not sign or len(ends) != 2 or not any(end.strip() for end in ends):
            raise InputError(f"--keep {text!r}: must be NAME=LOW:HIGH, one end may be empty: front_clearance=280mm:")
        try:
            unit = quantity_unit(design, name)
            low, high = (
                parse_quantity(end.strip(), unit).value if end.strip() else none
                for end, none in zip(ends, (-inf, inf), strict=True)
            )
        except InputError as error:
            raise error.at("--keep") from None
        found.append(Keep(name, low, high))
    return tuple(found)


def _resumed(state: Path | None, problem: Problem, asked: tuple[str, ...]) -> tuple[list[Found], Any]:
    """Return what an earlier run of the same command left, and what to call with each result."""
    if state is None:
        return [], None
    values = {name: np.asarray(value).tolist() for name, value in problem.design.values().items()}
    key = hashlib.sha256(jsonlib.dumps([asked, values], sort_keys=True).encode()).hexdigest()
    known: list[Found] = []
    if state.exists():
        try:
            data = jsonlib.loads(read_text(state))
            rows, theirs = data["found"], data["problem"]
            known = [Found(**row | {"x": np.array(row["x"]), "binding": tuple(row["binding"])}) for row in rows]
        except (ValueError, KeyError, TypeError):
            raise InputError(f"{state}: is no state of a search; give another file, or remove it") from None
        if theirs != key:
            raise InputError(f"{state}: is of another problem; give another file, or remove it")
    done = list(known)

    def tell(one: Found) -> None:
        done.append(one)
        write_whole(state, jsonlib.dumps({"problem": key, "found": [f.to_dict() for f in done]}, indent=1))

    return known, tell


def _print(problem: Problem, best: Found, found: Sequence[Found]) -> None:
    before, after = problem.design, problem.at(best.x)
    rows = []
    for name in (*problem.names, *(keep.name for keep in problem.keeps)):
        step = step_of(quantity_unit(before, name))
        one, two = (float(np.real(quantity(design, name))) * step.factor for design in (before, after))
        rows.append([name, f"{one:.5g}", f"{two:.5g}", f"{two - one:+.4g}", step.unit])
    show(rows_table(f"{before.title}: {problem.aim.name}", ("", "before", "after", "change", "unit"), rows))
    angle = after.options.fit
    if angle is not None and after.rider is not None:
        leans = [np.degrees(float(fit(d.bicycle, after.rider, angle).forward_lean_angle)) for d in (before, after)]
        show(
            f"the rider leans as the grips ask: forward_lean_angle {leans[0]:.2f} deg before, {leans[1]:.2f} deg after"
        )
    was = worth(problem, problem.aim, problem.start)
    same = sum(abs(one.value - best.value) < 1e-4 * max(1.0, abs(best.value)) for one in found)
    show(f"aim: {was:.4g} before, {best.value:.4g} after; {same} of {len(found)} searches end there")
    show("what holds it back: " + ("; ".join(best.binding) or "none of the bounds and constraints"))
    if best.feasible and best.stationary > _SMOOTH * max(1.0, abs(best.value)):
        show("no smooth optimum: roots meet there, or beside it no such design can exist; try more --starts")
    if not best.feasible:
        show("no design keeps all constraints; this one is nearest")
    for word, design in (("before", before), ("after", after)):
        show(f"{word}:", critical_speeds_text(critical_speeds(design.model())))


def _print_front(problem: Problem, other: Aim, front: Front, *, json: bool) -> None:
    designs = [problem.at(x).values() for x in front.x]
    if json:
        points = [{name: float(own[name]) for name in problem.names} for own in designs]
        print_json({"aims": [problem.aim.name, other.name], "values": front.values.tolist(), "parameters": points})
        return
    steps = [step_of(problem.design.unit(name)) for name in problem.names]
    headings = ("first aim", "second aim", *(f"{n} ({s.unit})" for n, s in zip(problem.names, steps, strict=True)))
    factors = {name: step.factor for name, step in zip(problem.names, steps, strict=True)}
    rows = [
        [f"{number:.4g}" for number in (*values, *(float(own[name]) * factors[name] for name in problem.names))]
        for values, own in zip(front.values, designs, strict=True)
    ]
    show(rows_table(f"{problem.design.title}: {problem.aim.name}, against {other.name}", headings, rows))
