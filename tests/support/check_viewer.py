#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the pages of a run in headless Chromium, uses them as a person would, and looks at what is drawn.

    tests/support/check_viewer.py TALUS OUT        a run of hostile_names.toml, and the program for one to watch

Skipped where Debian's chromium, chromium-driver and python3-selenium are not installed.
Exit codes: 0 all is well or skipped, 1 it is not.
"""
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select
except ImportError:
    webdriver = None

ROOT = Path(__file__).resolve().parents[2]
SCENE = Path(__file__).with_name("hostile_names.toml")
PATIENCE = 120  # s; only a machine that stands still takes so long
SIZES = {"phone": (390, 844), "laptop": (1366, 768), "large": (1920, 1080)}


class Browser:
    """Chromium without a window, and what its page draws, asks for and complains of."""

    def __init__(self, folder):
        self.folder = Path(folder)
        options = webdriver.ChromeOptions()
        for argument in ("--headless=new", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox",
                         "--hide-scrollbars", f"--user-data-dir={folder}/profile"):
            options.add_argument(argument)
        options.binary_location = shutil.which("chromium")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
        self.driver = webdriver.Chrome(service=service, options=options)
        self.driver.set_script_timeout(PATIENCE)
        self.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})
        self.resize("laptop")
        self.driver.get("about:blank")
        self.driver.get_log("performance")  # of the page that the browser starts with

    def resize(self, name):
        width, height = SIZES[name]
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": name == "phone"})

    def open(self, address):
        self.driver.get("about:blank")
        self.driver.get(address)
        self.wait(lambda: self.run("return document.documentElement.dataset.ready") == "all", "the page is not ready")

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, condition, complaint):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                raise AssertionError(complaint)
            time.sleep(0.1)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def picture(self, selector=".frame > canvas"):
        """What is seen of an element, when it has come to rest: rows of pixels of red, green and blue."""
        self.wait(lambda: self.run("return (talus.players ?? [talus.player]).every((one) => one.stage.isFine || one.clock.playing)"), "the stage does not come to rest")
        path = self.folder / "picture.png"
        path.write_bytes(self.find(selector).screenshot_as_png)
        return pixels(path)

    def time(self):
        return self.run("return talus.clock.time")

    def press(self, keys):
        ActionChains(self.driver).send_keys(keys).perform()

    def drag(self, element, begin, end):
        """From one point of an element to another, in shares of its size from its middle."""
        size = element.size
        actions = ActionChains(self.driver, duration=100)
        actions.move_to_element_with_offset(element, int(begin[0] * size["width"]), int(begin[1] * size["height"])).click_and_hold()
        actions.move_to_element_with_offset(element, int(end[0] * size["width"]), int(end[1] * size["height"])).release().perform()

    def requests(self):
        """Addresses that were asked for since the last call, other than those of data within the page."""
        messages = (json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance"))
        asked = [one["params"]["request"]["url"] for one in messages if one["method"] == "Network.requestWillBeSent"]
        return [address for address in asked if not address.startswith(("data:", "blob:", "about:"))]

    def complaints(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")
                and "GPU stall" not in entry["message"] and "software WebGL" not in entry["message"]]


def pixels(path):
    """Those of a PNG file: rows of red, green and blue."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(float)[:, :3]


def differ(a, b):
    """Whether two pictures show different things."""
    return a.shape != b.shape or float(numpy.mean(numpy.abs(a - b).max(axis=1) > 24)) > 0.002


def problems_of_playing(browser):
    """The page of a run that is over."""
    first = browser.picture()
    if first.std() < 10:
        yield "the stage is blank"
    if not 0 < browser.time() < 0.4:
        yield f"the page opens at {browser.time()} s"

    stage = browser.find(".frame > canvas")
    browser.drag(stage, (0, 0), (0.2, 0.05))
    turned = browser.picture()
    if not differ(first, turned):
        yield "a drag does not turn the grains"
    browser.press("+")
    if not differ(turned, browser.picture()):
        yield "the key + does not zoom"

    browser.press(Keys.HOME)
    start = browser.picture()
    browser.press(" ")
    browser.wait(lambda: browser.time() > 0.15, "the key space does not play")
    browser.press(" ")
    stopped = browser.time()
    if browser.run("return talus.clock.playing"):
        yield "the key space does not stop"
    if not differ(start, browser.picture()):
        yield "playing does not move the grains"
    browser.press(Keys.ARROW_LEFT)
    if not browser.time() < stopped:
        yield "the left arrow does not go back"

    browser.press(Keys.ESCAPE + "r")
    shown = browser.picture()
    browser.run("scrollTo(0, 0); document.activeElement.blur()")
    x, y = browser.run("""const { player } = talus, box = player.canvas.getBoundingClientRect();
      for (let y = box.bottom - 10; y > box.top; y -= 4) if (player.stage.pick(box.left + box.width / 2, y) >= 0) return [0, Math.round(y - 4 - box.top - box.height / 2)];""")
    ActionChains(browser.driver).move_to_element_with_offset(stage, x, y).click().perform()
    browser.wait(lambda: browser.find(".grain").is_displayed(), "a click on a grain does not tell its numbers")
    if not re.search(r"Grain \d+.*Radius.*mm.*Speed.*m/s", browser.find(".grain").text, re.S):
        yield f"the numbers of a grain read {browser.find('.grain').text!r}"
    browser.press(Keys.ESCAPE)
    if differ(shown, browser.picture()):
        yield "the key Escape does not let go of the grain"


