"""The way to certificates: optional libraries, loaded where one is asked for."""

from __future__ import annotations

import importlib
from importlib.util import find_spec
from typing import Any

from singletrack.errors import InputError, install_hint

__all__ = ["certifier"]


def certifier() -> Any:
    """Return the room of certificates.

    Raises
    ------
    InputError
        If a library that it needs is not installed.
    """
    missing = [name for name, module in (("python-flint", "flint"), ("jax", "jax")) if find_spec(module) is None]
    if missing:
        raise InputError(f"certificates need {' and '.join(missing)}: {install_hint('certify')}")
    return importlib.import_module("singletrack.certify")
