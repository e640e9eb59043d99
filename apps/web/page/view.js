"use strict";
// Puts the page together: the picture in its layer and tone, the keys, the theme, and the laboratory where there is one.

const AUTO_EVERY = 1500;        // milliseconds between computations of the automatic exposure
const LIGHTS_EVERY = 10000;     // and between fetches of the lights that it leaves out
const LIGHT_LAYERS = ["emitted", SHOWN_BY_OTHERS.name];  // all emitted light, and the part not seen directly

class View {
  constructor(info) {
    this.info = info;
    this.layer = info.layers[0].name;
    this.look = {gain: 1, operator: OPERATORS.includes(info.tonemap) ? info.tonemap : "srgb"};
    this.exposure = info.exposure ?? 0;
    this.automatic = info.exposure === null;
    this.lightsAt = -Infinity;
    this.showTexts();
    this.layers = new Layers(info, picture => this.arrived(picture));
    this.compare = new Compare(this.layers, () => this.now(), () => this.look, () => this.picture?.redraw());
    this.compare.nameNow = () => this.nameOfState();
    this.picture = new PictureView(byId("stage"), this.layers.width, this.layers.height, () => this.frame(),
      {onHover: pixel => this.hover(pixel), onPick: (x, y) => this.pick(x, y), onMoved: () => this.showZoom()});
    this.meter = throttled(AUTO_EVERY, () => this.expose());
    this.fitRange = throttled(500, () => { this.now().fitRange(); this.showRamp(); this.picture.redraw(); });
    this.status = new StatusPanel(info.title, {savePng: () => this.savePng(), tryAgain: () => this.connection.tryAgain()});
    this.lab = info.lab ? new Lab(this) : null;
    this.listen();
    this.setExposure(this.exposure);
    this.choose(this.layer);
    if (info.reference)
      this.compare.loadReference(info.reference).catch(problem => console.info(`reference: ${problem.message}`));
    this.connection = new Connection({onStatus: status => this.notice(status), onLost: again => this.lose(again),
                                      onBack: () => this.back()});
  }

  now() { return this.layers.picture(this.layer); }

  frame() {
    return {now: this.now(), other: this.compare.other(), look: this.look, split: this.compare.split,
            difference: this.compare.difference()};
  }

  showTexts() {
    const {info} = this;
    byId("title").textContent = info.title;
    byId("title").title = info.title;
    document.documentElement.style.setProperty("--ratio", String((info.y1 - info.y0) / (info.x1 - info.x0)));
    byId("program").textContent = info.program;
    document.title = info.title;
    for (const layer of info.layers) byId("layer").add(new Option(layer.label || layer.name, layer.name));
    for (const operator of OPERATORS) byId("operator").add(new Option(operator, operator));
    byId("operator").value = this.look.operator;
  }

  nameOfState() {
    const {status} = this.status;
    return status ? `kept at ${durationText(status.seconds)}${status.pass > 1 ? `, pass ${status.pass}` : ""}` : "kept";
  }

  notice(status) {
    this.lab?.notice(status);
    this.layers.notice(status);
    this.status.notice(status);
    byId("tag-right").textContent = status.state === "finished" ? "now: finished" : "now";
  }

  lose(again) {
    this.layers.offline = true;
    this.status.connection(again ? "trying" : "gone");
  }

  // Another program may answer at the same address.
  async back() {
    let info;
    try {
      info = await (await request("info")).json();
    } catch {
      return;  // it is gone again, which the connection tells
    }
    const same = ["title", "full_width", "full_height", "x0", "y0", "x1", "y1"].every(name => info[name] === this.info[name]);
    if (!same) return location.reload();
    this.layers.forget();
    this.layers.offline = false;
    this.status.connection(null);
    this.layers.pump();
  }

  arrived(picture) {
    if (picture === this.now() || picture === this.now().radiance) {
      this.picture.redraw();
      if (picture.show === SHOW.ramp) this.fitRange();
      if (this.compare.chosen) this.compare.measure();
      if (this.hovered) this.hover(this.hovered);
    }
    if (picture.name === "" && this.automatic) this.meter();
  }

  // The layer that is shown, what it is relative to, and all light for the automatic exposure.
  wantLayers() {
    const wanted = [this.layer];
    if (this.now().show === SHOW.relative || this.automatic) wanted.push("");
    this.layers.want([...new Set(wanted)]);
  }

