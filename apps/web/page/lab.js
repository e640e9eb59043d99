"use strict";
// The laboratory: settings that render again at once, and what the estimates of a pixel read.

const RENDER_AFTER = 500;   // milliseconds after the last change of a setting
const SLIDER_STEPS = 40;    // of a setting's slider, from 1/32 to 32 times its first value

// A number with the suffix of its writing: counts (500k), multiples (0.5x) and plain numbers. "auto" counts as 1x.
function numberOf(text) {
  if (text === "auto") return {value: 1, multiple: true, write: x => x === 1 ? "auto" : `${short(x)}x`};
  const parts = /^([0-9.]+(?:e[-+]?\d+)?)([kMGx]?)$/.exec(text.trim());
  if (!parts || !(Number(parts[1]) > 0)) return null;
  const factor = {"": 1, k: 1e3, M: 1e6, G: 1e9, x: 1}[parts[2]];
  const write = parts[2] === "x" ? x => `${short(x)}x` : parts[2] || /^\d{4,}$/.test(parts[1])
    ? x => countText(Math.round(x)) : Number.isInteger(Number(text)) ? x => String(Math.max(1, Math.round(x))) : short;
  return {value: Number(parts[1]) * factor, multiple: parts[2] === "x", write};
}

class Settings {
  // onRender(names and values): before the program is asked to render with them.
  constructor(settings, onRender) {
    this.onRender = onRender;
    this.fields = new Map();
    this.changed = new Map();   // what the user has changed so far
    for (const setting of settings) byId("settings").append(this.field(setting));
  }

  field(setting) {
    const id = `setting-${setting.name}`, help = make("span", {id: `${id}-doc`, class: "doc"}, setting.doc ?? "");
    const label = make("label", {for: id}, setting.label ?? setting.name);
    const changed = () => this.change(setting.name, input.value);
    let input, slider = null;
    if (setting.choices.length) {
      input = make("select", {id, change: changed}, ...setting.choices.map(c => new Option(c, c)));
      if (!setting.choices.includes(setting.value)) input.prepend(new Option(setting.value, setting.value));
      input.value = setting.value;
    } else {
      input = make("input", {id, type: "text", value: setting.value, autocomplete: "off", spellcheck: "false", change: changed});
      slider = this.slider(setting, input, changed);
    }
    input.setAttribute("aria-describedby", `${id}-doc`);
    this.fields.set(setting.name, input);
    return make("div", {class: "setting"}, label, input, ...(slider ? [slider] : []), help);
  }

  // A slider beside a number, logarithmic, or null. It follows what is typed.
  slider(setting, input, changed) {
    const first = numberOf(setting.value), half = SLIDER_STEPS / 2;
    if (!first) return null;
    const slider = make("input", {type: "range", min: -half, max: half, step: 1, value: 0, "aria-label": `${setting.name}, slider`,
      input: () => {
        input.value = first.write(first.value * 2 ** (slider.value / half * 5));
        slider.setAttribute("aria-valuetext", input.value);
        changed();
      }});
    input.addEventListener("change", () => {
      const typed = numberOf(input.value);
      if (typed && typed.multiple === first.multiple) slider.value = String(Math.log2(typed.value / first.value) * half / 5);
    });
    return slider;
  }

  change(name, value) {
    this.changed.set(name, value.trim());
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.render(), RENDER_AFTER);
  }

  async render() {
    const problem = byId("settings-problem"), chosen = Object.fromEntries(this.changed);
    this.onRender();
    try {
      await request("render", {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(chosen)});
      problem.textContent = "";
    } catch (error) {
      problem.textContent = error.message;
    }
    for (const [name, field] of this.fields) field.setAttribute("aria-invalid", String(problem.textContent.includes(name)));
  }

  // In words, for the name of a picture that is kept.
  text() { return [...this.fields].slice(0, 3).map(([name, field]) => `${name} ${field.value}`).join(", "); }
}

const triple = v => v.map(short).join("  ");

// The panel of a pixel's estimate.
class EstimatePanel {
  // onEstimate(estimate or null): for those who mark its point.
  constructor(onEstimate) {
    this.onEstimate = onEstimate;
    this.estimate = null;
    this.dots = [];
    byId("estimate-map").addEventListener("change", () => this.draw());
    byId("disc").addEventListener("pointermove", event => this.hover(event));
    byId("disc").addEventListener("pointerleave", () => { byId("disc-photon").textContent = ""; });
    new ResizeObserver(() => this.draw()).observe(byId("disc"));
  }

