"use strict";
// What the density estimates of a pixel read: their discs, photons and numbers, and the octree cell of the lecture's test.

// What the picture makes of an estimate.
const USES = {
  added: "the picture adds it",
  subtracted: "the picture subtracts it from the unoccluded light",
  tested: "not gathered: the lecture\u2019s test counts these photons in its cell",
  refused: "not used: shadow rays decide here"};

const triple = v => v.map(short).join("  ");

// The panel of a pixel's estimate.
class EstimatePanel {
  // onEstimate(estimate or null): for those who mark its point.
  constructor(onEstimate) {
    this.onEstimate = onEstimate;
    this.estimate = null;
    this.dots = [];
    for (const id of ["estimate-map", "whole-cell"]) byId(id).addEventListener("change", () => this.draw());
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
    select.replaceChildren(...estimate.maps.map(map => new Option(`${map.kind}: ${countText(map.accepted)} read`, map.kind)));
    if (estimate.maps.some(map => map.kind === before)) select.value = before;
    byId("estimate-note").textContent = `${hit.material || "A surface"} at ${short(hit.distance)} m.`;
    byId("estimate-body").hidden = false;
    this.showCell(estimate.cell);
    this.draw();
    this.onEstimate(estimate);
    const counts = estimate.maps.map(map => `${map.accepted} ${map.kind} photons`).join(", ");
    announce(`Estimate of pixel ${this.pixel.x}, ${this.pixel.y}: ${counts || "no map is read"}`);
  }

  map() { return this.estimate?.maps.find(map => map.kind === byId("estimate-map").value) ?? null; }

  draw() {
    const map = this.map();
    byId("disc-box").hidden = !map;
    if (!this.estimate) return;
    const {hit} = this.estimate;
    const rows = hit.specular ? [["seen by way of", `${hit.specular} mirror${hit.specular > 1 ? "s" : ""} or glass`]] : [];
    rows.push(["point", `${triple(hit.point)} m`], ["normal", triple(hit.normal)]);
    if (map) {
      rows.push(["radius", `${short(map.radius)} m`], ["kernel", map.kernel], ["photons", String(map.accepted)],
                ["radiance", `${triple(map.radiance)} W/(m\u00b2 sr)`], ["use", USES[map.use] ?? map.use]);
      this.dots = drawDisc(byId("disc"), this.estimate, map, byId("whole-cell").checked);
    }
    byId("estimate-facts").replaceChildren(...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
  }

  showCell(cell) {
    const box = byId("cell");
    box.hidden = byId("whole-cell").parentElement.hidden = !cell;
    if (!cell) byId("whole-cell").checked = false;
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
      ? `flux ${triple(best.slice(3, 6))} W, distance ${short(best[6])} m, weight ${short(best[7])} /m\u00b2` : "";
  }
}
