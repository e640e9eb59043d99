#!/usr/bin/python3
"""Opens the reports of `kaustik sweep` and `kaustik bench` in headless Chromium: every point of the CSV is in charts and table, the slider
moves, nothing is fetched, no error reaches the console, a phone need not scroll sideways. Leaves screenshots.

report_in_browser.py KAUSTIK OUT_DIR      (packages chromium chromium-driver python3-selenium)
Exit code 77, with the reason, where there is no browser."""
import base64
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import headless  # noqa: E402

PAGE = "the report"
try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select
except ImportError as error:
    headless.skip(PAGE, error)

# The name contains markup, which must stay text.
SCENE_NAME = "<img src=x onerror=window.hacked=1>&amp;.pbrt"
SCENE = """LookAt 0 2 6  0 0.5 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 96 "integer yresolution" 64
Sampler "independent" "integer pixelsamples" 4
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [10 10 10]
  ReverseOrientation
  Translate 0 3 0
  Rotate -90 1 0 0
  Shape "disk" "float radius" 0.5
AttributeEnd
Material "diffuse" "rgb reflectance" [0.7 0.6 0.5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-3 0 3  3 0 3  3 0 -3  -3 0 -3]
Material "dielectric"
Translate 0 0.8 0
Shape "sphere" "float radius" 0.5
"""
CHARTS = ("error-time", "error-photons", "error-radius", "error-parts", "phases")


def sweep(kaustik, out):
    scene = out / SCENE_NAME
    scene.write_text(SCENE)
    subprocess.run([kaustik, "sweep", str(scene), "--photons", "2k,8k", "--radius", "0.5x,auto,2x", "--methods",
                    "photon,mc", "--seeds", "3", "--reference-time", "2s", "-o", str(out / "sweep"), "--quiet"],
                   check=True)
    return out / "sweep"


def points_in(browser, chart):
    """Returns [cell, x, y] of every point in a chart."""
    return browser.execute_script("""
        return Chart.getChart(arguments[0]).data.datasets.flatMap(d => d.data.map(p => [p.cell, p.x, p.y, d.label]));""",
                                  chart)


def check_points(browser, rows):
    """Checks that charts hold exactly the numbers of the CSV, which has all digits of a double."""
    over_time = points_in(browser, "error-time")
    for index, row in enumerate(rows):
        found = [p for p in over_time if p[0] == index and p[3] != "Pareto front"]
        assert [(p[1], p[2]) for p in found] == [(float(row["seconds"]), float(row["relative_rmse"]))], (row, found)
    front = {p[0] for p in over_time if p[3] == "Pareto front"}
    assert front == {i for i, row in enumerate(rows) if row["pareto"] == "true"}, front
    for chart, column in (("error-photons", "photons"), ("error-radius", "r0_m")):
        found = sorted((p[0], p[1], p[2]) for p in points_in(browser, chart))
        expected = [(i, float(row[column]), float(row["relative_rmse"])) for i, row in enumerate(rows) if row[column]]
        assert found == expected, (chart, found, expected)
    parts = {(p[0], p[2]) for p in points_in(browser, "error-parts")}
    for index, row in enumerate(rows):
        for column in ("bias2", "variance"):
            shown = row["photons"] and float(row[column]) > 0
            assert ((index, float(row[column])) in parts) == bool(shown), (row, column)
    phases = browser.execute_script("return Chart.getChart('phases').data.datasets.map(d => d.data)")
    names = ("seconds_bvh", "seconds_photon_trace", "seconds_photon_build", "seconds_render")
    assert phases == [[float(row[name]) for row in rows] for name in names]


def check_zeros(browser, kaustik, out):
    """Checks that errors of exactly 0, from a scene without light, have points inside the chart."""
    scene = out / "dark.pbrt"
    scene.write_text(SCENE.replace("[10 10 10]", "[0 0 0]"))
    subprocess.run([kaustik, "sweep", str(scene), "--photons", "1k,2k", "--radius", "0.01", "--seeds", "1", "--width", "24",
                    "--reference-time", "10ms", "-o", str(out / "dark"), "--quiet"], check=True)
    with open(out / "dark" / "sweep.csv", newline="") as file:
        assert all(float(row["relmse"]) == 0 for row in csv.DictReader(file))
    browser.get((out / "dark" / "report.html").resolve().as_uri())
    inside = browser.execute_script("""
        const chart = Chart.getChart("error-time"), y = chart.scales.y;
        return chart.data.datasets.flatMap(d => d.data.map(p => y.min < p.y && p.y < y.max));""")
    assert inside and all(inside), inside
    assert "the lowest points are 0" in browser.execute_script("return Chart.getChart('error-time').scales.y.options.title.text")


