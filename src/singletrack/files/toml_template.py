"""Our own files to fill in, with what each number is and where it is measured."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

from singletrack.files.toml_write import unit_text
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import ALLOWED

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.record import Parameter
    from singletrack.parameters.rider import Rider

__all__ = ["template_of"]

#: Optional parameters that most files do without; their lines are comments.
_SELDOM = (
    *("elbow_drop_angle", "torso_thickness", "torso_width", "handlebar_width", "handlebar_drop"),
    *("rear_tyre_radius", "front_tyre_radius"),
    *("frame_torsion_stiffness", "frame_torsion_damping", "frame_hinge_x", "frame_hinge_z", "frame_hinge_tilt"),
    *("fork_bending_stiffness", "fork_bending_damping", "fork_hinge_x", "fork_hinge_z", "fork_hinge_tilt"),
)

_BICYCLE_SKETCH = r"""
               saddle           g-----s
                ---                    \
                  \                     \        s-g  handlebar_length, horizontally; g is the grip,
                   t---------------------h            positive where g is behind s, negative in front
                    \                  /  \     h-s  stem_length, along the steer axis; h is level with t
                     \              /      c    c-f  fork_length, straight; c is the crown, on the steer axis
        .-----.       \          /    .----\.   b-t  seat_tube_length, leaning by seat_tube_angle from the ground
      /         \      \      /     /       \ \  t-saddle  seat_post_length, along the same line
     |     r-----------------b      |    f   \ | r-b  chain_stay_length
      \     |   /           |        \   |    /\ b-ground  bottom_bracket_height
    ____`-----'_____________|__________`-----'___\_____ ground
           |                           |          |
           |<------- wheel_base ------>|<-trail-->|   the steer axis meets the ground ahead of the contact

    Wheel radius: hub to ground, under load (distance rolled in n turns / (2 pi n)).
    x points forward and z points down, from the rear contact: heights of centres of mass are negative.
    seat_tube_angle is from the ground (some 70 deg), steer_axis_tilt from the vertical (some 18 deg).
"""

_RIDER_SKETCH = r"""
              ___
             (   )  head_circumference, around the forehead
              \_/
        o------+------o   shoulder_to_shoulder, joint to joint
       /|             |\
      / |    chest    | \  upper_arm_length, shoulder to elbow; circumference at the middle
     o  | circumference| o
      \ |             | /  lower_arm_length, elbow to the grip in the closed hand
       \|             |/
        |  torso_length    hip joints to shoulder joints, along the back
        o------+------o    hip_joint_to_hip_joint
        |             |
        |             |    upper_leg_length, hip to knee; circumference at the middle
        o             o
        |             |    lower_leg_length, knee to the pedal under the foot
        o             o
    forward_lean_angle: the torso from the horizontal (upright: 90 deg), on the bicycle.
"""


def template_of(cls: type[Bicycle | Rider]) -> str:
    """Return a file to fill in: replace each question mark by a number.

    Parameters
    ----------
    cls : type
        :class:`Bicycle` or :class:`Rider`.

    Examples
    --------
    >>> print(template_of(Bicycle).splitlines()[-1])
    # handlebar_drop = "? m" # optional, hhb: grips below the stem top (negative: above); else none; a finite number
    """
    kind = cls.kind
    sketch = _BICYCLE_SKETCH if cls is Bicycle else _RIDER_SKETCH
    lines = [
        f"# A {kind} for singletrack. Replace each ? by a number; the unit may be another one of the same kind (mm,",
        '# in, lb). A standard deviation may follow: "0.0563 +/- 0.0017 m". Delete optional lines you cannot fill.',
        "#",
        *(f"# {line}".rstrip() for line in sketch.strip("\n").splitlines()),
        "",
        f'kind = "{kind}"',
        'name = ""',
        'description = ""',
        'source = "" # who measured it, when, how',
        "",
        "[parameters]",
        *_parameter_lines(cls.descriptions()),
    ]
    return "\n".join(lines) + "\n"


def _parameter_lines(descriptions: dict[str, Parameter]) -> Iterator[str]:
    for number, (group, members) in enumerate(itertools.groupby(descriptions.items(), key=lambda item: item[1].group)):
        if number:
            yield ""
        yield f"# {group}"
        for name, p in members:
            example = "9.81" if name == "gravity" else "?"
            text = f'"{example} {unit_text(p.unit)}"' if p.unit else f'"{example}"'
            note = "optional, " if p.optional else ""
            if name == "forward_lean_angle":
                yield f'# On several bicycles, by name: {name} = {{ stratos = "63.9 deg", browser = "82.9 deg" }}'
            seldom = "# " if name in _SELDOM else ""
            yield f"{seldom}{name} = {text} # {note}{p.symbol}: {p.meaning}; {ALLOWED[p.allowed][0]}"
