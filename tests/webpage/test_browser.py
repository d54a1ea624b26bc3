"""The page in a real browser: no requests, no errors, Python's numbers, quick redraws, nothing breaks it."""

from __future__ import annotations

import json
import time

import numpy as np
import pytest

from chromium import needs_chromium, start_chromium
from singletrack import coefficients, load_bicycle, load_rider, page
from singletrack.errors import SingletrackError
from singletrack.parameters import Bicycle
from singletrack.webpage.sheets import page_sheets

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    driver = start_chromium("--enable-unsafe-swiftshader")
    file = page().save(tmp_path_factory.mktemp("page") / "page.html")
    driver.get(file.as_uri())
    driver.execute_script("document.getElementById('play').click()")  # still pictures: the processor is for the tests
    yield driver
    driver.quit()


def test_without_webgl_all_but_the_picture_works(tmp_path):
    driver = start_chromium("--disable-gpu", "--disable-3d-apis")
    try:
        driver.get(page().save(tmp_path / "page.html").as_uri())
        assert "WebGL is off" in driver.find_element("id", "flat").text
        found = json.loads(
            driver.execute_script(
                "window.singletrack.set({speed: 5}); return JSON.stringify(window.singletrack.result())"
            )
        )
        assert found["weave"]
        assert driver.find_elements("css selector", "#controls input[type=range]")
        errors = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert [line for line in errors if "Uncaught" in line] == []
    finally:
        driver.quit()


def ask(browser, changes):
    """Set the page back, make changes, return what it answers."""
    script = "const s = window.singletrack; for (const c of arguments[0]) s.set(c); return JSON.stringify(s.result());"
    browser.execute_script("document.getElementById('reset').click()")
    return json.loads(browser.execute_script(script, changes))