def check_bench(browser, kaustik, out):
    """The charts of `kaustik bench --plot` hold the medians of its JSON file, and ideal lines from the first point."""
    scene = out / SCENE_NAME
    result, folder = out / "bench.json", out / "bench"
    subprocess.run([kaustik, "bench", str(scene), "--photons", "2k,8k", "--threads", "1,2", "--repeat", "2", "--width", "24",
                    "--json", str(result), "--plot", str(folder), "--quiet"], check=True, stdout=subprocess.DEVNULL)
    points = json.loads(result.read_text())["points"]
    browser.get((folder / "scaling.html").resolve().as_uri())

    def chart(name):
        """{label: [[x, y], ...]} of a chart."""
        sets = browser.execute_script(
            "return Chart.getChart(arguments[0]).data.datasets.map(d => [d.label, d.data.map(p => [p.x, p.y])])", name)
        return dict(sets)

    for photons, name in ((2000, "2k"), (8000, "8k")):
        same = [p for p in points if p["photons"] == photons]
        shown = chart(f"speed-up-{name}")
        assert shown["total"] == [[p["threads"], p["speed_up"]["total"]] for p in same], (shown, same)
        assert shown["ideal"] == [[1, 1], [2, 2]], shown
        rates = [[p["threads"], p["per_second"]["photons"]["median"]] for p in same]
        assert chart("photons-per-second")[f"{name} photons"] == rates
    seconds = [[p["photons"], p["seconds"]["total"]["median"]] for p in points if p["threads"] == 2]
    assert chart("seconds-over-photons")["total"] == seconds
    charts = ("speed-up-2k", "speed-up-8k", "photons-per-second", "seconds-over-photons")
    for name in charts:
        assert colours_in(browser, name) > 8, name
    check_schemes(browser, charts)
    check_quiet(browser)


def check_table(browser, rows):
    heads = [head.text for head in browser.find_elements(By.CSS_SELECTOR, "#points thead th")]
    columns = {"relmse": "relMSE", "relmse_2": "2 x 2", "relmse_4": "4 x 4", "relmse_8": "8 x 8"}
    lines = browser.find_elements(By.CSS_SELECTOR, "#points tbody tr")
    assert len(lines) == len(rows)
    for line, row in zip(lines, rows):
        texts = [cell.text for cell in line.find_elements(By.CSS_SELECTOR, "th,td")]
        cells = dict(zip(heads, texts))
        for name, head in columns.items():
            value = float(row[name])
            assert abs(float(cells[head]) - value) <= 0.005 * value, (head, cells, row)  # the table has three digits
        assert abs(float(cells["FLIP"]) - float(row["flip"])) <= 0.0005 + 1e-9, (cells, row)  # three decimals
        assert (cells["Pareto"] == "yes") == (row["pareto"] == "true")


def colours_in(browser, chart):
    return browser.execute_script("""
        const c = document.getElementById(arguments[0]);
        const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
        const seen = new Set();
        for (let i = 0; i < d.length; i += 4) seen.add(d[i] << 24 | d[i + 1] << 16 | d[i + 2] << 8 | d[i + 3]);
        return seen.size;""", chart)


def wait_until_drawn(browser, charts=CHARTS):
    """Waits until the charts are drawn again, some frames after a change of size; up to 30 s on a busy machine."""
    browser.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")
    end = time.monotonic() + 30
    while any(colours_in(browser, chart) <= 8 for chart in charts) and time.monotonic() < end:
        time.sleep(0.1)
    time.sleep(0.5)  # gives the compositor time to draw


def set_scheme(browser, scheme):
    """Makes the reader's system light or dark."""
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})


