#!/usr/bin/python3
"""Serves the live page (apps/web/page) with a synthetic picture in place of a render: coarse to fine, then less noise with every
pass. Only for tests and for work on the page.

mock_server.py [--port 0] [--size 320x200] [--window X0,Y0,X1,Y1] [--seconds 8] [--passes 8] [--linger S] [--no-lab]

Prints the page's address. Ends S seconds after the render's end, or never."""
import argparse
import array
import http.server
import json
import math
import os
import pathlib
import random
import re
import struct
import sys
import threading
import time
import urllib.parse
import zlib

PAGE = pathlib.Path(__file__).resolve().parents[3] / "apps" / "web" / "page"
TILE = 64
COARSEST = 16  # pixels a side of the first blocks
RADIANCE = "W/(m^2 sr)"
LAYERS = [("", "all light", 3, RADIANCE), ("direct", "direct light", 3, RADIANCE), ("caustic", "caustics", 3, RADIANCE),
          ("emitted", "emitted light", 3, RADIANCE),
          ("error", "error", 3, RADIANCE), ("bias", "bias", 3, RADIANCE), ("albedo", "albedo", 3, ""),
          ("normal", "normal", 3, ""), ("depth", "depth", 1, "m"), ("photons", "photons", 1, "photons")]
CHANNELS = {**{name: channels for name, _, channels, _ in LAYERS}, "denoising_emitted": 3}
SETTINGS = [{"name": "photons", "value": "500k", "choices": [], "doc": "Number of photons to emit."},
            {"name": "radius", "value": "auto", "choices": [], "doc": "Gather radius r0 in metres, auto, or a multiple like 0.5x."},
            {"name": "kernel", "value": "constant", "choices": ["constant", "cone", "epanechnikov"],
             "doc": "Weight of a photon as a function of its distance."},
            {"name": "caustics", "value": "photons", "choices": ["photons", "paths", "off"], "doc": "Estimator of caustics."}]


def pixel(u, v):
    """The layers' values without noise at a place of a room, 0 <= u < 1, 0 <= v < 1: floor, walls, a lamp, a glass sphere."""
    out = {}
    if v > 0.62:
        depth, normal, albedo = 1.2 / (v - 0.4), (0, 1, 0), (0.7, 0.65, 0.6)
    elif u < 0.2:
        depth, normal, albedo = 2 + 8 * u, (1, 0, 0), (0.7, 0.15, 0.1)
    elif u > 0.8:
        depth, normal, albedo = 2 + 8 * (1 - u), (-1, 0, 0), (0.1, 0.5, 0.15)
    else:
        depth, normal, albedo = 5.0, (0, 0, 1), (0.7, 0.7, 0.7)
    x, y = (u - 0.42) * 1.6, v - 0.58
    ball = 0.03 - x * x - y * y
    if ball > 0:
        z = math.sqrt(ball)
        depth, normal, albedo = 3 - z, (x / 0.173, -y / 0.173, z / 0.173), (0.95, 0.95, 1.0)
    light = 0.9 / (1 + 6 * ((u - 0.5) ** 2 + (v - 0.1) ** 2))
    direct = tuple(light * a for a in albedo)
    d = math.hypot((u - 0.6) * 1.4, (v - 0.82) * 3)
    spot = 3.5 * math.exp(-(d / 0.06) ** 2) + 0.7 * math.exp(-((d - 0.2) / 0.03) ** 2) if v > 0.62 and ball <= 0 else 0
    lamp = 12.0 if abs(u - 0.5) < 0.09 and v < 0.06 else 0
    out["direct"] = (0, 0, 0) if lamp else direct
    out["caustic"] = (spot, 0.95 * spot, 0.8 * spot)
    out["emitted"] = (lamp, lamp, 0.9 * lamp)
    out["denoising_emitted"] = (0, 0, 0)
    out["albedo"], out["normal"] = albedo, normal
    out["depth"], out["photons"] = (depth,), (20 + 400 * spot,)
    return out


def scrambled(x, y, seed):
    """A number in [0, 1) that looks random."""
    h = (x * 73856093 ^ y * 19349663 ^ seed * 83492791) * 2654435761 & 0xffffffff
    h = (h ^ h >> 15) * 2246822519 & 0xffffffff
    return (h ^ h >> 13) / 2 ** 32


