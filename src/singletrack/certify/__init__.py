"""Certificates: which speeds are stable, proven by ball arithmetic for exact parameters or intervals of them."""

from singletrack.certify.asking import (
    certify_design,
    certify_matrices,
    design_problem,
    eigenvalue_balls,
    matrices_problem,
)
from singletrack.certify.balls import Ball
from singletrack.certify.certificate import MOST_BOXES
from singletrack.certify.counting import Sides
from singletrack.certify.record import Certificate, CertifiedCrossing, CertifiedRange, Eigenvalue

__all__ = [
    "MOST_BOXES",
    "Ball",
    "Certificate",
    "CertifiedCrossing",
    "CertifiedRange",
    "Eigenvalue",
    "Sides",
    "certify_design",
    "certify_matrices",
    "design_problem",
    "eigenvalue_balls",
    "matrices_problem",
]