  choose(name) {
    this.layer = name;
    byId("layer").value = name;
    this.wantLayers();
    this.now().fitRange();
    this.showRamp();
    this.compare.refresh();
    this.hover(this.hovered ?? null);
    this.picture.redraw();
  }

  setExposure(stops) {
    this.exposure = clamp(stops, -MOST_STOPS, MOST_STOPS);
    this.look = {...this.look, gain: 2 ** this.exposure};
    byId("exposure").value = String(this.exposure);
    const text = `${this.exposure > 0 ? "+" : ""}${this.exposure.toFixed(2)} stops`;
    byId("exposure-text").textContent = text;
    byId("exposure").setAttribute("aria-valuetext", text);
    this.lookChanged();
  }

  lookChanged() {
    byId("automatic").checked = this.automatic;
    byId("save-png").href = `save?format=png&exposure=${this.exposure}&tonemap=${this.look.operator}`;
    if (this.compare.chosen) this.compare.measure();
    this.picture.redraw();
  }

  setByHand(stops) {
    this.automatic = false;
    this.setExposure(stops);
    this.wantLayers();
  }

  setAutomatic(on) {
    this.automatic = on;
    this.lookChanged();
    this.wantLayers();
    if (on) this.meter();
  }

  setOperator(name) {
    this.look = {...this.look, operator: name};
    byId("operator").value = name;
    this.lookChanged();
    if (this.automatic) this.meter();
  }

  async expose() {
    if (!this.automatic) return;
    await this.fetchLights();
    if (this.automatic) this.setExposure(automaticExposure(this.layers.picture(""), this.lights ?? null, this.look.operator));
  }

  // Light seen directly, which the automatic exposure leaves out: emitted - denoising_emitted.
  async fetchLights() {
    const last = this.status.state === "finished" && !this.lightsOfEnd;
    const {offline, slots} = this.layers;
    if (offline || !slots.has(LIGHT_LAYERS[0])) return;
    if (performance.now() < this.lightsAt + LIGHTS_EVERY && !last) return;
    this.lightsAt = performance.now();
    this.lightsOfEnd = this.status.state === "finished";
    if (!await this.layers.once(LIGHT_LAYERS)) return;
    const [all, shown] = LIGHT_LAYERS.map(name => this.layers.picture(name).values);
    this.lights = all.map((value, i) => value - shown[i]);
  }

  showZoom() {
    const zoom = (this.picture?.zoom ?? 1) * (devicePixelRatio || 1);
    byId("zoom").textContent = `${zoom < 10 ? short(Number((100 * zoom).toPrecision(3))) : Math.round(100 * zoom)} %`;
  }

  showRamp() {
    const now = this.now(), relative = now.show === SHOW.relative;
    byId("ramp").hidden = now.show !== SHOW.ramp && !relative;
    byId("ramp-low").textContent = relative ? "1 %" : short(now.low);
    byId("ramp-high").textContent = relative ? "100 % of the radiance" : `${short(now.high)} ${now.unit}`;
    byId("ramp-colours").getContext("2d").putImageData(new ImageData(relative ? RAMPS.heat : RAMPS.even, 256, 1), 0, 0);
  }

  textOfPixel({x, y}) {
    const now = this.now(), other = this.compare.other(), index = y * now.width + x;
    const valuesOf = picture => [...picture.values.subarray(index * picture.channels, (index + 1) * picture.channels)];
    const numbers = picture => picture.show === SHOW.encoded
      ? `${valuesOf(picture).map(v => Math.round(255 * v)).join("  ")} of 255` : valuesOf(picture).map(short).join("  ");
    const relative = now.show === SHOW.relative ? `  (${percent(relativeError(now.values, now.base, 3 * index))})` : "";
    const unit = now.unit ? ` ${now.unit.replace("^2", "\u00b2")}` : "";
    const left = other ? `; left ${numbers(other)}` : "";
    return `x ${x + this.info.x0}  y ${y + this.info.y0}:  ${numbers(now)}${unit}${relative}${left}`;
  }

  hover(pixel) {
    this.hovered = pixel;
    byId("readout").textContent = pixel ? this.textOfPixel(pixel) : `${this.info.full_width} x ${this.info.full_height} pixels`;
  }

