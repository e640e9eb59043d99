"use strict";
// The laboratory: settings that render again, the estimates of a pixel, and the cloud of photons.

class Lab {
  constructor(view) {
    this.view = view;
    this.render = null;
    this.unsettled = true;
    for (const id of ["tabs", "settings-section", "estimate-section", "help-lab"]) byId(id).hidden = false;
    this.settings = new Settings(view.info.settings ?? [], () => this.keepLast());
    this.cloud = new Cloud(byId("cloud"));
    this.estimate = new EstimatePanel(estimate => this.cloud.markEstimate(estimate));
    this.listen();
  }

  // Keeps the last complete picture before the program renders again; one that has just begun would show nothing.
  keepLast() {
    const {compare, status} = this.view;
    const kept = compare.entries.some(entry => entry.automatic);
    if (status.state === "finished" || !kept) compare.keep(`before: ${this.settings.text()}`, true);
  }

  notice(status) {
    if (this.render !== null && status.render !== this.render) this.begin();
    this.render = status.render;
    // Photons of the new render are there when it finds its way to the pixels.
    const ready = status.phase === "render" || status.state === "finished";
    if (ready && this.cloudShown() && this.cloud.loaded !== status.render) this.loadCloud();
    if (ready && this.unsettled) {
      this.unsettled = false;
      this.update();
    }
    if (ready && this.stale && this.estimate.pixel) {
      this.stale = false;
      this.estimate.query(this.estimate.pixel.x, this.estimate.pixel.y);
    }
  }

  begin() {
    this.settings.begin();
    this.stale = this.unsettled = true;
    this.update();
  }

  // What the render makes of the settings is known when its pixels come.
  async update() {
    try {
      this.settings.update((await (await request("info")).json()).settings ?? []);
    } catch {
      // The fields stay as they are.
    }
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