class Render:
    """The picture and its state; what clients ask of them. All functions are thread-safe."""

    def __init__(self, options):
        self.options = options
        self.width, self.height = options.size
        self.window = options.window or (0, 0, self.width, self.height)
        self.changed = threading.Condition()
        self.settings = {s["name"]: s["value"] for s in SETTINGS}
        self.render_id, self.version = 0, 0
        self.ended = False
        self.packed = {}
        x0, y0, x1, y1 = self.window
        self.truth = [pixel((x + 0.5) / self.width, (y + 0.5) / self.height) for y in range(y0, y1) for x in range(x0, x1)]
        self.begin()

    def begin(self):
        with self.changed:
            self.render_id += 1
            self.state, self.phase, self.stopped = "running", "photons", False
            self.done = 0.0            # seconds of work
            self.clock = time.monotonic()
            self.elapsed = 0.0
            self.step = 0              # 0: nothing; blocks of 16, 8, 4, 2, 1 pixels; then passes
            self.tiles = {}            # (x, y) -> version of the last change
            self.errors = []
            self.changed.notify_all()

    # The work: a step after each equal share of the time.
    def steps(self):
        return 2 + 5 + self.options.passes - 1

    def noise(self):
        """Relative noise of a pixel."""
        photons = 500e3
        match = re.match(r"([0-9.]+)([kMG]?)", self.settings["photons"])
        if match:
            photons = float(match[1]) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[match[2]]
        return min(1.5, 0.3 * math.sqrt(500e3 / photons) / math.sqrt(max(1, self.passes_done())))

    def passes_done(self):
        return max(0, self.step - 6)

    def block(self):
        """Pixels a side of the finest blocks so far."""
        return max(1, COARSEST >> max(0, self.step - 3)) if self.step > 2 else 0

    def run(self):
        while True:
            time.sleep(0.05)
            with self.changed:
                now = time.monotonic()
                if self.state == "running":
                    self.done += now - self.clock
                    self.elapsed += now - self.clock
                    while self.state == "running" and self.done > self.options.seconds * (self.step + 1) / self.steps():
                        self.advance()
                    if self.stopped:
                        self.state = "finished"
                        self.touch()
                self.clock = now
                self.changed.notify_all()

    def advance(self):
        self.step += 1
        self.phase = "photons" if self.step < 1 else "build" if self.step < 2 else "render"
        if self.step > 2:
            self.touch()
        if self.passes_done() >= 2:
            self.errors.append([round(self.elapsed, 4), self.passes_done(), self.noise() * 0.5])
        if self.step >= self.steps():
            self.state = "finished"

    def touch(self):
        self.version += 1
        x0, y0, x1, y1 = self.window
        for y in range(y0 // TILE * TILE, y1, TILE):
            for x in range(x0 // TILE * TILE, x1, TILE):
                self.tiles[x, y] = self.version

    def status(self):
        fraction = 1.0 if self.state == "finished" and not self.stopped else min(1, self.done / self.options.seconds)
        return {"render": self.render_id, "state": self.state, "phase": self.phase,
                "pass": min(max(1, self.step - 5), self.options.passes), "passes": self.options.passes, "fraction": fraction,
                "seconds_left": max(0, self.options.seconds - self.done) if self.step > 1 else None, "seconds": self.elapsed,
                "stopped": self.stopped, "version": self.version, "errors": self.errors}

    def value(self, layer, x, y, noise, block):
        x0, y0, x1, _ = self.window
        x, y = max(x // block * block, x0), max(y // block * block, y0)
        truth = self.truth[(y - y0) * (x1 - x0) + x - x0]
        if layer not in ("", "error", "bias", "direct", "caustic"):
            return truth[layer]
        n = 1 + noise * (scrambled(x, y, self.step * 31 + self.render_id) * 2 - 1)
        if layer in ("direct", "caustic"):
            return [n * v for v in truth[layer]]
        light = [n * d + max(0, 2 * n - 1) * c + e for d, c, e in zip(truth["direct"], truth["caustic"], truth["emitted"])]
        share = 1 if layer == "" else noise * 0.4 if layer == "error" else noise * (0.1 if x & 8 else -0.1)
        return [share * v for v in light]

    def pixels(self, layer, since):
        with self.changed:
            key = self.render_id, self.version, self.block(), self.noise()
            tiles = [tile for tile, version in self.tiles.items() if version > since]
        out = [struct.pack("<IIII", key[1] & 0xffffffff, key[1] >> 32, key[0], len(tiles))]
        return b"".join(out + [self.tile(layer, key, tile) for tile in tiles])

    def tile(self, layer, key, tile):
        """The bytes of a tile; clients at the same state share them."""
        name = layer, *key, tile
        found = self.packed.get(name)
        if found is None:
            _, _, block, noise = key
            x0, y0, x1, y1 = self.window
            left, top, right, bottom = max(tile[0], x0), max(tile[1], y0), min(tile[0] + TILE, x1), min(tile[1] + TILE, y1)
            values = array.array("f")
            for y in range(top, bottom):
                for x in range(left, right):
                    values.extend(self.value(layer, x, y, noise, block))
            found = struct.pack("<IIII", left, top, right - left, bottom - top) + values.tobytes()
            if len(self.packed) > 2000:
                self.packed.clear()
            self.packed[name] = found
        return found

    def info(self):
        x0, y0, x1, y1 = self.window
        return {"title": "room <b>&amp;</b>.pbrt", "program": "kaustik mock", "full_width": self.width, "full_height": self.height,
                "x0": x0, "y0": y0, "x1": x1, "y1": y1, "exposure": None, "tonemap": "filmic", "lab": self.options.lab,
                "layers": [dict(zip(("name", "label", "channels", "unit"), layer)) for layer in LAYERS],
                "settings": [{**s, "value": self.settings[s["name"]]} for s in SETTINGS] if self.options.lab else []}

    def change(self, wanted):
        """Returns what is wrong with these settings, or None once the render has begun again."""
        for name, value in wanted.items():
            rule = next((s for s in SETTINGS if s["name"] == name), None)
            if rule is None:
                return f"there is no setting {name}"
            if rule["choices"] and value not in rule["choices"]:
                return f"{name}: {value} is none of {', '.join(rule['choices'])}"
            if not rule["choices"] and not re.fullmatch(r"auto|[0-9.]+[kMGx]?", str(value)):
                return f"{name}: {value} is no number"
        with self.changed:
            self.settings.update(wanted)
        self.begin()
        return None


def photons(most):
    rng, out, count = random.Random(5), [], min(most, 30000)
    for _ in range(count):
        kind = rng.choices(range(4), (5, 2, 1, 4))[0]
        wall = rng.randrange(3)
        p = (rng.uniform(-2, 2), 0, rng.uniform(-2, 2)) if wall == 0 else (-2, rng.uniform(0, 3), rng.uniform(-2, 2)) \
            if wall == 1 else (2, rng.uniform(0, 3), rng.uniform(-2, 2))
        flux = (1e-3, 1e-3, 9e-4) if wall == 0 else (1e-3, 2e-4, 1e-4) if wall == 1 else (2e-4, 8e-4, 2e-4)
        if kind == 2:
            p = (rng.gauss(0.5, 0.15), 0, rng.gauss(0.4, 0.15))
        out.append(struct.pack("<6fI", *p, *flux, kind))
    return struct.pack("<I", count) + b"".join(out)


def cells(most):
    out = []

    def divide(low, side, depth):
        if len(out) >= most:
            return
        out.append(struct.pack("<6fII", *low, *(x + side for x in low), depth, 0))
        near = low[1] < 0.01 or low[0] < -1.99
        if depth < 5 and near:
            for corner in range(8):
                divide([x + side / 2 * (corner >> axis & 1) for axis, x in enumerate(low)], side / 2, depth + 1)
    divide([-2, 0, -2], 4, 0)
    return struct.pack("<I", len(out)) + b"".join(out)


def estimate(x, y, render):
    if y < render.height * 0.08:
        return {"hit": None, "maps": [], "cell": None}
    rng, point = random.Random(x * 1000 + y), [4 * x / render.width - 2, 0.0, 4 * y / render.height - 2]
    maps = []
    for kind, count, radius in (("caustic", 60, 0.05), ("indirect", 240, 0.2)):
        read = []
        for _ in range(count):
            d, a = radius * math.sqrt(rng.random()), rng.uniform(0, 2 * math.pi)
            read.append([point[0] + d * math.cos(a), 0.0, point[2] + d * math.sin(a), 1e-4 * rng.random(), 8e-5 * rng.random(),
                         6e-5 * rng.random(), d, 1 - d / (1.1 * radius)])
        maps.append({"kind": kind, "radius": radius, "kernel": "cone", "radiance": [0.4, 0.3, 0.2], "accepted": count, "photons": read})
    trusted = x % 2 == 0
    reason = "71 direct photons are more than M0 = 8, no shadow photon is in the cell, and the faces are farther than r0." if trusted \
        else "The cell holds 3 shadow photons."
    return {"hit": {"point": point, "normal": [0, 1, 0], "distance": 4.2, "material": "floor"}, "maps": maps,
            "cell": {"min": [point[0] - 0.12, -0.1, point[2] - 0.2], "max": [point[0] + 0.13, 0.15, point[2] + 0.05], "depth": 4,
                     "direct": 71, "shadow": 0 if trusted else 3, "trusted": trusted, "reason": reason}}


def png(width, height, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    raw = b"".join(b"\0" + row for row in rows)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + \
        chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def page():
    """The page as the program assembles it: scripts in alphabetical order, view.js last."""
    html = (PAGE / "view.html").read_text()
    scripts = "\n".join(file.read_text() for file in sorted(PAGE.glob("*.js")))
    return html.replace("{{style}}", (PAGE / "view.css").read_text()).replace("{{script}}", scripts)


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    render = None

    def log_message(self, *_):
        pass

    def reply(self, status, kind, body, more=()):
        body = body.encode() if isinstance(body, str) else body
        self.send_response(status)
        for name, value in (("Content-Type", kind), ("Content-Length", str(len(body))), ("Cache-Control", "no-store"), *more):
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def fail(self, status, text):
        self.reply(status, "application/json", json.dumps({"error": text}))

    def do_GET(self):
        url = urllib.parse.urlsplit(self.path)
        query = dict(urllib.parse.parse_qsl(url.query, keep_blank_values=True))
        lab = self.render.options.lab
        if url.path == "/":
            self.reply(200, "text/html; charset=utf-8", page())
        elif url.path == "/info":
            self.reply(200, "application/json", json.dumps(self.render.info()))
        elif url.path == "/events":
            self.events()
        elif url.path == "/pixels" and query.get("layer") in CHANNELS:
            self.reply(200, "application/octet-stream", self.render.pixels(query["layer"], int(query.get("since", 0))))
        elif url.path == "/save" and query.get("format") in ("exr", "png"):
            self.save(query)
        elif lab and url.path == "/photons":
            self.reply(200, "application/octet-stream", photons(int(query.get("most", 200000))))
        elif lab and url.path == "/cells":
            self.reply(200, "application/octet-stream", cells(int(query.get("most", 20000))))
        elif lab and url.path == "/estimate":
            self.reply(200, "application/json", json.dumps(estimate(int(query["x"]), int(query["y"]), self.render)))
        else:
            self.fail(404, f"there is no {url.path} with these parameters")

    def do_POST(self):
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        render = self.render
        if self.path == "/render" and render.options.lab:
            problem = render.change(json.loads(body))
            if problem:
                return self.fail(400, problem)
            return self.reply(202, "application/json", json.dumps({"render": render.render_id}))
        with render.changed:
            if self.path == "/pause" and render.state == "running":
                render.state = "paused"
            elif self.path == "/resume" and render.state == "paused":
                render.state = "running"
            elif self.path == "/stop":
                render.stopped = True
                render.state = "running" if render.state == "paused" else render.state
            elif self.path not in ("/pause", "/resume"):
                return self.fail(404, f"there is no {self.path}")
            render.changed.notify_all()
        self.send_response(204)
        self.end_headers()

    def events(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Cache-Control", "no-store")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        try:
            while not self.render.ended:
                with self.render.changed:
                    told = json.dumps(self.render.status())
                self.wfile.write(f"event: status\ndata: {told}\n\n".encode())
                self.wfile.flush()
                time.sleep(0.1)
        except OSError:
            pass  # the page has gone

    def save(self, query):
        render, kind = self.render, query["format"]
        if kind == "exr":
            body = b"v/1\x01 a mock"
        else:
            x0, y0, x1, y1 = render.window
            gain = 2 ** float(query.get("exposure", 0))
            rows = [bytes(min(255, int(255 * (gain * v) ** 0.45)) for x in range(x0, x1) for v in render.value("", x, y, 0, 1))
                    for y in range(y0, y1)]
            body = png(x1 - x0, y1 - y0, rows)
        self.reply(200, f"image/{'x-exr' if kind == 'exr' else 'png'}", body,
                   [("Content-Disposition", f'attachment; filename="room.{kind}"')])


def numbers(separator, count):
    def read(text):
        values = tuple(int(v) for v in text.split(separator))
        if len(values) != count:
            raise argparse.ArgumentTypeError(f"{text} is not {count} numbers")
        return values
    return read


def read_options():
    parser = argparse.ArgumentParser()
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--size", type=numbers("x", 2), default=(320, 200))
    parser.add_argument("--window", type=numbers(",", 4))
    parser.add_argument("--seconds", type=float, default=8, help="of a render")
    parser.add_argument("--passes", type=int, default=8)
    parser.add_argument("--linger", type=float, help="seconds until the program ends after the render")
    parser.add_argument("--no-lab", dest="lab", action="store_false")
    return parser.parse_args()


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 64

    def handle_error(self, request, client_address):
        """Pages may leave while they are answered."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)


def main():
    options = read_options()
    render = Handler.render = Render(options)
    server = Server(("127.0.0.1", options.port), Handler)
    threading.Thread(target=render.run, daemon=True).start()
    threading.Thread(target=server.serve_forever, daemon=True).start()
    print(f"http://127.0.0.1:{server.server_address[1]}/", flush=True)
    try:
        while options.linger is None or render.state != "finished":
            time.sleep(0.1)
        time.sleep(options.linger)
    except KeyboardInterrupt:
        pass
    render.ended = True
    time.sleep(0.2)
    os._exit(0)  # threads of open connections do not hold the program


if __name__ == "__main__":
    main()
