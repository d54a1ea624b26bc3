"""An independent, fully nonlinear geometry of bicycle and rider, for tests only.

Nothing here knows of first or second orders, of μ or κ: the bicycle stands on the ground with a lean and a steer
angle, its pitch is found so that both wheels touch, each arm's joint angles are found so that the hand is on its grip.
Numbers are mpmath's with 40 digits, so that differences give derivatives to more digits than double precision has.
"""

from __future__ import annotations

import mpmath as mp

mp.mp.dps = 40
X, Y, Z = (mp.matrix([1, 0, 0]), mp.matrix([0, 1, 0]), mp.matrix([0, 0, 1]))


def vec(values):
    return mp.matrix([mp.mpf(float(value)) for value in values])


def cross(a, b):
    return mp.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def rotation(axis, angle):
    """Rodrigues' formula."""
    k = mp.matrix([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return mp.eye(3) + mp.sin(angle) * k + (1 - mp.cos(angle)) * (k * k)


class Placed:
    """A rigid displacement: x -> R x + t."""

    def __init__(self, turn=None, shift=None):
        self.turn = mp.eye(3) if turn is None else turn
        self.shift = mp.zeros(3, 1) if shift is None else shift

    def __call__(self, point):
        return self.turn * point + self.shift

    def then_about(self, axis, point, angle):
        """First turn about an axis fixed in the undisplaced body, then displace."""
        turn = rotation(axis, angle)
        return Placed(self.turn * turn, self.turn * (point - turn * point) + self.shift)


class ExactRider:
    """The moving segments of a seated rider, displaced exactly for a steer angle, relative to the rear frame."""

    def __init__(self, bicycle, posture):
        self.tilt = mp.mpf(float(bicycle.steer_axis_tilt))
        self.foot = vec([bicycle.wheel_base + bicycle.trail, 0, 0])
        self.axis = mp.matrix([mp.sin(self.tilt), 0, mp.cos(self.tilt)])
        self.posture = posture
        self.joints = [(j.name, j.parent, vec(j.point), vec(j.axis)) for j in posture.joints]

    def front(self, steer):
        return Placed().then_about(self.axis, self.foot, steer)

    def links(self, angles):
        links = {"": Placed()}
        for (name, parent, point, axis), angle in zip(self.joints, angles, strict=True):
            links[name] = links[parent].then_about(axis / mp.norm(axis), point, angle)
        return links

    def gap(self, angles, steer):
        links, front = self.links(angles), self.front(steer)
        return [
            component
            for loop in self.posture.loops
            for component in links[loop.joint](vec(loop.point)) - front(vec(loop.point))
        ]

    def angles(self, steer):
        """Joint angles that keep the hands on the grips (Newton, to the last digit)."""
        if not self.joints:
            return []
        function = lambda *angles: self.gap(angles, steer)  # noqa: E731  # mpmath counts the arguments
        start = mp.zeros(len(self.joints), 1)
        return list(mp.findroot(function, list(start), tol=mp.mpf(10) ** -60, maxsteps=40))

    def placed(self, steer):
        """The displacement of every segment."""
        links = self.links(self.angles(steer))
        carried = self.posture.carried_by
        return {name: links[carried.get(name, "")] for name in self.posture.segments}


class ExactBicycle:
    """Height of every mass above the ground, for any lean and steer."""

    def __init__(self, bicycle, posture=None):
        b = self.bicycle = bicycle
        self.rider = ExactRider(bicycle, posture) if posture is not None else None
        tilt = mp.mpf(float(b.steer_axis_tilt))
        self.foot = vec([b.wheel_base + b.trail, 0, 0])
        self.axis = mp.matrix([mp.sin(tilt), 0, mp.cos(tilt)])
        self.rear_hub, self.front_hub = vec([0, 0, -b.rear_wheel_radius]), vec([b.wheel_base, 0, -b.front_wheel_radius])

    def placement(self, lean, steer):
        """Displacement of the rear frame, yaw aside, with both wheels on the ground (z = 0)."""
        front = Placed().then_about(self.axis, self.foot, steer)

        def at(pitch):
            turn = rotation(X, lean) * rotation(Y, pitch)
            frame = Placed(turn, mp.zeros(3, 1))
            drop = self.lowest(frame, Placed(), self.rear_hub, self.bicycle.rear_wheel_radius)
            return Placed(turn, mp.matrix([0, 0, -drop]))

        def front_gap(pitch):
            return self.lowest(at(pitch), front, self.front_hub, self.bicycle.front_wheel_radius)

        pitch = mp.findroot(front_gap, mp.mpf(0), tol=mp.mpf(10) ** -60) if lean or steer else mp.mpf(0)
        return at(pitch), front

    @staticmethod
    def lowest(frame, part, hub, radius):
        """z of the lowest point of a wheel: the centre plus the radius times the sine of the axle's slope."""
        axle = frame.turn * (part.turn * Y)
        return frame(part(hub))[2] + mp.mpf(float(radius)) * mp.sqrt(1 - axle[2] ** 2)

    def height(self, lean, steer):
        """Sum of mass times height above the ground."""
        b = self.bicycle
        frame, front = self.placement(lean, steer)
        masses = [
            (b.rear_wheel_mass, Placed(), self.rear_hub),
            (b.rear_frame_mass, Placed(), vec([b.rear_frame_x, 0, b.rear_frame_z])),
            (b.front_frame_mass, front, vec([b.front_frame_x, 0, b.front_frame_z])),
            (b.front_wheel_mass, front, self.front_hub),
        ]
        if self.rider is not None:
            placed = self.rider.placed(steer)
            masses += [(s.mass, placed[n], vec(s.centre)) for n, s in self.rider.posture.segments.items()]
        return -sum(mp.mpf(float(mass)) * frame(part(centre))[2] for mass, part, centre in masses)