def luminance_of(browser, colour):
    """The relative luminance of a CSS colour, of WCAG 2, for its contrast with others."""
    parts = browser.execute_script("""
        const canvas = document.createElement("canvas").getContext("2d");
        canvas.fillStyle = arguments[0];
        canvas.fillRect(0, 0, 1, 1);
        return [...canvas.getImageData(0, 0, 1, 1).data];""", colour)
    linear = [v / 255 / 12.92 if v / 255 <= 0.04045 else ((v / 255 + 0.055) / 1.055) ** 2.4 for v in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(browser, first, second):
    low, high = sorted(luminance_of(browser, c) for c in (first, second))
    return (high + 0.05) / (low + 0.05)


def check_schemes(browser, charts):
    """Page and charts follow the reader's scheme while they are shown, with the contrasts that WCAG 2.1 asks for: 4.5 for
    texts, 3 for what a chart consists of. Lighter colours than that are in light charts as they were published."""
    for scheme in ("dark", "light"):
        set_scheme(browser, scheme)
        wait_until_drawn(browser, charts)
        style = lambda what, of: browser.execute_script(
            f"return getComputedStyle(document.querySelector('{of}')).getPropertyValue('{what}')", )
        paper = style("background-color", "section")
        assert (luminance_of(browser, paper) < 0.05) == (scheme == "dark"), (scheme, paper)
        for of in ("h2", "figcaption" if browser.find_elements(By.TAG_NAME, "figcaption") else "h2"):
            assert contrast(browser, style("color", of), paper) >= 4.5, (scheme, of)
        for chart in charts:
            ink, lines = browser.execute_script("""
                const chart = Chart.getChart(arguments[0]);
                const line = i => chart.getDatasetMeta(i).data.concat(chart.getDatasetMeta(i).dataset ?? [])[0];
                const shown = chart.data.datasets.map((_, i) => line(i)).filter(e => e);
                return [Object.values(chart.scales)[0].options.ticks.color,
                        shown.map(e => e.options.borderWidth ? e.options.borderColor : e.options.backgroundColor)];""", chart)
            assert contrast(browser, ink, paper) >= 4.5, (scheme, chart, ink)
            for line in lines:
                assert contrast(browser, line, paper) >= (3 if scheme == "dark" else 1.5), (scheme, chart, line)


def check_drawn(browser):
    """Checks that every chart has pixels of more than a few colours, so that it was really drawn."""
    for chart in CHARTS:
        assert colours_in(browser, chart) > 8, chart
    broken = browser.execute_script("return [...document.images].filter(i => !i.naturalWidth).length")
    assert broken == 0, f"{broken} pictures were not decoded"


def check_slider(browser):
    slider = browser.find_element(By.ID, "slider")
    clip = lambda: browser.execute_script("return document.getElementById('right-image').style.clipPath")
    assert "50%" in clip(), clip()
    browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", slider)
    ActionChains(browser).drag_and_drop_by_offset(slider, 150, 0).perform()
    dragged = clip()
    assert "50%" not in dragged, dragged
    slider.send_keys(Keys.HOME)
    # Browsers may shorten the CSS inset of four zeros.
    assert clip() in ("inset(0px)", "inset(0px 0px 0px 0%)", "inset(0% 0% 0% 0%)"), clip()
    box = browser.find_element(By.ID, "compare")
    ActionChains(browser).move_to_element_with_offset(box, 0, 0).click().perform()
    assert abs(float(slider.get_attribute("value")) - 50) < 2, slider.get_attribute("value")
    picture = browser.find_element(By.ID, "right-image").get_attribute("src")
    browser.find_element(By.ID, "show-errors").click()
    assert browser.find_element(By.ID, "right-image").get_attribute("src") != picture
    browser.find_element(By.ID, "show-errors").click()
    Select(browser.find_element(By.ID, "left-choice")).select_by_index(1)
    assert browser.find_element(By.ID, "left-tag").text != "reference"
    Select(browser.find_element(By.ID, "left-choice")).select_by_index(0)


def check_quiet(browser):
    # Chromium warns about reading the canvases' pixels, which only this test does.
    messages = [entry for entry in browser.get_log("browser") if "willReadFrequently" not in entry["message"]]
    assert not messages, messages
    fetched = browser.execute_script("""
        return performance.getEntriesByType("resource").map(e => e.name).filter(n => !n.startsWith("data:"))""")
    assert not fetched, fetched
    assert browser.execute_script("return window.hacked") is None
    assert browser.find_element(By.TAG_NAME, "h1").text == SCENE_NAME


def screenshot(browser, width, path):
    """Takes a picture of the whole page."""
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600})
    wait_until_drawn(browser)
    sideways = browser.execute_script("return document.documentElement.scrollWidth - window.innerWidth")
    assert sideways <= 0, f"the page is {sideways} pixels wider than a screen of {width}"
    height = browser.execute_script("return document.documentElement.scrollHeight")
    clip = {"x": 0, "y": 0, "width": width, "height": height, "scale": 1}
    image = browser.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
    path.write_bytes(base64.b64decode(image["data"]))


def main():
    out = pathlib.Path(sys.argv[2])
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    browser = headless.open_browser(PAGE, ["--disable-gpu"])
    try:
        folder = sweep(sys.argv[1], out)
        with open(folder / "sweep.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == 7, rows
        assert len(json.loads((folder / "sweep.json").read_text())["cells"]) == len(rows)
        browser.get((folder / "report.html").resolve().as_uri())
        check_points(browser, rows)
        check_table(browser, rows)
        check_drawn(browser)
        check_slider(browser)
        for width, name in ((1280, "desk"), (360, "phone")):
            screenshot(browser, width, out / f"report-{name}.png")
        check_schemes(browser, CHARTS)
        set_scheme(browser, "dark")
        screenshot(browser, 1280, out / "report-dark.png")
        set_scheme(browser, "light")
        check_quiet(browser)
        check_bench(browser, sys.argv[1], out)
        check_zeros(browser, sys.argv[1], out)
    finally:
        browser.quit()
    print(f"{len(rows)} points found; screenshots in {out}")


if __name__ == "__main__":
    main()