def test_nothing_is_requested_and_nothing_goes_wrong(browser):
    events = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]
    assert [url[:60] for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []


def random_designs(count, seed):
    """Yield designs around the shipped ones, with what Python says of them."""
    random = np.random.default_rng(seed)
    rider = load_rider("rider-a")
    ways = [("", "rigid", None), ("rider-a", "rigid", None), *WAYS]
    for _ in range(count):
        name = str(random.choice(["stratos", "browser"]))
        who, posture, options = ways[random.integers(len(ways))]
        bicycle = load_bicycle(name)
        own = rider.on(bicycle)
        names = [n for n in bicycle.values() if n != "gravity"]
        changed = {n: float(bicycle.values()[n] * (1 + random.uniform(-0.03, 0.03))) for n in names}
        if who:  # with arms that mostly reach
            more = {"rider_mass": (-0.2, 0.2), "torso_length": (-0.03, 0.03), "forward_lean_angle": (-0.03, 0.03)}
            more |= {"upper_arm_length": (0.0, 0.15), "lower_arm_length": (0.0, 0.15)}
            changed |= {n: float(own.values()[n] * (1 + random.uniform(*ends))) for n, ends in more.items()}
        speed = float(random.uniform(0.2, 10))
        changes = [
            {
                "bicycle": name,
                "rider": who,
                "torso_lean": False,
                "posture": posture,
                **(options or {}),
                **changed,
                "speed": speed,
            }
        ]
        riders = {n: v for n, v in changed.items() if n in own.values()}
        person = own.replace(**riders) if who else None
        try:
            model = coefficients(bicycle.replace(**{n: changed[n] for n in names}), person, posture, **(options or {}))
        except SingletrackError:
            yield changes, None, speed
            continue
        yield changes, model, speed


WAYS = [
    ("rider-a", "leaned", {"arms": "straight"}),
    ("rider-a", "leaned", {"arms": "bent"}),
    ("rider-a", "upright", None),
    ("rider-a", "rigid", {"torso_lean": True}),
    ("rider-a", "leaned", {"arms": "straight", "torso_lean": True}),
    ("rider-a", "upright", {"torso_lean": True}),
]


def test_a_thousand_designs_have_pythons_numbers(browser):
    designs = list(random_designs(1000, seed=1))
    script = "return arguments[0].map((c) => (window.singletrack.set(c), JSON.stringify(window.singletrack.result())));"
    answers: list[str] = []
    for start in range(0, len(designs), 100):
        answers += browser.execute_script(script, [changes[0] for changes, _, _ in designs[start : start + 100]])
    compared = 0
    for (changes, model, speed), answer in zip(designs, answers, strict=True):
        found = json.loads(answer)
        if model is None:  # a limb too short, an inertia that no body has
            assert found["message"], changes
            continue
        assert found["message"] == "", (found["message"], changes)
        for name in ("M", "C0", "C1", "S0", "K0", "K2"):
            expected = np.asarray(getattr(model, name))
            np.testing.assert_allclose(found[name], expected, rtol=0, atol=1e-10 * (1 + np.abs(expected).max()))
        modes = model.modes(speed)
        roots = np.array([complex(*root) for root in found["eigenvalues"]])
        np.testing.assert_allclose(roots, modes.eigenvalues[0], rtol=0, atol=1e-9 * (1 + np.abs(roots).max()))
        assert found["modes"] == list(modes.names)
        critical = model.critical_speeds()
        for kind in ("weave", "capsize"):
            np.testing.assert_allclose(found[kind], getattr(critical, kind), rtol=1e-6)
        ranges = [[low, np.inf if high is None else high] for low, high in found["stable_ranges"]]
        np.testing.assert_allclose(np.ravel(ranges), np.ravel(critical.stable_ranges), rtol=1e-6)
        compared += 1
    assert compared > 500


def test_springs_and_dampers_have_pythons_numbers(browser):
    """At the torso's hinge and at the steer, with a torso that leans and without."""
    random = np.random.default_rng(3)
    ways = [("leaned", "stratos", True), ("rigid", "stratos", True), ("upright", "browser", True)]
    for posture, name, torso in [*ways, ("upright", "browser", False)]:
        joints = ["steer", "torso lean"] if torso else ["steer"]
        for _ in range(8):
            springs = {joint: float(random.uniform(0, 900 if joint == "torso lean" else 20)) for joint in joints}
            dampers = {joint: float(random.uniform(0, 60 if joint == "torso lean" else 3)) for joint in joints}
            changes = {f"spring at {joint}": value for joint, value in springs.items()}
            changes |= {f"damper at {joint}": value for joint, value in dampers.items()}
            base = {"bicycle": name, "rider": "rider-a", "posture": posture, "torso_lean": torso, "speed": 4.5}
            found = ask(browser, [base, changes])
            assert found["message"] == ""
            bicycle, options = load_bicycle(name), {"torso_lean": torso, "springs": springs, "dampers": dampers}
            rider = load_rider("rider-a").on(bicycle)
            model = coefficients(bicycle, rider, posture, **options)
            for matrix in ("M", "C0", "C1", "S0", "K0", "K2"):
                expected = np.asarray(getattr(model, matrix))
                np.testing.assert_allclose(found[matrix], expected, atol=1e-10 * (1 + np.abs(expected).max()))
            modes = model.modes(4.5)
            roots = np.array([complex(*root) for root in found["eigenvalues"]])
            np.testing.assert_allclose(roots, modes.eigenvalues[0], atol=1e-8 * (1 + np.abs(roots).max()))
            assert found["modes"] == list(modes.names)
            ranges = [[low, np.inf if high is None else high] for low, high in found["stable_ranges"]]
            np.testing.assert_allclose(np.ravel(ranges), np.ravel(model.critical_speeds().stable_ranges), rtol=1e-6)


def test_a_negative_spring_is_refused(browser):
    base = {"bicycle": "stratos", "rider": "rider-a", "posture": "leaned", "torso_lean": True}
    found = ask(browser, [base, {"spring at torso lean": -5}])
    assert "spring at torso lean = -5" in found["message"]


def random_sheets(count, seed):
    """Yield kinds of handlebar and entries around what the page's sheets begin at."""
    random = np.random.default_rng(seed)
    for k in range(count):
        sheet = page_sheets()[k % len(page_sheets())]
        names = random.choice(list(sheet.inputs), size=8, replace=False)
        yield sheet, {str(n): float(sheet.inputs[n] * (1 + random.uniform(-0.04, 0.04))) for n in names}


def test_sheets_make_pythons_bicycles(browser):
    """All parameters to 1e-12, and the matrices with a rider on it."""
    rider = load_rider("rider-a").replace(forward_lean_angle=np.radians(78.0))
    seen = 0
    for sheet, entries in random_sheets(24, seed=5):
        browser.execute_script("window.singletrack.set({rider: ''})")
        base = {"bar": sheet.bar, **{f"sheet.{name}": value for name, value in entries.items()}}
        found = ask(browser, [{"rider": ""}, base])
        assert found["message"] == ""
        made = sheet.expected.parameters({**sheet.inputs, **entries})
        expected = {name: float(made[name]) for name in sheet.outputs}
        own = {name: value for name, value in found["parameters"].items() if name in expected}
        assert own == pytest.approx(expected, abs=1e-12)
        model = coefficients(Bicycle(**expected))
        np.testing.assert_allclose(found["M"], model.M, atol=1e-10)
        np.testing.assert_allclose(found["K0"], model.K0, atol=1e-9)
        arms = {"upper_arm_length": 0.34, "lower_arm_length": 0.36, "upper_leg_length": 0.5, "lower_leg_length": 0.5}
        seated = {"rider": "rider-a", "posture": "leaned", "arms": "straight", "torso_lean": False}
        seated |= {"forward_lean_angle": np.radians(65.0), **arms}
        found = json.loads(
            browser.execute_script(
                "window.singletrack.set(arguments[0]); return JSON.stringify(window.singletrack.result())", seated
            )
        )
        if found["message"]:
            assert "too short" in found["message"]
            continue
        seen += 1
        person = rider.replace(forward_lean_angle=np.radians(65.0), **arms)
        model = coefficients(Bicycle(**expected), person, "leaned")
        np.testing.assert_allclose(found["M"], model.M, atol=1e-9)
        np.testing.assert_allclose(found["K0"], model.K0, atol=1e-8)
    assert seen > 8


def test_the_form_of_a_sheet_answers_and_its_address_brings_it_back(browser):
    browser.execute_script("window.singletrack.set({rider: ''})")
    ask(browser, [{"bicycle": "browser"}])
    script = """
      const type = (id, text) => {
        const field = document.getElementById(id);
        field.value = text;
        field.dispatchEvent(new Event("change"));
      };
      type("sheet-bar", "drop");
      type("sheet-head_angle", "71.5");
      type("sheet-chain_stay_length", "430");
      type("sheet-front-tyre", "32-622");
      return JSON.stringify(window.singletrack.result());
    """
    found = json.loads(browser.execute_script(script))
    sheet = next(sheet for sheet in page_sheets() if sheet.bar == "drop")
    entries = {"head_angle": np.radians(71.5), "chain_stay_length": 0.43, "front tyre width": 0.032}
    made = sheet.expected.parameters({**sheet.inputs, **entries})
    expected = {name: float(made[name]) for name in sheet.outputs}
    assert {n: found["parameters"][n] for n in expected} == pytest.approx(expected, abs=1e-12)
    assert browser.execute_script("return document.getElementById('bicycle').value") == "geometry sheet"
    address = browser.current_url
    browser.execute_script("window.singletrack.undo()")
    browser.get("about:blank")
    browser.get(address)
    again = json.loads(browser.execute_script("return JSON.stringify(window.singletrack.result())"))
    assert again["parameters"] == found["parameters"]
    browser.execute_script("document.getElementById('play').click()")


def test_a_rider_whom_a_sheet_does_not_fit_is_put_aside(browser):
    base = {"bicycle": "stratos", "rider": "rider-a", "posture": "leaned"}
    found = ask(browser, [base, {"bar": "flat", "sheet.stem_length": 0.13, "sheet.stack": 0.55}])
    assert "arms are too short" in found["message"]
    assert "shown without rider" in found["message"]
    shown = [browser.execute_script(f"return document.getElementById('{name}').value") for name in ("bicycle", "rider")]
    assert shown == ["geometry sheet", ""]


def test_a_sheet_that_makes_no_frame_is_said_and_the_last_design_stays(browser):
    before = ask(browser, [{"rider": ""}, {"bar": "city"}])
    found = ask(browser, [{"rider": ""}, {"bar": "city"}, {"sheet.chain_stay_length": 0.03}])
    assert "lengths do not meet" in found["message"]
    assert found["parameters"] == before["parameters"]
    script = "const f = document.getElementById('sheet-front-tyre'); f.value = 'wide';"
    script += "f.dispatchEvent(new Event('change')); return f.validationMessage"
    assert browser.execute_script(script) == "width and bead diameter in mm, as 37-622"


def test_every_control_answers(browser):
    script = """
      const done = [];
      for (const input of document.querySelectorAll("#controls input[type=range]")) {
        if (input.closest(".control").hidden) continue;
        const before = JSON.stringify(window.singletrack.result().parameters);
        input.value = String((Number(input.value) * 3 + Number(input.max)) / 4);
        input.dispatchEvent(new Event("input"));
        const result = window.singletrack.result();
        done.push([input.id, JSON.stringify(result.parameters) !== before || result.message !== ""]);
      }
      return done;
    """
    ask(browser, [{"bicycle": "stratos", "rider": "rider-a"}, {"posture": "leaned"}])
    done = browser.execute_script(script)
    assert len(done) > 10
    assert [name for name, moved in done if not moved] == []


def test_curves_are_drawn_whatever_was_done_just_before(browser):
    """A plot that is made and changed at once still shows weave: blue pixels on its canvas."""
    script = """
      const done = arguments[0];
      window.singletrack.set({ bicycle: "browser", rider: "rider-a", posture: "upright", torso_lean: true });
      document.getElementById("pin").click();
      window.singletrack.set({ trail: 0.03 });
      setTimeout(() => {
        const canvas = document.querySelector("#chart canvas");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let blue = 0;
        for (let k = 0; k < data.length; k += 4)
          if (data[k] < 40 && Math.abs(data[k + 1] - 0x72) < 40 && data[k + 2] > 140 && data[k + 3] > 200) blue++;
        done(blue);
      }, 300);
    """
    assert browser.execute_async_script(script) > 300


def test_what_cannot_be_is_said_and_the_last_design_stays(browser):
    ask(browser, [{"bicycle": "stratos", "rider": "rider-a"}, {"posture": "leaned"}])
    before = ask(browser, [])
    found = json.loads(
        browser.execute_script(
            "window.singletrack.set({upper_arm_length: 0.1}); return JSON.stringify(window.singletrack.result())"
        )
    )
    assert "arms are too short" in found["message"]
    assert found["parameters"] == before["parameters"]
    assert "arms are too short" in browser.execute_script("return document.getElementById('message').textContent")


def test_undo_and_the_address_bring_a_design_back(browser):
    first = ask(browser, [{"bicycle": "browser", "rider": "rider-a"}, {"posture": "upright"}, {"trail": 0.05}])
    address = browser.current_url
    ask(browser, [{"bicycle": "benchmark", "rider": ""}])
    browser.execute_script("window.singletrack.undo(); window.singletrack.undo();")
    assert json.loads(browser.execute_script("return JSON.stringify(window.singletrack.result())"))["parameters"]
    browser.get("about:blank")
    browser.get(address)
    again = json.loads(browser.execute_script("return JSON.stringify(window.singletrack.result())"))
    assert (again["parameters"], again["M"]) == (first["parameters"], first["M"])
    browser.execute_script("document.getElementById('play').click()")


def test_two_thousand_random_states_never_break_it(browser):
    script = """
      let seed = 7;
      const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
      const pick = (items) => items[Math.floor(random() * items.length)];
      const errors = [];
      addEventListener("error", (event) => errors.push(event.message));
      for (let k = 0; k < 2000; k++) {
        const select = pick([...document.querySelectorAll("header select")]);
        if (random() < 0.15 && select.options.length) {
          select.value = pick([...select.options]).value;
          select.dispatchEvent(new Event("change"));
        } else if (random() < 0.1) {
          const name = pick(["trail", "speed", "nonsense", "rider_mass"]);
          window.singletrack.set({ [name]: pick([NaN, -1, 1e300, "x", null]) });
        } else {
          const input = pick([...document.querySelectorAll("#controls input[type=range], #speed")]);
          input.value = String(Number(input.min) + random() * (Number(input.max) - Number(input.min)));
          input.dispatchEvent(new Event("input"));
        }
        const result = window.singletrack.result();
        const numbers = [...result.M.flat(), ...result.K0.flat(), ...result.eigenvalues.flat()];
        if (!numbers.every(Number.isFinite)) errors.push(JSON.stringify(result.parameters));
        if (Math.abs(Number(document.getElementById("speed").value) - Math.min(result.speed, 10)) > 0.051)
          errors.push("stale speed");
        if (document.getElementById("message").textContent !== result.message) errors.push("stale message");
      }
      return errors;
    """
    ask(browser, [{"bicycle": "stratos", "rider": "rider-a"}])
    started = time.monotonic()
    assert browser.execute_script(script) == []
    assert time.monotonic() - started < 120  # a hang would end here; not a measurement
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []


def test_names_from_files_stay_text(browser, tmp_path):
    evil = '<img src=x onerror="window.evil=1"></script><script>window.evil=1</script>'
    file = page(load_bicycle("benchmark").replace(name=evil, description=evil)).save(tmp_path / "evil.html")
    browser.get(file.as_uri())
    assert browser.execute_script("return [window.evil, document.getElementById('bicycle').value]") == [None, evil]
