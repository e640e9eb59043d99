#!/usr/bin/python3
"""Drives the live page in headless Chromium: the picture and its layers have the program's values and colours, by WebGL and by a
2D canvas; zoom, readout, comparison, pause, stop and save work, and the laboratory where there is one; nothing foreign is fetched,
no error reaches the console, a phone need not scroll sideways. Leaves screenshots.

view_in_browser.py KAUSTIK|ADDRESS|mock OUT_DIR      (packages chromium chromium-driver python3-selenium)
KAUSTIK: the program, which it starts and ends.
ADDRESS: that of a page whose render has just begun and takes 20 seconds or more; the test holds it, and ends it.
mock: that of mock_server.py, which it starts and ends.
Exit code 77, with the reason, where there is no browser."""
import array
import base64
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import time
import urllib.request

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
import headless  # noqa: E402

PAGE = "the live page"
try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select
except ImportError as error:
    headless.skip(PAGE, error)

# WebGL without a graphics card.
GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
LONGEST = 60  # seconds to wait for anything, on a busy machine


class Page:
    def __init__(self, browser, address):
        self.browser, self.address = browser, address
        self.info = json.loads(self.fetch("info"))

    def fetch(self, path):
        with urllib.request.urlopen(self.address + path, timeout=LONGEST) as answer:
            return answer.read()

    def open(self, fragment=""):
        self.browser.get("about:blank")  # another fragment alone would not load the page again
        self.browser.get(self.address + fragment)
        self.wait("view !== null", "the page starts")

    def js(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def find(self, name):
        return self.browser.find_element(By.ID, name)

    def text(self, name):
        return self.find(name).get_attribute("textContent")

    def wait(self, condition, what, *arguments):
        end = time.monotonic() + LONGEST
        while not self.js(f"return Boolean({condition})", *arguments):
            assert time.monotonic() < end, f"in {LONGEST} s it did not happen that {what}: {self.state()}"
            time.sleep(0.05)

    def state(self):
        return self.js("return document.getElementById('state').textContent")

    def values_of(self, layer):
        """The floats that the program has of a layer, row by row, and the version of the picture."""
        data = self.fetch(f"pixels?since=0&layer={layer}")
        x0, y0, x1, y1 = (self.info[k] for k in ("x0", "y0", "x1", "y1"))
        channels = next(row["channels"] for row in self.info["layers"] if row["name"] == layer)
        width = x1 - x0
        out = array.array("f", bytes(4 * width * (y1 - y0) * channels))
        low, high, _, tiles = struct.unpack_from("<IIII", data)
        at = 16
        for _ in range(tiles):
            x, y, w, h = struct.unpack_from("<IIII", data, at)
            at += 16
            for row in range(h):
                begin = ((y + row - y0) * width + x - x0) * channels
                out[begin:begin + w * channels] = array.array("f", data[at:at + 4 * w * channels])
                at += 4 * w * channels
        assert at == len(data), (at, len(data))
        return out, low + (high << 32)

    def shown_values(self):
        """The floats of the layer that the page shows."""
        encoded = self.js("""
            const bytes = new Uint8Array(view.now().values.buffer);
            let text = "";
            for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
            return btoa(text);""")
        return array.array("f", base64.b64decode(encoded))


def check_first_picture(page):
    page.wait("view.layers.slots.get('').version > 0", "the first pixels arrive")
    assert page.text("title") == page.info["title"]
    early = page.js("return view.status.status.seconds")
    page.wait("view.status.status.version > arguments[0]", "the picture sharpens", page.js("return view.status.status.version"))
    assert page.js("return view.status.status.seconds") > early
    assert page.js("return view.now().values.some(v => v > 0)"), "the picture is black"
    done = page.js("return getComputedStyle(document.getElementById('progress')).getPropertyValue('--done')")
    assert float(done.strip().rstrip("%")) > 0, done


def check_pause(page):
    """Holds the render, so that what follows can compare its pixels, and has the time that it needs."""
    assert page.state() == "running", page.state()
    page.find("pause").click()
    page.wait("document.getElementById('state').textContent === 'paused'", "it is paused")
    assert page.text("pause") == "Resume"
    page.wait("view.layers.upToDate()", "the pixels are complete")


def check_resume(page):
    page.find("pause").click()
    page.wait("document.getElementById('state').textContent === 'running'", "it goes on")


def check_layers(page):
    """Every layer has the program's values, bit by bit."""
    for layer in page.info["layers"]:
        Select(page.find("layer")).select_by_value(layer["name"])
        page.wait("view.layers.upToDate() && view.now().name === arguments[0]", f"layer {layer['name']} arrives", layer["name"])
        expected, version = page.values_of(layer["name"])
        if version == page.js("return view.layers.slots.get(arguments[0]).version", layer["name"]):
            assert page.shown_values().tobytes() == expected.tobytes(), f"layer {layer['name']} differs"
        ramp = page.find("ramp").is_displayed()
        assert ramp == (layer["channels"] == 1 or layer["name"] in ("error", "bias")), layer
    Select(page.find("layer")).select_by_value("")


# The colours on the screen at the middles of some pixels, and what the operators of tone.js give for these pixels.
COLOURS = """
    const [layer, operator] = arguments, picture = view.picture;
    view.choose(layer);
    view.setOperator(operator);
    view.now().fitRange();
    picture.zoomTo(8);
    picture.draw();
    const screen = document.createElement("canvas"), from = picture.drawer.canvas;
    screen.width = from.width, screen.height = from.height;
    const context = screen.getContext("2d", {willReadFrequently: true}), found = [], out = [0, 0, 0];
    context.drawImage(from, 0, 0);
    for (let i = 1; i < 8; ++i)
      for (let j = 1; j < 8; ++j) {
        const left = Math.floor(from.width * i / 8), top = Math.floor(from.height * j / 8), pixel = picture.pixelAt(left + .5, top + .5);
        if (!pixel) continue;
        shownColour(view.now(), view.look, pixel.y * view.now().width + pixel.x, out);
        found.push([...context.getImageData(left, top, 1, 1).data.slice(0, 3), ...out.map(v => Math.floor(255 * v + .5))]);
      }
    picture.fit();
    return found;"""


def check_colours(page):
    """What is drawn is what the operators give, within one level."""
    names = [layer["name"] for layer in page.info["layers"]]
    for layer in [""] + [name for name in ("normal", "depth", "albedo", "error") if name in names]:
        page.js("view.choose(arguments[0])", layer)
        page.wait("view.layers.upToDate()", f"layer {layer} arrives")
        for operator in ("srgb", "reinhard", "filmic") if layer == "" else ("filmic",):
            found = page.js(COLOURS, layer, operator)
            assert len(found) >= 9, found
            for pixel in found:
                assert all(abs(a - b) <= 1 for a, b in zip(pixel[:3], pixel[3:])), (layer, operator, pixel)
    page.js("view.choose('')")


def check_exposure(page):
    if page.info["exposure"] is None:
        assert page.find("automatic").is_selected()
        page.wait("view.exposure !== 0", "the exposure is computed")
    slider = page.find("exposure")
    slider.send_keys(Keys.ARROW_RIGHT)
    assert not page.find("automatic").is_selected()
    href = page.find("save-png").get_attribute("href")
    assert f"exposure={page.js('return view.exposure')}" in href and f"tonemap={page.js('return view.look.operator')}" in href, href


def check_zoom(page):
    """Keys and wheel zoom to single pixels; the readout names the one under the pointer, with its values."""
    stage = page.find("stage")
    ActionChains(page.browser).move_to_element(stage).perform()
    whole = page.js("return view.picture.zoom")
    stage.send_keys("+++")
    assert page.js("return view.picture.zoom") > 3 * whole
    for _ in range(8):
        ActionChains(page.browser).scroll_from_origin(ScrollOrigin.from_element(stage), 0, -300).perform()
    page.wait("view.picture.zoom > 50", "the wheel zooms")
    page.js("addEventListener('pointermove', event => { window.pointed = event; }, true)")
    ActionChains(page.browser).move_to_element_with_offset(stage, 31, 17).perform()
    x, y, values = page.js("""
        const box = view.picture.stage.getBoundingClientRect(), p = view.picture.pixelAt(pointed.clientX - box.x, pointed.clientY - box.y);
        const i = 3 * (p.y * view.now().width + p.x);
        return [p.x, p.y, [...view.now().values.slice(i, i + 3)].map(short).join("  ")];""")
    expected = f"x {x + page.info['x0']}  y {y + page.info['y0']}:  {values} "
    assert page.text("readout").startswith(expected), (page.text("readout"), expected)
    numbers = page.js("""
        view.picture.zoomTo(100);
        view.picture.draw();
        const c = view.picture.overlay;
        return c.getContext("2d").getImageData(0, 0, c.width, c.height).data.some(v => v > 0);""")
    assert numbers, "large pixels show no numbers"
    stage.send_keys(Keys.ARROW_LEFT)
    assert page.js("return view.picture.byKeys")
    stage.send_keys("0")
    assert abs(page.js("return view.picture.zoom") - whole) < 1e-9
    stage.send_keys("?")
    assert page.js("return document.getElementById('help').open")
    page.find("help").send_keys(Keys.ESCAPE)


def check_compare(page, out):
    """A kept picture and one of a file stand left of the divider, which moves by pointer and by keys."""
    page.find("keep").click()
    page.wait("!document.getElementById('divider').hidden", "the divider is there")
    divider = page.find("divider")
    ActionChains(page.browser).drag_and_drop_by_offset(divider, 150, 0).perform()
    assert page.js("return view.compare.split") > 0.6
    divider.send_keys(Keys.HOME)
    assert page.js("return view.compare.split") == 0
    divider.send_keys(Keys.PAGE_UP)
    assert abs(page.js("return view.compare.split") - 0.1) < 1e-9
    page.wait("document.getElementById('compare-note').textContent.includes('%')", "the difference is measured")
    Select(page.find("difference")).select_by_value("4")
    assert not divider.is_displayed()
    Select(page.find("difference")).select_by_value("0")
    file = out / "reference.png"
    file.write_bytes(page.fetch("save?format=png&exposure=0&tonemap=srgb"))
    page.find("reference-file").send_keys(str(file))
    page.wait("view.compare.chosen.file", "the file is loaded")
    assert page.text("tag-left") == "reference.png", page.text("tag-left")
    page.js("view.setOperator('srgb'); view.setByHand(0)")
    page.wait("document.getElementById('compare-note').textContent.includes('levels')", "the difference is measured")
    page.find("forget").click()
    Select(page.find("compare-with")).select_by_value("")
    assert not divider.is_displayed()


def check_save(page, downloads):
    for kind, magic in (("exr", b"v/1\x01"), ("png", b"\x89PNG")):
        page.find(f"save-{kind}").click()
        end = time.monotonic() + LONGEST
        while not (found := [f for f in downloads.glob(f"*.{kind}") if f.stat().st_size]):
            assert time.monotonic() < end, f"no {kind} file was saved: {list(downloads.iterdir())}"
            time.sleep(0.1)
        assert found[0].read_bytes()[:4] == magic, found


def check_stop(page):
    """The first press asks, the second one ends the render, and with it a program without a laboratory."""
    page.find("stop").click()
    assert page.text("stop") == "Really stop?"
    page.find("stop").click()
    page.wait("view.status.state === 'finished' && view.status.status.stopped", "it has stopped")
    assert not page.find("pause").is_enabled()


def check_estimate(page):
    ActionChains(page.browser).move_to_element_with_offset(page.find("stage"), 20, 60).click().perform()
    page.wait("view.lab.estimate.estimate || /no surface|No estimate/.test(document.getElementById('estimate-note').textContent)",
              "the estimate arrives")
    if page.js("return view.lab.estimate.map() === null"):
        print("note: no map was read at the pixel:", page.text("estimate-note"))
        return
    x, y = (page.js(f"return view.lab.estimate.pixel.{k}") for k in "xy")
    told = json.loads(page.fetch(f"estimate?x={x}&y={y}"))
    facts = page.text("estimate-facts")
    shown = page.js("return view.lab.estimate.map().kind")
    accepted = next(m["accepted"] for m in told["maps"] if m["kind"] == shown)
    assert f"photons{accepted}" in facts, (facts, accepted)
    assert page.js("return view.lab.estimate.dots.length > 0") == (accepted > 0)
    if told["cell"]:
        assert told["cell"]["reason"] in page.text("cell"), page.text("cell")


def check_cloud(page):
    page.find("tab-cloud").click()
    page.wait("view.lab.cloud.photons", "the photons arrive")
    count, = struct.unpack_from("<I", page.fetch("photons?most=200000"))
    assert page.js("return view.lab.cloud.photons.count") == count
    page.js("view.lab.cloud.markEstimate(null)")
    drawn = """
        view.lab.cloud.draw();
        const from = view.lab.cloud.canvas, c = document.createElement("canvas");
        c.width = from.width, c.height = from.height;
        c.getContext("2d").drawImage(from, 0, 0);
        const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
        let sum = 0;
        for (let i = 0; i < d.length; i += 4) sum += d[i] > 40 || d[i + 1] > 40 ? 1 : 0;
        return sum;"""
    all_kinds = page.js(drawn)
    assert all_kinds > 100 or count < 100, all_kinds
    for kind in ("direct", "shadow", "caustic", "indirect"):
        page.find(f"kind-{kind}").click()
    assert page.js(drawn) < max(100, all_kinds / 10), "the legend does not hide the photons"
    for kind in ("direct", "shadow", "caustic", "indirect"):
        page.find(f"kind-{kind}").click()
    page.find("cloud-cells").click()
    page.find("cloud").send_keys(Keys.ARROW_LEFT, "+")
    assert page.js(drawn) > all_kinds / 10
    page.find("tab-picture").click()


def check_settings(page):
    """A change renders again, and keeps the picture before; a wrong value is explained."""
    before = page.js("return view.status.status.render")
    field = page.js("return [...view.lab.settings.fields.values()].find(f => f.id === 'setting-photons')")
    field.clear()
    field.send_keys("many", Keys.TAB)
    page.wait("document.getElementById('settings-problem').textContent.includes('many')", "the wrong value is explained")
    assert page.js("return view.status.status.render") == before
    field.clear()
    field.send_keys("60k", Keys.TAB)
    page.wait("view.status.status.render > arguments[0]", "it renders again", before)
    assert page.text("settings-problem") == ""
    assert page.js("return view.compare.entries.filter(e => e.automatic).length") == 1
    page.wait("view.layers.slots.get('').render > arguments[0]", "the new picture arrives", before)


def check_screens(page, out):
    for theme in ("light", "dark"):
        page.js("if (document.documentElement.dataset.theme !== arguments[0]) document.getElementById('theme').click()", theme)
        for width, height, name in ((1280, 860, "desk"), (390, 844, "phone")):
            page.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                         {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
            time.sleep(0.7)
            sideways = page.js("return document.documentElement.scrollWidth - window.innerWidth")
            assert sideways <= 0, f"the page is {sideways} pixels wider than a screen of {width}"
            picture = page.browser.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": width < 600, "clip": {
                "x": 0, "y": 0, "width": width, "scale": 1,
                "height": page.js("return document.documentElement.scrollHeight") if width < 600 else height}})
            (out / f"view-{name}-{theme}.png").write_bytes(base64.b64decode(picture["data"]))
    page.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def check_quiet(page):
    # Answers of 400 to wrong settings are in the log, and that this test reads pixels.
    allowed = ("willReadFrequently", "400 (", "ReadPixels", "kaustik live")
    messages = [entry for entry in page.browser.get_log("browser") if not any(text in entry["message"] for text in allowed)]
    messages = [entry for entry in messages if entry["level"] in ("SEVERE", "WARNING")]
    assert not messages, messages
    foreign = page.js("""
        return performance.getEntriesByType("resource").map(e => e.name)
          .filter(n => !n.startsWith(location.origin + location.pathname) && !n.startsWith("data:") && !n.startsWith("blob:"))""")
    assert not foreign, foreign


