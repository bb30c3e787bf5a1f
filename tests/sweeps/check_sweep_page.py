#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the page of a sweep in headless Chromium, points at a case, and follows the link to its page; then that of a study.

    tests/sweeps/check_sweep_page.py TALUS

Skipped where Debian's chromium, chromium-driver and python3-selenium are not installed.
Exit codes: 0 all is well or skipped, 1 it is not.
"""
import shutil
import sys
import tempfile
from pathlib import Path

from small_sweep import ROOT, SWEEP, call, skip, write_sweep

sys.path.insert(0, str(ROOT / "tests/support"))
import check_viewer  # noqa: E402  found by the line above
from studies.page import study_page  # noqa: E402
from studies.result import compare  # noqa: E402
from check_viewer import SIZES, Browser  # noqa: E402

if check_viewer.webdriver:
    from selenium.webdriver.common.actions.action_builder import ActionBuilder

PLACES = """const chart = talus.charts.list[arguments[0]];
const box = chart.u.over.getBoundingClientRect();
return chart.points.x.map((x, k) => [chart.points.id[k], box.left + chart.u.valToPos(x, 'x'), box.top + chart.u.valToPos(chart.points.y[k], 'y')]);"""


def point(browser, left, top, click=False):
    """Moves the pointer to a place of the window, as a person would."""
    actions = ActionBuilder(browser.driver, duration=100)
    actions.pointer_action.move_to_location(round(left), round(top))
    if click:
        actions.pointer_action.click()
    actions.perform()


def check(browser, page):
    browser.open(page.as_uri())
    assert browser.run("return talus.charts.list.map((one) => one.title)") == ["outlet · mass flow"] * 2 + ["outlet · sphere flow"] * 2
    for size in SIZES:
        browser.resize(size)
        browser.open(page.as_uri())
        if size != "phone":
            assert browser.run("return document.documentElement.scrollWidth <= innerWidth"), f"the page is wider than a {size}"
    browser.wait(lambda: browser.run("return Boolean(talus.charts.list[0].u)"), "no chart is drawn")
    case, left, top = browser.run(PLACES, 0)[0]
    point(browser, left + 3, top)
    assert browser.run("return talus.pointed") == case
    tip = browser.run("return document.querySelector('.tip').innerText")
    assert "Case 1: contact.glass-glass.friction = 0.1" in tip and "outlet · mass flow" in tip, tip
    assert browser.run("return document.querySelector('tr.pointed').dataset.case") == str(case)
    assert [entry for entry in browser.complaints() if "favicon" not in entry] == []
    assert [one for one in browser.requests() if not one.startswith("file:")] == []
    point(browser, left, top, click=True)
    browser.wait(lambda: browser.driver.current_url.endswith("cases/0001/report.html"), "a click does not open the page of the run")
    browser.wait(lambda: browser.run("return document.documentElement.dataset.ready") == "all", "the page of the run is not ready")


def row(setting, cpu, overlap):
    return {"setting": setting, "seed": 1, "status": "done", "cpu_s_per_s": cpu, "contact_updates_per_s": 0.0, "memory_B": 0.0,
            "findings": [{"name": "overlap_95", "value": overlap, "spread": 0.0, "unit": "d"}], "profile": []}


def check_study(browser, page):
    """Error against cost on logarithmic axes, with an error of 0 at the foot."""
    names = ["reference", "default", "projected", "exact"]
    rows = [row("reference", 90.0, 1e-7), row("default", 2.0, 3e-3), row("projected", 8.0, 4e-5), row("exact", 8.5, 0.0)]
    page.write_text(study_page(compare(names, rows), "Four settings", "made up"), encoding="utf-8")
    browser.open(page.as_uri())
    browser.wait(lambda: browser.run("return Boolean(talus.charts.list[0].u)"), "no chart is drawn")
    assert browser.run("return talus.charts.list.map((one) => one.title)") == ["overlap_95"]
    scales = browser.run("const { x, y } = talus.charts.list[0].u.scales; return [x.distr, x.min, x.max, y.distr, y.min, y.max].map((one) => Number(one.toPrecision(6)))")
    assert scales == [3, 1, 10, 3, 1e-5, 0.01], scales
    case, left, top = browser.run(PLACES, 0)[1]
    point(browser, left, top)
    assert browser.run("return talus.pointed") == case == 2
    tip = browser.run("return document.querySelector('.tip').innerText")
    assert "projected" in tip and "page" not in tip, tip
    assert [entry for entry in browser.complaints() if "favicon" not in entry] == []


def main():
    if not check_viewer.webdriver or not shutil.which("chromium") or not shutil.which("chromedriver"):
        skip("there is no chromium, chromium-driver or python3-selenium")
    talus = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        text = SWEEP.replace("reports = false", "").replace("seeds = 3", "").replace("count = 60", "count = 150")  # two flows of sixty beads can be equal
        call(talus, "sweep", write_sweep(name, text), "--out", Path(name) / "sweep", "--jobs", 2, "--quiet")
        browser = Browser(name)
        try:
            check(browser, Path(name) / "sweep/sweep.html")
            check_study(browser, Path(name) / "study.html")
        finally:
            browser.driver.quit()


if __name__ == "__main__":
    main()