  pick(x, y) {
    if (this.lab) this.lab.pick(x, y);
    else announce(this.textOfPixel({x, y}));
  }

  // Without the program: the layer as it is shown.
  savePng() {
    const canvas = make("canvas"), drawer = new CanvasDrawer(canvas), now = this.now().copy(this.now().radiance);
    drawer.coloured(now, this.look).toBlob(blob => {
      const link = make("a", {href: URL.createObjectURL(blob), download: `${this.info.title.replace(/\.\w+$/, "")}.png`});
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
  }

  listen() {
    const on = (id, event, fn) => byId(id).addEventListener(event, fn);
    on("layer", "change", event => this.choose(event.target.value));
    on("exposure", "input", event => this.setByHand(Number(event.target.value)));
    on("automatic", "change", event => this.setAutomatic(event.target.checked));
    on("operator", "change", event => this.setOperator(event.target.value));
    on("zoom-in", "click", () => this.picture.zoomTo(this.picture.zoom * 1.5));
    on("zoom-out", "click", () => this.picture.zoomTo(this.picture.zoom / 1.5));
    on("zoom-whole", "click", () => this.picture.fit());
    on("zoom-one", "click", () => this.picture.zoomTo(1 / (devicePixelRatio || 1)));
    on("full-screen", "click", () => this.fullScreen());
    addEventListener("keydown", event => this.key(event));
  }

  fullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else byId("views").requestFullscreen?.().catch(problem => announce(`No full screen: ${problem.message}`));
  }

  next(list, value, step) { return list[(list.indexOf(value) + step + list.length) % list.length]; }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
    if (event.target.closest("input:not([type=checkbox]), select, textarea, [role=slider], [role=tab]")) return;
    const names = this.info.layers.map(layer => layer.name);
    const actions = {
      f: () => this.fullScreen(),
      l: () => this.choose(this.next(names, this.layer, 1)), L: () => this.choose(this.next(names, this.layer, -1)),
      "[": () => this.setByHand(this.exposure - 0.25), "]": () => this.setByHand(this.exposure + 0.25),
      a: () => this.setAutomatic(!this.automatic), t: () => this.setOperator(this.next(OPERATORS, this.look.operator, 1)),
      c: () => this.compare.keepNow(), p: () => this.status.pause(), v: () => this.lab?.toggle(),
      d: () => {
        byId("difference").value = byId("difference").value === "0" ? "4" : "0";
        this.compare.refresh();
      }};
    const cloud = this.lab?.cloudShown();
    if (Object.hasOwn(actions, event.key)) actions[event.key]();
    else if (!(cloud ? this.lab.cloud.key(event) : this.picture.key(event))) return;
    event.preventDefault();
  }
}

// The theme of the system, until the button says otherwise.
function setUpTheme() {
  const dark = matchMedia("(prefers-color-scheme: dark)"), button = byId("theme");
  let chosen = null;
  try {
    chosen = localStorage.getItem("kaustik-theme");
  } catch {
    // Pages without storage forget the theme.
  }
  const show = () => {
    const theme = chosen ?? (dark.matches ? "dark" : "light");
    document.documentElement.dataset.theme = theme;
    button.textContent = theme === "dark" ? "Light" : "Dark";
    button.setAttribute("aria-label", `Change to a ${theme === "dark" ? "light" : "dark"} page`);
  };
  dark.addEventListener("change", show);
  button.addEventListener("click", () => {
    chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    try {
      localStorage.setItem("kaustik-theme", chosen);
    } catch {
      // As above.
    }
    show();
  });
  show();
}

function setUpHelp() {
  byId("help-open").addEventListener("click", () => byId("help").showModal());
  byId("help").addEventListener("click", event => { if (event.target === byId("help")) byId("help").close(); });
  addEventListener("keydown", event => {
    if (event.key !== "?" || event.target.closest("input, select")) return;
    event.preventDefault();
    if (!byId("help").open) byId("help").showModal();
  });
}

let view = null;

(async () => {
  setUpTheme();
  setUpHelp();
  try {
    view = new View(await (await request("info")).json());
  } catch (problem) {
    byId("lost").hidden = false;
    byId("lost-text").textContent = `The program does not answer as expected: ${problem.message}`;
    throw problem;
  }
})();