  async query(x, y) {
    this.pixel = {x, y};
    const turn = this.turn = (this.turn ?? 0) + 1;
    byId("estimate-title").textContent = `Pixel ${x}, ${y}`;
    byId("estimate-note").textContent = "Asking the program\u2026";
    try {
      const estimate = await (await request(`estimate?x=${x}&y=${y}`)).json();
      if (turn === this.turn) this.show(estimate);
    } catch (problem) {
      if (turn === this.turn) this.clear(`No estimate: ${problem.message}`);
    }
  }

  clear(text) {
    this.estimate = null;
    byId("estimate-note").textContent = text;
    byId("estimate-body").hidden = true;
    this.onEstimate(null);
    announce(text);
  }

  show(estimate) {
    if (!estimate.hit) return this.clear("The camera ray meets no surface.");
    this.estimate = estimate;
    const select = byId("estimate-map"), before = select.value, {hit} = estimate;
    select.replaceChildren(...estimate.maps.map(map => new Option(`${map.kind}, ${map.accepted} photons`, map.kind)));
    if (estimate.maps.some(map => map.kind === before)) select.value = before;
    byId("estimate-note").textContent = `${hit.material || "A surface"} at ${short(hit.distance)} m.`;
    byId("estimate-body").hidden = false;
    this.showCell(estimate.cell);
    this.draw();
    this.onEstimate(estimate);
    announce(`Estimate of pixel ${this.pixel.x}, ${this.pixel.y}: ${estimate.maps.map(m => `${m.accepted} ${m.kind} photons`).join(", ")}`);
  }

  map() { return this.estimate?.maps.find(map => map.kind === byId("estimate-map").value) ?? null; }

  draw() {
    const map = this.map();
    byId("disc-box").hidden = !map;
    if (!this.estimate) return;
    const {hit} = this.estimate;
    const rows = [["point", `${triple(hit.point)} m`], ["normal", triple(hit.normal)]];
    if (map) {
      rows.push(["radius", `${short(map.radius)} m`], ["kernel", map.kernel], ["photons", String(map.accepted)],
                ["radiance", `${triple(map.radiance)} W/(m\u00b2 sr)`]);
      this.dots = drawDisc(byId("disc"), this.estimate, map);
    }
    byId("estimate-facts").replaceChildren(...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
  }

  showCell(cell) {
    const box = byId("cell");
    box.hidden = !cell;
    if (!cell) return;
    const size = cell.max.map((x, i) => short(x - cell.min[i])).join(" x ");
    box.dataset.trusted = String(cell.trusted);
    box.replaceChildren(
      make("strong", {}, cell.trusted ? "The lecture's test trusts the cell" : "The lecture's test does not trust the cell"),
      make("span", {}, `${cell.reason}`),
      make("span", {}, `Depth ${cell.depth}, ${size} m, ${cell.direct} direct and ${cell.shadow} shadow photons.`));
  }

  hover(event) {
    const box = event.target.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    let best = null, least = 15;
    for (const dot of this.dots) {
      const distance = Math.hypot(dot[0] - x, dot[1] - y);
      if (distance < least) best = dot[2], least = distance;
    }
    byId("disc-photon").textContent = best
      ? `flux ${triple(best.slice(3, 6))} W, distance ${short(best[6])} m, weight ${short(best[7])}` : "";
  }
}

// The laboratory as a whole: its panels, the tab of the cloud, and what a render that begins means for them.
class Lab {
  constructor(view) {
    this.view = view;
    this.render = null;
    for (const id of ["tabs", "settings-section", "estimate-section", "help-lab"]) byId(id).hidden = false;
    this.settings = new Settings(view.info.settings ?? [], () => this.keepLast());
    this.shownSettings = this.settings.text();
    this.cloud = new Cloud(byId("cloud"));
    this.estimate = new EstimatePanel(estimate => this.cloud.markEstimate(estimate));
    this.listen();
  }

  // Keeps the last complete picture before the program renders again; one that has just begun would show nothing.
  keepLast() {
    const {compare, status} = this.view;
    const kept = compare.entries.some(entry => entry.automatic);
    if (status.state === "finished" || !kept) compare.keep(`before: ${this.shownSettings}`, true);
  }

