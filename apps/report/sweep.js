"use strict";
// Draws the charts, the picture slider and the gallery from the JSON in the page. Texts are inserted as text nodes
// only, never as HTML.
(() => {
const data = JSON.parse(byId("data").textContent);
const cells = data.cells;

const PHASES = [["bvh", "BVH", 6], ["photon_trace", "photons", 4], ["photon_build", "maps", 5], ["render", "render", 0]];

const relative = cell => cell.error.relative_rmse;
const seconds = cell => cell.seconds.total.median;

// The name of a cell's series: the values of these keys that vary within the sweep.
const varies = key => new Set(cells.map(cell => cell[key])).size > 1;
function nameOf(cell, keys) {
  const parts = [];
  if (keys.includes("method") && varies("method")) parts.push(cell.method);
  if (keys.includes("spp") && varies("spp")) parts.push(`${cell.spp} spp`);
  if (keys.includes("photons") && cell.photons) parts.push(`N ${countText(cell.photons)}`);
  if (keys.includes("radius") && cell.radius) parts.push(`r0 ${cell.radius}`);
  return parts.join(", ") || cell.method;
}

// Groups cells that have the same values for these keys, in the order of the sweep: [{name, cells}].
function seriesBy(chosen, keys) {
  const groups = new Map();
  for (const cell of chosen) {
    const id = JSON.stringify(keys.map(key => cell[key]));
    if (!groups.has(id)) groups.set(id, {name: nameOf(cell, keys), cells: []});
    groups.get(id).cells.push(cell);
  }
  return [...groups.values()];
}

// A chart point; it stores the index of its cell for the tooltip.
const point = (cell, x, y) => ({x, y, cell: cells.indexOf(cell)});

function tooltip(item) {
  const cell = cells[item.raw.cell];
  const lines = [cell.flags, `relative error ${percent(relative(cell))}, ${secondsText(seconds(cell))}`];
  if (cell.r0) lines.push(`r0 ${short(cell.r0.largest)} m`);
  return lines;
}

// Moves points at 0, which a logarithmic axis cannot show, to a decade below the least of the others. Returns
// whether there are any.
function floorZeros(datasets, key) {
  const points = datasets.flatMap(d => d.data), above = points.map(p => p[key]).filter(value => value > 0);
  const floor = above.length ? Math.min(...above) / 10 : 1e-6;
  const zeros = points.filter(p => !(p[key] > 0));
  for (const p of zeros) p[key] = floor;
  return zeros.length > 0;
}

// x, y: functions that make an axis from the values along it.
function scatter(id, datasets, x, y) {
  const zeros = {x: floorZeros(datasets, "x"), y: floorZeros(datasets, "y")};
  const axis = (key, made) => {
    const scale = made(datasets.flatMap(d => d.data.map(p => p[key])));
    if (zeros[key]) scale.title.text += "; the lowest points are 0";
    return scale;
  };
  return new Chart(byId(id), {
    type: "scatter",
    data: {datasets},
    options: {
      animation: false, maintainAspectRatio: false, responsive: true,
      interaction: {mode: "nearest", intersect: true},
      scales: {x: axis("x", x), y: axis("y", y)},
      plugins: {legend: {position: "bottom", labels: {usePointStyle: true, boxWidth: 7, boxHeight: 7, padding: 14}},
                tooltip: {callbacks: {label: tooltip}}}}});
}

const SECONDS = values => logAxis("time [s]", short, values);
const ERROR = values => logAxis("relative error [%]", value => short(100 * value), values);
const PHOTONS = values => logAxis("photons emitted", countText, values);
const RADIUS = values => logAxis("gather radius r0 [m]", short, values);
const RELMSE = values => logAxis("relMSE", value => value.toExponential(0), values);

function drawErrorCharts() {
  const withPhotons = cells.filter(cell => cell.photons);
  const keys = ["method", "spp", "radius"];
  // Methods without photons vary with their samples.
  const without = seriesBy(cells.filter(cell => !cell.photons), ["method"]);
  const overTime = [...seriesBy(withPhotons, keys), ...without]
    .map((s, i) => dataset(s.name, s.cells.map(c => point(c, seconds(c), relative(c))), i));
  const front = sorted(cells.filter(c => c.pareto).map(c => point(c, seconds(c), relative(c))));
  overTime.push({label: "Pareto front", data: front, borderColor: colour("guide"), backgroundColor: "transparent",
                 borderWidth: 6, pointRadius: 10, pointBorderWidth: 2, pointStyle: "circle", showLine: true, stepped: "before",
                 pointHitRadius: 0, order: 9});
  scatter("error-time", overTime, SECONDS, ERROR);
  scatter("error-photons", seriesBy(withPhotons, keys).map((s, i) =>
    dataset(s.name, sorted(s.cells.map(c => point(c, c.photons, relative(c)))), i)), PHOTONS, ERROR);
  scatter("error-radius", seriesBy(withPhotons, ["method", "spp", "photons"]).map((s, i) =>
    dataset(s.name, sorted(s.cells.map(c => point(c, c.r0.largest, relative(c)))), i)), RADIUS, ERROR);
}

// Draws squared bias and variance of one method and sample count over radius or photons.
function drawParts() {
  const all = seriesBy(cells.filter(cell => cell.photons), ["method", "spp"]);
  const select = byId("parts-series"), axis = byId("parts-axis");
  all.forEach((s, i) => select.add(new Option(s.name, i)));
  select.parentElement.hidden = all.length < 2;
  axis.value = varies("radius") ? "r0" : "photons";
  let chart;
  const draw = () => {
    if (chart) chart.destroy();
    const radius = axis.value === "r0";
    const shown = all.length ? all[select.value].cells : [];
    const datasets = [];
    let hidden = 0;
    seriesBy(shown, [radius ? "photons" : "radius"]).forEach((s, i) => {
      const points = key => sorted(s.cells.filter(c => c.error[key] !== null)
        .map(c => point(c, radius ? c.r0.largest : c.photons, c.error[key])));
      const bias = points("bias2"), variance = points("variance");
      hidden += bias.filter(p => p.y <= 0).length;
      datasets.push(dataset(`bias\u00b2, ${s.name}`, bias.filter(p => p.y > 0), i));
      datasets.push(dataset(`variance, ${s.name}`, variance, i, {borderDash: [6, 4], backgroundColor: colour("paper")}));
    });
    byId("parts-note").textContent = data.seeds < 2 ? "They need at least two seeds."
      : hidden ? `${hidden} value${hidden > 1 ? "s" : ""} of bias\u00b2 at or below zero cannot be shown on a logarithmic axis.` : "";
    chart = scatter("error-parts", datasets, radius ? RADIUS : PHOTONS, RELMSE);
  };
  select.addEventListener("change", draw);
  axis.addEventListener("change", draw);
  draw();
}

function drawPhases() {
  byId("phases-box").style.height = `${6 + 1.5 * cells.length}rem`;
  const label = cell => nameOf(cell, ["method", "spp", "photons", "radius"]);
  new Chart(byId("phases"), {
    type: "bar",
    data: {labels: cells.map(label),
           datasets: PHASES.map(([key, name, series]) =>
             ({label: name, data: cells.map(c => c.seconds[key].median), backgroundColor: seriesColour(series)}))},
    options: {
      indexAxis: "y", animation: false, maintainAspectRatio: false, responsive: true,
      scales: {x: {stacked: true, title: {display: true, text: "time [s]"}, grid: {color: colour("grid")}},
               y: {stacked: true, grid: {display: false}, ticks: {autoSkip: false, font: {size: 11}}}},
      plugins: {legend: {position: "bottom", labels: {boxWidth: 12}},
                tooltip: {callbacks: {label: item => `${item.dataset.label}: ${secondsText(item.raw)}`}}}}});
}

// The choices of the picture slider: the reference, then every cell.
const label = cell => `${nameOf(cell, ["method", "spp", "photons", "radius"])}: ${percent(relative(cell))}, ${secondsText(seconds(cell))}`;
const choices = [{label: "reference", picture: data.reference.picture, map: null},
                 ...cells.map(c => ({label: label(c), picture: c.picture, map: c.error_map}))];

function setUpSlider() {
  const slider = byId("slider"), errors = byId("show-errors");
  const sides = ["left", "right"].map(side => ({choice: byId(`${side}-choice`), image: byId(`${side}-image`),
                                                tag: byId(`${side}-tag`)}));
  for (const side of sides) choices.forEach((c, i) => side.choice.add(new Option(c.label, i)));
  const best = cells.filter(c => c.pareto).sort((a, b) => relative(a) - relative(b))[0];
  sides[0].choice.value = 0;
  sides[1].choice.value = 1 + cells.indexOf(best);
  const show = () => {
    for (const side of sides) {
      const chosen = choices[side.choice.value];
      const map = errors.checked && chosen.map;
      side.image.src = data.pictures[map || chosen.picture];
      side.image.alt = `${map ? "Error map" : "Picture"}: ${chosen.label}`;
      side.tag.textContent = (map ? "error of " : "") + chosen.label;
    }
  };
  const move = () => {
    byId("right-image").style.clipPath = `inset(0 0 0 ${slider.value}%)`;
    byId("divider").style.left = `${slider.value}%`;
  };
  // Dragging on the picture moves the divider too.
  const drag = event => {
    const box = byId("compare").getBoundingClientRect();
    slider.value = 100 * (event.clientX - box.left) / box.width;
    move();
  };
  byId("compare").addEventListener("pointermove", event => { if (event.buttons) drag(event); });
  byId("compare").addEventListener("pointerdown", event => { event.preventDefault(); drag(event); });
  slider.addEventListener("input", move);
  for (const control of [errors, ...sides.map(side => side.choice)]) control.addEventListener("change", show);
  show();
  move();
}

function fillGallery() {
  const figure = (names, text) => {
    const element = document.createElement("figure"), row = document.createElement("div"),
          caption = document.createElement("figcaption");
    row.className = names.length > 1 ? "two" : "";
    for (const [name, alt] of names) {
      const image = new Image();
      image.src = data.pictures[name];
      image.alt = alt;
      row.append(image);
    }
    caption.textContent = text;
    element.append(row, caption);
    byId("gallery").append(element);
  };
  const front = cells.filter(c => c.pareto).sort((a, b) => seconds(a) - seconds(b));
  for (const c of front) figure([[c.picture, "picture"], [c.error_map, "its error map"]], label(c));
  figure([[data.reference.picture, "reference"]], "reference");
}

drawErrorCharts();
drawParts();
drawPhases();
setUpSlider();
fillGallery();
})();
