"""The frame's geometry from a sheet: what follows from what, what contradicts, what is typical."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import is_concrete
from singletrack.catalogue.knowledge import Geometry, known_if
from singletrack.catalogue.sheet import tyre_size
from singletrack.catalogue.tables import bars
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.catalogue.sheet import Sheet

__all__ = ["Geometry", "resolve"]

#: A loaded tyre is lower by this share of its height (Berto's drop, in Heine, Optimizing Your Tire Pressure for Your
#: Weight, Bicycle Quarterly). Sizes by ETRTO are those of ISO 5775.
_TYRE_DROP = 0.15
#: Share of the sample that may be no bicycle.
_BROKEN = 0.01
_RIGHT = np.pi / 2


def resolve(sheet: Sheet, normal: Callable[[], np.ndarray], xp: Any = np, lost: float = _BROKEN) -> Geometry:
    """Return the geometry that follows from a sheet.

    Parameters
    ----------
    sheet : Sheet
    normal : function
        Returns an array of shape (n,) of standard normal numbers, the first of which is 0.
    xp : namespace
        Of the arrays, NumPy or JAX. Entries of the sheet may be arrays of shape (n,), complex for derivatives.
    lost : float
        Share of the sample that may be no bicycle.

    Raises
    ------
    InputError
        With all contradictions (both values, and where each comes from), or what is missing.
    """
    found = Geometry(sheet, normal, xp)
    for end in ("rear", "front"):
        _wheel(found, end)
    _steering(found)
    _rear_triangle(found)
    _wheel_base(found)
    _head_tube(found)
    _seat(found)
    _grips(found)
    for name in ("front_hub_width", "rear_hub_width", "gravity"):
        found.values[name] = found.typical(name)
    if found.contradictions:
        raise InputError.of_all(found.contradictions)
    for name, values in found.values.items():
        if not is_concrete(values):
            continue
        broken = ~np.isfinite(values)
        if (broken[0] and lost == _BROKEN) or broken.mean() > lost:
            reason = (
                "no such triangle, the lengths given do not meet" if broken[0] else "is too uncertain to be a bicycle's"
            )
            raise InputError(f"{name}: {reason}", parameters=[name])
    return found


def _wheel(found: Geometry, end: str) -> None:
    texts, name = found.sheet.texts, f"{end}_wheel_radius"
    text: Any = texts.get(f"{end}_wheel_size", texts.get("wheel_size"))
    given = found.given(name)
    if text is None and given is None:
        other = f"{'front' if end == 'rear' else 'rear'}_wheel_radius"
        given = found.given(other)
        if given is None or texts:
            raise InputError(
                f'the sheet needs wheel_size (as "37-622", on the tyre) or {name}', parameters=["wheel_size", name]
            )
    if text is None and given is not None:
        width = found.xp.maximum(found.drawn(0.037, 0.006), 0.018)
        bead = given - (1 - _TYRE_DROP) * width
        radius, found.notes[name] = given, "given"
    else:
        size, diameter = tyre_size(str(text)) if isinstance(text, str) else text
        width, bead = found.drawn(size, 0.04 * size), found.drawn(diameter / 2, 0.0)
        told = f"tyre {text}: half the bead, and the tyre's height less {_TYRE_DROP:.0%} under load"
        computed = bead + (1 - _TYRE_DROP) * width
        chosen = found.choose(name, [(given, "given"), (computed, told)], 0.015)
        radius = computed if chosen is None else chosen
    found.values |= {name: radius, f"{end} tyre width": width, f"{end} bead": bead}


def _steering(found: Geometry) -> None:
    radius, xp = found.values["front_wheel_radius"], found.xp
    offset, trail = found.given("fork_offset"), found.given("trail")
    tilt = found.choose(
        "steer_axis_tilt",
        [
            (found.given("steer_axis_tilt"), "given"),
            (known_if(lambda a: _RIGHT - a, found.given("head_angle")), "90 deg - head_angle"),
        ],
        0.002,
    )
    if tilt is None:
        tilt = known_if(lambda c, d: xp.arcsin(d / xp.sqrt(radius**2 + c**2)) + xp.arctan(c / radius), trail, offset)
        if tilt is None:
            missing = ("head_angle", "steer_axis_tilt")
            raise InputError("the sheet needs head_angle (or trail and fork_offset, both)", parameters=missing)
        found.notes["steer_axis_tilt"] = "from trail, fork_offset and front wheel radius"
    told = "from steer axis, fork_offset and front wheel radius: (r sin(tilt) - offset) / cos(tilt)"

    def from_offset(ahead: np.ndarray) -> np.ndarray:
        trails: np.ndarray = (radius * xp.sin(tilt) - ahead) / xp.cos(tilt)
        return trails

    chosen = found.choose("trail", [(trail, "given"), (known_if(from_offset, offset), told)], 0.004)
    if chosen is None:
        chosen = from_offset(found.typical("fork_offset"))
        found.notes["trail"] = f"fork_offset {found.notes['fork_offset']}"
    found.values |= {"steer_axis_tilt": tilt, "trail": chosen}


def _rear_triangle(found: Geometry) -> None:
    rear = found.values["rear_wheel_radius"]
    from_drop = known_if(lambda drop: rear - drop, found.given("bottom_bracket_drop"))
    ways = [(found.given("bottom_bracket_height"), "given"), (from_drop, "rear wheel radius - bottom_bracket_drop")]
    height = found.choose("bottom_bracket_height", ways, 0.005)
    if height is None:
        height = rear - found.typical("bottom_bracket_drop")
        found.notes["bottom_bracket_height"] = f"bottom_bracket_drop {found.notes['bottom_bracket_drop']}"
    stay = found.typical("chain_stay_length")
    with np.errstate(invalid="ignore"):
        bracket = found.xp.sqrt(stay**2 - (rear - height) ** 2)
    found.values |= {"bottom_bracket_height": height, "chain_stay_length": stay, "bracket x": bracket}


def _wheel_base(found: Geometry) -> None:
    v = found.values
    bracket, height, tilt, trail = v["bracket x"], v["bottom_bracket_height"], v["steer_axis_tilt"], v["trail"]
    drop = height - v["front_wheel_radius"]
    from_centre = known_if(lambda centre: bracket + found.xp.sqrt(centre**2 - drop**2), found.given("front_centre"))
    stack, reach = found.given("stack"), found.given("reach")
    from_head = known_if(lambda s, r: bracket + r + (height + s) * found.xp.tan(tilt) - trail, stack, reach)
    base = found.choose(
        "wheel_base",
        [
            (found.given("wheel_base"), "given"),
            (from_centre, "from front_centre, chain stay and bottom bracket"),
            (from_head, "from stack, reach, steer axis, trail and chain stay"),
        ],
        0.008,
    )
    if base is None:
        raise InputError(
            "the sheet needs wheel_base (or front_centre, or stack and reach)",
            parameters=["wheel_base", "front_centre"],
        )
    v["wheel_base"] = base


def _head_tube(found: Geometry) -> None:
    v, xp = found.values, found.xp
    sin, cos = xp.sin(v["steer_axis_tilt"]), xp.cos(v["steer_axis_tilt"])
    radius, offset = v["front_wheel_radius"], v["front_wheel_radius"] * sin - v["trail"] * cos
    height = v["bottom_bracket_height"]
    axis = v["wheel_base"] + v["trail"]
    from_reach = known_if(
        lambda reach: (axis - v["bracket x"] - reach) * cos / xp.maximum(sin, 1e-3) - height, found.given("reach")
    )
    stack = found.choose("stack", [(found.given("stack"), "given"), (from_reach, "from reach and steer axis")], 0.03)
    top = height + (found.typical("stack") if stack is None else stack)
    # Along the steer axis, from the foot of the front hub's normal to it.
    along_top = (top - radius + offset * sin) / cos
    head = found.given("head_tube_length")
    from_stack = known_if(lambda length, _: xp.sqrt((along_top - length - 0.012) ** 2 + offset**2), head, stack)
    length = found.choose(
        "fork_length", [(found.given("fork_length"), "given"), (from_stack, "from stack and head_tube_length")], 0.02
    )
    if length is None:
        length = found.typical("fork_length", radius / 0.342)
    with np.errstate(invalid="ignore"):
        along = xp.sqrt(length**2 - offset**2)
    # A head tube is 90 mm long at least: where stack is only typical, the frame is as high as the fork needs it.
    along_top = xp.maximum(along_top, along + 0.09) if stack is None else along_top
    top = radius - offset * sin + along_top * cos
    v |= {"fork_length": length, "fork offset": offset, "crown along": along, "head top": top}


def _seat(found: Geometry) -> None:
    xp = found.xp
    tube, saddle = found.typical("seat_tube_length"), found.given("saddle_height")
    if saddle is None:
        saddle = xp.maximum(found.typical("saddle_height"), tube + 0.06)
    else:
        found.notes["saddle_height"] = "given"
        if found.given("seat_tube_length") is None:
            tube = xp.minimum(tube, saddle - 0.06)
    if is_concrete(saddle) and saddle[0] <= tube[0]:
        given = (
            f"saddle_height = {saddle[0]:.4f} m is not above the seat tube's end, seat_tube_length = {tube[0]:.4f} m"
        )
        found.contradictions.append(InputError(given, parameters=["saddle_height", "seat_tube_length"]))
    from_setback = known_if(lambda back: xp.arccos(_within(xp, back / saddle)), found.given("saddle_setback"))
    ways = [(from_setback, "from saddle_setback and saddle_height"), (found.given("seat_tube_angle"), "given")]
    angle = found.choose("seat_tube_angle", ways, 0.08)
    angle = found.typical("seat_tube_angle") if angle is None else angle
    found.notes["seat_post_length"] = "saddle_height - seat_tube_length; saddle_height " + found.notes["saddle_height"]
    found.values |= {"seat_tube_length": tube, "seat_tube_angle": angle, "seat_post_length": saddle - tube}


def _grips(found: Geometry) -> None:
    v, xp = found.values, found.xp
    sin, cos = xp.sin(v["steer_axis_tilt"]), xp.cos(v["steer_axis_tilt"])
    axis = v["wheel_base"] + v["trail"]
    bar = bars()[found.sheet.texts.get("bar", "any")]
    bar_values = {}
    for name, (mean, deviation) in bar.items():
        given = found.given(name)
        bar_values[name] = found.drawn(mean, deviation) if given is None else given
    stem, rise = found.typical("stem_length"), found.typical("stem_angle")
    steerer = v["head top"] + (found.typical("spacers") + 0.035) * cos
    up, forward = xp.sin(rise), xp.cos(rise)
    clamp = steerer + stem * (forward * sin + up * cos)
    clamp_x = axis - steerer * xp.tan(v["steer_axis_tilt"]) + stem * (forward * cos - up * sin)
    height, x = found.given("grip_height"), found.given("grip_x")
    told = "from stem, spacers and bar" if height is None else "from grip_height and grip_x"
    height = clamp + bar_values["bar_rise"] if height is None else height
    x = clamp_x - bar_values["bar_sweep"] if x is None else x
    seat_top = v["bottom_bracket_height"] + v["seat_tube_length"] * xp.sin(v["seat_tube_angle"])
    # The skeleton's stem goes up along the steer axis from the level of the seat tube's end to that of the grips.
    up_axis = (height - seat_top) / cos
    drop = xp.where(up_axis < 0.02, 0.02 - up_axis, 0.0) * cos
    v["stem_length"] = xp.maximum(up_axis, 0.02)
    v["handlebar_length"] = axis - (height + drop) * xp.tan(v["steer_axis_tilt"]) - x
    v["grip drop"] = drop
    if not is_concrete(drop) or drop[0] > 0:
        v["handlebar_drop"] = drop
    if "bar_width" in found.sheet.values:
        v["handlebar_width"] = bar_values["bar_width"] - 0.10
    v |= {"grip x": x, "grip height": height, "bar width": bar_values["bar_width"]}
    v |= {"steerer": steerer, "clamp x": clamp_x, "clamp height": clamp}
    if "bar" not in found.sheet.texts:  # the clamp is somewhere between steer axis and grips
        middle = axis - height * xp.tan(v["steer_axis_tilt"])
        v |= {"clamp x": (middle + xp.maximum(clamp_x, x)) / 2, "clamp height": height - bar_values["bar_rise"]}
        v["steerer"] = xp.minimum(steerer, xp.maximum(v["head top"], v["clamp height"]))
    found.notes |= {"stem_length": told, "handlebar_length": told, "handlebar_drop": told}
    found.notes["handlebar_width"] = "bar_width - 0.10 m, between the middles of the hands"


def _within(xp: Any, cosine: Any) -> Any:
    """Return a cosine, cut to what an angle can have (maximum and minimum keep a complex step, clip does not)."""
    return xp.minimum(xp.maximum(cosine, -1.0), 1.0)
