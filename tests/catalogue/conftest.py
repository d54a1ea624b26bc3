"""Cases of the catalogue, estimated once."""

from __future__ import annotations

import functools

import pytest

import catalogue_cases


@pytest.fixture(scope="session")
def case(shared_data):  # skips where the data is absent
    return functools.cache(catalogue_cases.case)
