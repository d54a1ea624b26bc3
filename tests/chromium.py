"""Chromium, driven: where it is not installed, tests and measurements that need it are skipped with that reason."""

from __future__ import annotations

import shutil
from typing import Any

import pytest

__all__ = ["needs_chromium", "start_chromium"]

webdriver = pytest.importorskip("selenium.webdriver", reason="selenium, which drives the browser, is not installed")
_BROWSER, _DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
needs_chromium = pytest.mark.skipif(
    _BROWSER is None or _DRIVER is None, reason="Chromium and its driver are not installed (.ci/run installs them)"
)


def start_chromium(*arguments: str) -> Any:
    """Return a browser that keeps its log and what it requests; to be quit."""
    options = webdriver.ChromeOptions()
    options.binary_location = _BROWSER
    for argument in ("--headless=new", "--no-sandbox", "--window-size=1400,900", *arguments):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(_DRIVER))
    driver.set_script_timeout(120)
    return driver