def problems_of_choices(browser):
    """Colours, cut, walls and force chains."""
    before = browser.picture()
    colours = [option.get_attribute("value") for option in Select(browser.find("[aria-label='Colour of the grains']")).options]
    if colours != ["speed", "height", "radius", "material", "id", "origin", "age", "coordination", "none"]:
        yield f"the grains can be coloured by {colours}"
    for colour in ("material", "height"):
        Select(browser.find("[aria-label='Colour of the grains']")).select_by_value(colour)
        now = browser.picture()
        if not differ(before, now):
            yield f"colouring by {colour} changes nothing"
        before = now
    Select(browser.find("[aria-label='Cut away']")).select_by_value("y")
    cut = browser.picture()
    if not differ(before, cut):
        yield "the cut takes nothing away"
    browser.run("const slider = document.querySelector(\"[aria-label='Where it is cut']\"); slider.value = 0.2; slider.dispatchEvent(new Event('input'))")
    if not differ(cut, browser.picture()):
        yield "the cut does not move"
    Select(browser.find("[aria-label='Cut away']")).select_by_value("off")
    before = browser.picture()
    for toggle in ("walls", "chains"):
        browser.find(f"[data-toggle={toggle}]").click()
        now = browser.picture()
        if not differ(before, now):
            yield f"the button for {toggle} changes nothing"
        before = now


def problems_of_charts(browser):
    """A drag in a chart is a drag in time, and back."""
    over = browser.find(".chart:not(.front .chart) .u-over")
    browser.run("arguments[0].scrollIntoView({ block: 'center' })", over)
    browser.drag(over, (-0.4, 0), (0.25, 0))
    if abs(browser.time() - 0.75 * 0.4) > 0.01:
        yield f"a drag in a chart to three quarters of the run moves the time to {browser.time()} s"
    cursor = browser.run("return document.querySelector('.chart:not(.front .chart) .now').getBoundingClientRect().left - arguments[0].getBoundingClientRect().left", over)
    browser.wait(lambda: abs(cursor / over.size["width"] - browser.time() / 0.4) < 0.02, "the cursor of a chart is not at the time")
    browser.run("scrollTo(0, 0)")
    drawn = browser.run("return document.querySelectorAll('.chart').length")
    if drawn < 10:
        yield f"the page has only {drawn} charts"


def problems_of_links(browser, address):
    """The address keeps time, view and choices."""
    browser.press(Keys.ARROW_RIGHT)
    browser.wait(lambda: "t=" in browser.run("return location.hash"), "the address does not keep the time")
    browser.open(f"{address}#t=0.2&view=-40,30,0.9,0,0,0.05&colour=radius&clip=x,0.4,1&chains=1&walls=0")
    state = browser.run("const p = talus.player; return [talus.clock.time, p.options.colour, p.options.chains, p.options.walls, p.stage.clip.axis, p.stage.clip.at, p.stage.clip.flip, ...p.stage.view.slice(0, 3)]")
    if state[:7] != [0.2, "radius", True, False, "x", 0.4, True] or not numpy.allclose(state[7:], [-40, 30, 0.9], atol=1e-3):
        yield f"a link leads to {state}"
    browser.open(f"{address}#t=nonsense&view=1,2&colour=<b>&clip=q,9")
    if browser.picture().std() < 10:
        yield "a link that makes no sense leads to a blank stage"


def problems_of_saving(browser):
    """A picture and a film."""
    seen = browser.picture().std()
    for tool, ending, head in (("picture", "png", b"\x89PNG"), ("film", "webm", b"\x1a\x45\xdf\xa3")):
        browser.run("talus.clock.rate = 0.2")
        browser.find(f"[data-tool={tool}]").click()
        found = []
        browser.wait(lambda: found.extend(path for path in browser.folder.glob(f"*.{ending}") if path.name != "picture.png") or found, f"no {ending} was saved")
        browser.wait(lambda: found[0].stat().st_size > 1000, f"an empty {ending} was saved")
        if not found[0].read_bytes().startswith(head):
            yield f"what was saved as {ending} is none"
        if ending == "png" and pixels(found[0]).std() < 0.8 * seen:
            yield "the picture that was saved is paler than what is seen"