def check_end(page, mock):
    """Without the program the page keeps the picture and says so; a program at the same address is followed again."""
    page.js("RETRY_SECONDS.length = 2")  # a minute otherwise
    mock.process.kill()
    mock.process.wait()
    page.wait("document.getElementById('lost').hidden === false", "the page says that the connection is lost")
    assert page.js("return view.now().values.some(v => v > 0)")
    page.wait("!document.getElementById('again').hidden", "it gives up")
    assert page.find("save-exr").get_attribute("aria-disabled") == "true"
    with Mock("--port", mock.address.split(":")[-1].strip("/")):
        page.find("again").click()
        page.wait("document.getElementById('lost').hidden && view.status.state === 'running'", "it is back")
        page.wait("view.layers.slots.get('').render === 1 && view.layers.upToDate()", "the pixels of the new program arrive")
        page.browser.get("about:blank")


class Mock:
    def __init__(self, *options):
        command = [sys.executable, "-B", str(pathlib.Path(__file__).with_name("mock_server.py")), "--seconds", "20", *options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()


SCENE = pathlib.Path(__file__).resolve().parents[3] / "scenes/cornell-spheres/square-lamp-2.pbrt"


class Viewed:
    """`kaustik view`, by default with a render of photons that takes long enough."""

    LONG = ("--caustics", "photons", "--indirect", "photons",
            "--photons", "3M", "--spp", "400", "--passes", "40", "--width", "300", "--threads", "1")

    def __init__(self, program, options=LONG):
        self.process = subprocess.Popen([program, "view", SCENE, *options, "-q"], stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        assert self.process.wait(30) == 0, "the program ends well when it is told to"


def check(browser, address, out, downloads):
    page = Page(browser, address)
    page.open()
    check_first_picture(page)
    check_pause(page)
    check_layers(page)
    check_exposure(page)
    check_zoom(page)
    check_compare(page, out)
    check_save(page, downloads)
    drawers = []
    for fragment in ("#2d", ""):
        page.open(fragment)
        page.wait("view.layers.upToDate()", "the picture arrives again")
        drawers.append(page.js("return view.picture.drawer.name"))
        check_colours(page)
    if page.info["lab"]:
        check_estimate(page)
        check_cloud(page)
    check_screens(page, out)
    check_quiet(page)
    check_resume(page)
    check_stop(page)
    if page.info["lab"]:
        check_settings(page)
        check_quiet(page)
    return page, drawers


def check_reference(browser, program, out):
    """A render whose reference has the same settings but for the seed stands beside it, with the difference in numbers."""
    options = ["--width", "120", "--spp", "4", "--photons", "50k", "--denoise", "off"]
    reference = out / "reference.exr"
    subprocess.run([program, "render", SCENE, *options, "--seed", "7", "-o", reference, "-q"], check=True)
    with Viewed(program, [*options, "--reference", reference]) as viewed:
        page = Page(browser, viewed.address)
        page.open()
        page.wait("view.status.state === 'finished' && view.layers.upToDate()", "the render ends")
        page.wait("view.compare.chosen", "the reference is there")
        assert page.text("tag-left") == "reference: reference.exr", page.text("tag-left")
        page.wait("document.getElementById('compare-note').textContent.includes('relMSE')", "the difference is measured")
        given = array.array("f", page.fetch("reference"))
        assert len(given) == 3 * page.info["full_width"] * page.info["full_height"]
        shown = page.js("return Array.from(view.compare.other().values.slice(0, 3))")
        assert shown == list(given[:3]), (shown, given[:3])
        browser.save_screenshot(str(out / "reference.png"))
        leave(page)


def leave(page):
    """So that the end of the program is no error."""
    page.browser.get("about:blank")
    page.browser.get_log("browser")


def main():
    out = pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(out, ignore_errors=True)
    downloads = out / "downloads"
    downloads.mkdir(parents=True)
    browser = headless.open_browser(PAGE, GRAPHICS, downloads)
    try:
        if sys.argv[1] == "mock":
            with Mock("--size", "400x300", "--window", "50,30,250,170", "--no-lab") as mock:
                leave(check(browser, mock.address, out, downloads)[0])
            with Mock() as mock:
                page, drawers = check(browser, mock.address, out, downloads)
                check_end(page, mock)
        elif pathlib.Path(sys.argv[1]).is_file():
            with Viewed(sys.argv[1]) as viewed:
                page, drawers = check(browser, viewed.address, out, downloads)
                leave(page)
            check_reference(browser, sys.argv[1], out)
        else:
            page, drawers = check(browser, sys.argv[1], out, downloads)
    finally:
        browser.quit()
    print(f"drawn by {' and '.join(drawers)}; screenshots in {out}")


if __name__ == "__main__":
    main()