  notice(status) {
    if (this.render !== null && status.render !== this.render) this.begin();
    this.render = status.render;
    // Photons of the new render are there when it finds its way to the pixels.
    const ready = status.phase === "render" || status.state === "finished";
    if (ready && this.cloudShown() && this.cloud.loaded !== status.render) this.loadCloud();
    if (ready && this.stale && this.estimate.pixel) {
      this.stale = false;
      this.estimate.query(this.estimate.pixel.x, this.estimate.pixel.y);
    }
  }

  begin() {
    this.shownSettings = this.settings.text();
    this.stale = true;
  }

  pick(x, y) {
    const {picture, info} = this.view;
    picture.mark = {x, y};
    picture.redraw();
    this.stale = false;
    byId("to-estimate").hidden = false;
    this.estimate.query(x + info.x0, y + info.y0);
    if (matchMedia("(min-width: 821px)").matches) byId("estimate-section").scrollIntoView({block: "nearest"});
  }

  cloudShown() { return !byId("cloud-view").hidden; }

  toggle() { this.showTab(!this.cloudShown()); }

  showTab(cloud) {
    byId("picture-view").hidden = cloud;
    byId("cloud-view").hidden = !cloud;
    for (const [id, on] of [["tab-picture", !cloud], ["tab-cloud", cloud]]) {
      byId(id).setAttribute("aria-selected", String(on));
      byId(id).tabIndex = on ? 0 : -1;
    }
    for (const control of document.querySelectorAll(".zooms > :not(#full-screen), .layer")) control.hidden = cloud;
    if (cloud && this.cloud.loaded !== this.render) this.loadCloud();
    this.cloud.redraw();
  }

  async loadCloud() {
    if (this.loading || this.view.layers.offline) return;
    this.loading = true;
    const note = byId("cloud-note"), render = this.render;
    note.hidden = false;
    note.textContent = "Fetching the photons\u2026";
    try {
      await this.cloud.load(render);
      note.hidden = this.cloud.photons.count > 0;
      note.textContent = "There are no photons.";
      this.showKinds();
      announce(`${this.cloud.photons.count} photons`);
    } catch (problem) {
      this.cloud.loaded = render;  // not again with every event
      note.textContent = `No photons: ${problem.message}`;
    } finally {
      this.loading = false;
    }
  }

  // The legend, which switches the kinds, and the range of the octree's depths.
  showKinds() {
    const {counts} = this.cloud.photons, {deepest, count} = this.cloud.cells, depth = byId("cloud-depth");
    byId("kinds").replaceChildren(...KINDS.map((kind, i) => {
      const box = make("input", {type: "checkbox", id: `kind-${kind}`,
        change: event => { this.cloud.shown[i] = event.target.checked ? 1 : 0; this.cloud.redraw(); }});
      box.checked = Boolean(this.cloud.shown[i]);
      const dot = make("i", {"aria-hidden": "true"});
      dot.style.background = KIND_COLOURS[i];
      return make("label", {}, box, dot, `${kind} ${countText(counts[i])}`);
    }));
    depth.max = String(deepest);
    depth.disabled = count === 0;
    if (!this.depthChosen) depth.value = String(Math.min(3, deepest));
    this.showDepth();
  }

  showDepth() { byId("cloud-depth-text").textContent = byId("cloud-depth").value; }

  listen() {
    byId("tab-picture").addEventListener("click", () => this.showTab(false));
    byId("tab-cloud").addEventListener("click", () => this.showTab(true));
    byId("tabs").addEventListener("keydown", event => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      event.preventDefault();
      this.toggle();
      byId(this.cloudShown() ? "tab-cloud" : "tab-picture").focus();
    });
    for (const id of ["cloud-flux", "cloud-size", "cloud-cells"]) byId(id).addEventListener("input", () => this.cloud.redraw());
    byId("cloud-depth").addEventListener("input", () => {
      this.depthChosen = true;
      byId("cloud-cells").checked = true;
      this.showDepth();
      this.cloud.redraw();
    });
    byId("cloud-up").addEventListener("change", event => { this.cloud.up = Number(event.target.value); this.cloud.redraw(); });
    byId("cloud-home").addEventListener("click", () => { if (this.cloud.photons) this.cloud.home(); });
    byId("cloud-load").addEventListener("click", () => this.loadCloud());
  }
}
