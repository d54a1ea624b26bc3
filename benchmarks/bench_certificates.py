"""What a proof costs: a certificate against the same critical speeds in doubles, as ratios in one run.

Run with ``make benchmark`` or ``pytest benchmarks/bench_certificates.py --benchmark-enable -n 0``.
"""

from __future__ import annotations

from typing import Any

import pytest

from singletrack import closed_form, load_bicycle, load_rider
from singletrack.certify import certify_design
from singletrack.linear import critical_speeds
from singletrack.posture import Options


@pytest.mark.parametrize("posture", ["rigid", "leaned", "upright"])
def test_a_certificate_of_a_program_that_is_traced(compare: Any, posture: str) -> None:
    bicycle, rider, options = load_bicycle("browser"), load_rider("rider-a"), Options(posture)
    ratio = compare(
        lambda: certify_design(bicycle, rider, options),
        lambda: critical_speeds(closed_form.coefficients(bicycle, rider.on(bicycle), options)),
        names=(f"certificate, {posture}", "critical speeds in doubles"),
    )
    assert ratio > 0
