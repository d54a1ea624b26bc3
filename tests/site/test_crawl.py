"""The built site in a browser, every page: nothing comes from elsewhere, nothing fails, all fits a phone."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from chromium import needs_chromium, start_chromium

if TYPE_CHECKING:
    from collections.abc import Iterator

SITE = Path(__file__).parents[2] / "docs" / "_build" / "html"
PAGES = sorted(path for path in SITE.rglob("*.html") if path.name != "webpack-macros.html")  # a template of the theme

pytestmark = [
    needs_chromium,
    pytest.mark.skipif(not (SITE / "index.html").exists(), reason="the site is not built (make docs builds it)"),
    pytest.mark.slow,
]

#: What a page may ask for: files beside it, and what is written in it.
LOCAL = ("file:", "data:", "blob:", "about:", "chrome:")
READY = """
const done = arguments[0];
const formulas = window.MathJax && window.MathJax.startup ? window.MathJax.startup.promise : Promise.resolve();
formulas.then(() => document.fonts.ready).then(() => done(true));
"""
#: Elements that stick out of the page to the right, but for those within something that scrolls by itself.
WIDE = """
const own = (e) => ["auto", "scroll", "hidden"].includes(getComputedStyle(e).overflowX);
const scrolls = (e) => e && (own(e) || scrolls(e.parentElement));
return [...document.querySelectorAll("main *")]
  .filter((e) => e.getBoundingClientRect().right > window.innerWidth + 1 && !scrolls(e.parentElement))
  .map((e) => e.tagName + " " + e.className).slice(0, 3);
"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    driver = start_chromium("--enable-unsafe-swiftshader")  # the page with the rider in motion
    yield driver
    driver.quit()


def requests_of(browser: Any) -> set[str]:
    """Return what was asked for since the last call."""
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    sockets = [m["params"]["url"] for m in messages if m["method"] == "Network.webSocketCreated"]
    return {*asked, *sockets}


def resized(browser: Any, width: int) -> list[str]:
    """Return what sticks out of the page at a width in pixels, and the page itself where it does."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    page = browser.execute_script("return document.documentElement.scrollWidth")
    return [f"{one} at {width}" for one in browser.execute_script(WIDE)] + [f"page: {page} at {width}"] * (
        page > width + 1
    )


def test_every_page_stands_alone_and_fits(browser: Any) -> None:
    asked: dict[str, list[str]] = {}
    failed: dict[str, list[str]] = {}
    wide: dict[str, list[str]] = {}
    for page in PAGES:
        name = page.relative_to(SITE).as_posix()
        browser.get(page.as_uri())
        browser.execute_async_script(READY)
        if name != "_static/page.html":  # the application has tests of its own
            wide[name] = resized(browser, 1400) + resized(browser, 390)
        asked[name] = [url for url in requests_of(browser) if not url.startswith(LOCAL)]
        failed[name] = [entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
    assert {name: urls for name, urls in asked.items() if urls} == {}
    assert {name: errors for name, errors in failed.items() if errors} == {}
    assert {name: elements for name, elements in wide.items() if elements} == {}


def test_a_request_to_elsewhere_would_be_seen(browser: Any, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_text('<img src="http://127.0.0.1:9/x.png"><main><pre style="width:2000px">x</pre></main>')
    requests_of(browser)
    browser.get(page.as_uri())
    assert "http://127.0.0.1:9/x.png" in requests_of(browser)
    assert browser.get_log("browser")
    assert len(resized(browser, 390)) == 2


def test_formulas_are_set(browser: Any) -> None:
    browser.get((SITE / "theory" / "engine.html").as_uri())
    browser.execute_async_script(READY)
    assert browser.execute_script("return document.querySelectorAll('mjx-container').length") > 20
    assert browser.execute_script("return document.querySelectorAll('mjx-merror').length") == 0