def problems_of_sizes(browser):
    """On a phone, a laptop and a large screen nothing is wider than the screen, and the run can be played without scrolling."""
    for name, (width, height) in SIZES.items():
        browser.resize(name)
        browser.run("scrollTo(0, 0)")
        if browser.picture().std() < 8:
            yield f"on a {name} the stage is blank"
        wide = browser.run("return document.documentElement.scrollWidth")
        if wide > width:
            yield f"on a {name} the page is {wide} pixels wide"
        bottom = browser.run("return document.querySelector('button.play').getBoundingClientRect().bottom")
        if bottom > height:
            yield f"on a {name} the button that plays is at {bottom}, below the first screen"
    browser.resize("laptop")


def problems_of_report(browser, folder, out):
    page = folder / "report.html"
    subprocess.run([sys.executable, ROOT / "postprocess" / "report.py", out, "--output", page], check=True, capture_output=True)
    address = page.as_uri()
    browser.open(address)
    for part in (problems_of_playing, problems_of_choices, problems_of_charts):
        yield from part(browser)
    yield from problems_of_links(browser, address)
    browser.open(address)
    yield from problems_of_saving(browser)
    yield from problems_of_sizes(browser)
    title = browser.run("return document.querySelector('h1').textContent")
    if "<script>alert(1)</script>" not in title or browser.run("return document.querySelectorAll('h1 *, .card i, .chart img').length"):
        yield "a name is shown as HTML"
    outside = [one for one in browser.requests() if not one.startswith(address)]
    if outside:
        yield f"the page asks for {outside}"


def problems_of_comparison(browser, folder, out):
    page = folder / "compare.html"
    subprocess.run([sys.executable, ROOT / "postprocess" / "compare.py", out, out, "--output", page], check=True, capture_output=True)
    browser.open(page.as_uri())
    right = browser.picture(".side:last-child .frame > canvas")
    if right.std() < 10:
        yield "the second run is blank"
    browser.drag(browser.find(".side:first-child .frame > canvas"), (0, 0), (0.25, 0))
    turned = browser.picture(".side:last-child .frame > canvas")
    if not differ(right, turned):
        yield "the second run does not turn with the first"
    browser.press(Keys.HOME)
    if not differ(turned, browser.picture(".side:last-child .frame > canvas")):
        yield "the second run has not the clock of the first"
    if any(not one.startswith(page.as_uri()) for one in browser.requests()):
        yield "the comparison asks for something outside"


def status_of_answer(address):
    try:
        return urllib.request.urlopen(address, timeout=PATIENCE).status
    except urllib.error.HTTPError as error:
        return error.code


def problems_of_watching(browser, folder, talus):
    """A run that goes on is seen going on, and its end is seen."""
    run = subprocess.Popen([talus, "run", SCENE, "--until", "1000", "--threads", "1", "--quiet", "--watch", "-o", folder / "watched"],
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={"GOMP_SPINCOUNT": "2000", "PATH": "/usr/bin:/bin"})
    try:
        address = run.stdout.readline().removeprefix("watch: ").strip()
        if not re.fullmatch(r"http://127\.0\.0\.1:\d+/[\w-]{20,}/", address):
            yield f"the address to watch is {address!r}"
            return
        browser.wait(lambda: (folder / "watched" / "particles.pvd").is_file(), "the run writes no frames")
        browser.open(address)
        if browser.picture().std() < 10:
            yield "the run that goes on is not drawn"
        browser.press(Keys.END)
        end = browser.time()
        browser.wait(lambda: browser.time() > end + 0.05, "new frames do not come")
        browser.press(Keys.HOME)
        time.sleep(3)
        if browser.time() != 0:
            yield "who looks at the beginning is taken away from it"
        server = address.rsplit("/", 2)[0]
        if [status_of_answer(f"{server}/{token}/run.json") for token in ("", "wrong")] != [404, 404]:
            yield "the server answers who does not know the address"
        run.send_signal(signal.SIGINT)
        browser.wait(lambda: browser.find(".status").text == "stopped", "the page does not tell that the run was stopped")
        if run.wait(PATIENCE) != 130:
            yield f"a watched run that is stopped ends with {run.returncode}"
        outside = [one for one in browser.requests() if not one.startswith(address)]
        if outside:
            yield f"the page of a run that goes on asks for {outside}"
    finally:
        if run.poll() is None:
            run.kill()
            run.wait()


def problems(talus, out):
    with tempfile.TemporaryDirectory() as name:
        browser = Browser(name)
        try:
            for part in (lambda: problems_of_report(browser, Path(name), out), lambda: problems_of_comparison(browser, Path(name), out),
                         lambda: problems_of_watching(browser, Path(name), talus)):
                yield from part()
                yield from (f"the browser's console says: {one}" for one in browser.complaints())
        except (AssertionError, WebDriverException) as error:
            yield str(error).split("\n", maxsplit=1)[0]
            yield from (f"the browser's console says: {one}" for one in browser.complaints())
        finally:
            browser.driver.quit()


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: check_viewer.py TALUS OUT")
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        print("skipped: apt install chromium chromium-driver python3-selenium")
        return
    found = list(problems(*sys.argv[1:]))
    for problem in found:
        print(f"check_viewer.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
