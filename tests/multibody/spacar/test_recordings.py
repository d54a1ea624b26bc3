"""Accelerations and stresses equal those that the program itself recorded, to all digits.

From a recording of the bicycle robot (RickDW/bikey, public repository, bikey/bicycle.sbd at commit b08d692): the
deformations (6, 1), (11, 1), (14, 1), (16, 1), their rates and accelerations at four moments, and stresses at the
first, of a fall from rest with a lean torque of 1 N m on the rider. The rider's damper was not active.
"""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import spacar

KEYS = ((6, 1), (11, 1), (14, 1), (16, 1))

#: e, ed, edd.
RECORDED = [
    (
        (-0.06130257403812746, 0.00012079504526523206, 0.017885773129269374, 0.23469449223446914),
        (-2.9700912913245574, 0.011644586376598251, 0.8661494341182744, 11.464155197807688),
        (-70.42941055242238, 0.8335112123461678, 20.51636254523302, 287.4824869046502),
    ),
    (
        (-1.5688556903374855, -0.09122160223688164, 0.5042681714240789, 13.359120718964785),
        (-6.5006970604594, -2.4731988591964695, 7.410817552136097, 82.43468709998803),
        (289.02650921904, 12.801696612899441, -286.27740475263334, -587.1099339959717),
    ),
    (
        (-2.813022310290446, -1.2765648322590561, 1.4781425566987627, 29.950142040448082),
        (-12.183817086956168, -6.574578586137333, 8.74662054238896, 118.0467305076009),
        (135.08557107277946, 633.4096486003197, 419.5821801423472, 1651.7134595667128),
    ),
    (
        (-2.880557042295858, -1.3022528903240178, 1.5201769651077788, 30.580754958275875),
        (-16.999596762058427, -4.845167499090018, 4.279307836076568, 130.8077377797126),
        (-2830.776056358852, -1158.1956430566506, -4329.004355285818, 3076.740554862764),
    ),
]

#: Front (10) and rear (12) wheel at the first moment, with kinematic coordinates (9, 1) and (15, 1).
KINEMATIC = {(9, 1): 0.0005493444484563968, (15, 1): -0.004665227736023735}
STRESSES = {
    6: (-0.0, -0.612932337303873, 0.9303783157126623),
    10: (
        -27.190488592354527,
        -2.5978154582623643,
        -27.19260952460388,
        -9.341987171396652e-16,
        -0.026590893895121218,
        25.755198093920086,
    ),
    12: (
        -38.385800155380366,
        -4.725870016452876,
        -38.29513916104731,
        -5.190732894192909e-19,
        0.28053671275788805,
        54.11637239988344,
    ),
    4: (1.9837283984359944, 0.7970052903942229, 0.1886638276414331),
}


@pytest.mark.parametrize(("e", "ed", "edd"), RECORDED)
def test_accelerations(robot, e, ed, edd):
    undamped = spacar.read_text(robot.replace("edamp 16 1\n", ""))
    found = undamped.accelerations(dict(zip(KEYS, e, strict=True)), dict(zip(KEYS, ed, strict=True)), {(16, 1): 1.0})
    np.testing.assert_allclose([found[key] for key in KEYS], edd, rtol=1e-10)


def test_the_damper_is_active_here(robot):
    e, ed, edd = RECORDED[0]
    forces = {(16, 1): 1.0 + ed[3]}  # 1 N m s/rad
    damped = spacar.read_text(robot).accelerations(
        dict(zip(KEYS, e, strict=True)), dict(zip(KEYS, ed, strict=True)), forces
    )
    np.testing.assert_allclose([damped[key] for key in KEYS], edd, rtol=1e-10)


def test_stresses(robot):
    model = spacar.read_text(robot.replace("edamp 16 1\n", ""))
    e, ed, _ = RECORDED[0]
    state = model.state(dict(zip(KEYS, e, strict=True)) | KINEMATIC, dict(zip(KEYS, ed, strict=True)))
    found = model.by_element(model.motion(state, {(16, 1): 1.0}).stresses)
    for element, stresses in STRESSES.items():
        np.testing.assert_allclose(found[element], stresses, rtol=1e-9, atol=1e-9)
