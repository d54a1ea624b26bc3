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

    def then_along(self, axis, distance):
        """First slide along an axis fixed in the undisplaced body, then displace."""
        return Placed(self.turn, self.turn * (distance * axis) + self.shift)


class ExactRider:
    """The moving segments of a seated rider, displaced exactly for a steer angle, relative to the rear frame."""

    def __init__(self, bicycle, posture):
        self.tilt = mp.mpf(float(bicycle.steer_axis_tilt))
        self.foot = vec([bicycle.wheel_base + bicycle.trail, 0, 0])
        self.axis = mp.matrix([mp.sin(self.tilt), 0, mp.cos(self.tilt)])
        self.posture = posture
        self.joints = [(j.name, j.parent, vec(j.point), vec(j.axis), j.slides) for j in posture.joints]
        self.free = [k for k, joint in enumerate(posture.joints) if joint.free]

    def front(self, steer):
        return Placed().then_about(self.axis, self.foot, steer)

    def links(self, angles):
        links = {"": Placed()}
        for (name, parent, point, axis, slides), angle in zip(self.joints, angles, strict=True):
            unit = axis / mp.norm(axis)
            moved = links[parent].then_along(unit, angle) if slides else links[parent].then_about(unit, point, angle)
            links[name] = moved
        return links

    def gap(self, angles, steer):
        links = self.links(angles) | {"handlebar": self.front(steer)}
        gaps = []
        for loop in self.posture.loops:
            near, far = links[loop.joint], links[loop.to]
            if loop.directions is None:
                gaps += list(near(vec(loop.point)) - far(vec(loop.point)))
            else:
                one, other = (vec(direction) for direction in loop.directions)
                # Directions in double precision are perpendicular to 16 digits only: they keep the angle they have.
                gaps.append((near.turn * one).T * (far.turn * other) - one.T * other)
        return [gap[0] if isinstance(gap, mp.matrix) else gap for gap in gaps]

    def angles(self, steer, *free):
        """Joint angles that keep the loops closed (Newton, to the last digit), with the free ones as given."""
        dependent = [k for k in range(len(self.joints)) if k not in self.free]
        angles = [mp.mpf(0)] * len(self.joints)
        for k, angle in zip(self.free, free or [mp.mpf(0)] * len(self.free), strict=True):
            angles[k] = angle
        if not dependent:
            return angles

        def function(*found):
            for k, angle in zip(dependent, found, strict=True):
                angles[k] = angle
            return self.gap(angles, steer)

        start = mp.zeros(len(dependent), 1)
        found = mp.findroot(function, list(start), tol=mp.mpf(10) ** -60, maxsteps=40)
        for k, angle in zip(dependent, list(found) if len(dependent) > 1 else [found], strict=True):
            angles[k] = angle[0] if isinstance(angle, mp.matrix) else angle
        return angles

    def placed(self, steer, *free):
        """The displacement of every segment."""
        links = self.links(self.angles(steer, *free))
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

    def height(self, lean, steer, *free):
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
            placed = self.rider.placed(steer, *free)
            masses += [(s.mass, placed[n], vec(s.centre)) for n, s in self.rider.posture.segments.items()]
        return -sum(mp.mpf(float(mass)) * frame(part(centre))[2] for mass, part, centre in masses)

    def yaw_rate(self):
        """Yaw for a unit of steer at rest: the material of the front wheel at the ground must not slip sideways."""
        contact = vec([self.bicycle.wheel_base, 0, 0])
        return -cross(self.axis, contact - self.foot)[1] / contact[0]

    def velocities(self, rates):
        """Mass, inertia, velocity and spin of every body at rest for rates of lean, steer and free joints."""
        h = mp.mpf(10) ** -18

        def at(sign):
            lean, steer, *free = (sign * h * mp.mpf(rate) for rate in rates)
            turn = rotation(Z, self.yaw_rate() * steer) * rotation(X, lean)
            front = Placed().then_about(self.axis, self.foot, steer)
            placed = self.rider.placed(steer, *free) if self.rider is not None else {}
            return Placed(turn), {"rear": Placed(), "front": front} | placed

        ahead, behind = at(1), at(-1)
        for mass, where, centre, inertia in self.bodies():
            move, turn = (
                [frame(part[where](centre)) for frame, part in (ahead, behind)],
                [frame.turn * part[where].turn for frame, part in (ahead, behind)],
            )
            spin = (turn[0] - turn[1]) / (2 * h)
            yield mass, inertia, (move[0] - move[1]) / (2 * h), mp.matrix([spin[2, 1], spin[0, 2], spin[1, 0]])

    def bodies(self):
        """Mass, what it moves with, centre and central inertia of every body."""
        b = self.bicycle
        for end, x in (("rear", 0.0), ("front", b.wheel_base)):
            radius = getattr(b, f"{end}_wheel_radius")
            xx, yy = (float(getattr(b, f"{end}_wheel_inertia_{axes}")) for axes in ("xx", "yy"))
            yield getattr(b, f"{end}_wheel_mass"), end, vec([x, 0, -radius]), mp.diag([xx, yy, xx])
            xx, yy, zz, xz = (float(getattr(b, f"{end}_frame_inertia_{axes}")) for axes in ("xx", "yy", "zz", "xz"))
            inertia = mp.matrix([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]])
            centre = vec([getattr(b, f"{end}_frame_x"), 0, getattr(b, f"{end}_frame_z")])
            yield getattr(b, f"{end}_frame_mass"), end, centre, inertia
        if self.rider is not None:
            for name, s in self.rider.posture.segments.items():
                yield s.mass, name, vec(s.centre), mp.matrix([[float(v) for v in row] for row in s.inertia])

    def twice_kinetic_energy(self, rates):
        """Twice the kinetic energy at zero speed for rates of lean, steer and free joints."""
        total = mp.mpf(0)
        for mass, inertia, velocity, spin in self.velocities(rates):
            total += mp.mpf(float(mass)) * (velocity.T * velocity)[0] + (spin.T * inertia * spin)[0]
        return total
