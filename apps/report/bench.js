"use strict";
// Draws the scaling charts of a benchmark, whose result the page holds as JSON.
(() => {
const data = JSON.parse(byId("data").textContent);
const PHASES = [["total", "total"], ["photon_trace", "photon trace"], ["photon_build", "photon map build"],
                ["render", "image"], ["bvh", "BVH build"]];
const WORTH_DRAWING = 0.01;  // of the total time

const unique = values => [...new Set(values)].sort((a, b) => a - b);
const plural = (n, noun) => `${n} ${noun}${n === 1 ? "" : "s"}`;
// Points whose photons grow with the threads are in the table only.
data.points = data.points.filter(p => !p.photons_per_thread);
const of = photons => data.points.filter(p => p.photons === photons);
const photonCounts = unique(data.points.map(p => p.photons));
const worthDrawing = (phase, points) =>
  points.some(p => p.seconds[phase].median >= WORTH_DRAWING * p.seconds.total.median);

// A point with the ends of its bar. Logarithmic axes have no place for 0.
const sample = (x, spread) => ({x, y: spread.median, low: spread.min, high: spread.max});
const drawable = points => sorted(points.filter(p => p.low > 0 && Number.isFinite(p.high)));
const ideal = (name, x0, y0, x1, y1) =>
  ({label: name, data: [{x: x0, y: y0}, {x: x1, y: y1}], borderColor: colour("guide"), backgroundColor: "transparent",
    borderDash: [6, 4], borderWidth: 1.5, pointStyle: "line",
    pointRadius: 0, pointHitRadius: 0, showLine: true});

const ranges = {
  id: "ranges",
  afterDatasetsDraw(chart) {
    const context = chart.ctx;
    chart.data.datasets.forEach((set, i) => {
      if (!chart.isDatasetVisible(i)) return;
      context.strokeStyle = set.borderColor();
      context.lineWidth = 1;
      for (const p of set.data) {
        if (!(p.high > p.low)) continue;
        const x = chart.scales.x.getPixelForValue(p.x);
        context.beginPath();
        context.moveTo(x, chart.scales.y.getPixelForValue(p.low));
        context.lineTo(x, chart.scales.y.getPixelForValue(p.high));
        context.stroke();
      }
    });
  }};

// An axis with ticks at these values alone.
function axisWithTicks(title, format, values) {
  const scale = logAxis(title, format, values);
  scale.ticks.callback = value => format(value);
  scale.afterBuildTicks = axis => { axis.ticks = values.map(value => ({value})); };
  return scale;
}

function tooltip(item) {
  const p = item.raw, range = p.high > p.low ? ` (${short(p.low)} to ${short(p.high)})` : "";
  return `${item.dataset.label}: ${short(p.y)}${range}`;
}

// In a section of its own. Ideal lines, which have the same name, are named once in the legend.
function draw(id, title, datasets, x, yTitle, format) {
  const section = document.createElement("section"), heading = document.createElement("h2"),
        box = document.createElement("div"), canvas = document.createElement("canvas");
  heading.textContent = title;
  box.className = "chart tall";
  canvas.id = id;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${title}, on logarithmic scales. The table below has the same numbers.`);
  box.append(canvas);
  section.append(heading, box);
  byId("charts").append(section);
  const values = datasets.flatMap(d => d.data.flatMap(p => [p.y, p.low ?? p.y, p.high ?? p.y]));
  const first = datasets.findIndex(d => d.borderDash);
  new Chart(canvas, {
    type: "scatter",
    data: {datasets},
    options: {
      animation: false, maintainAspectRatio: false, responsive: true,
      interaction: {mode: "nearest", intersect: true},
      scales: {x, y: logAxis(yTitle, format, values)},
      plugins: {legend: {position: "bottom", labels: {usePointStyle: true, boxWidth: 7, boxHeight: 7, padding: 14,
                         filter: item => !datasets[item.datasetIndex].borderDash || item.datasetIndex === first}},
                tooltip: {callbacks: {label: tooltip}}}},
    plugins: [ranges]});
}

const threadAxis = () => axisWithTicks("threads", String, unique(data.points.map(p => p.threads)));
const endsOf = points => [points[0], points[points.length - 1]];
const byThreads = points => [...points].sort((a, b) => a.threads - b.threads);

// The first point of a photon count is what the others are measured against.
function drawSpeedUp(photons) {
  const points = byThreads(of(photons)), base = of(photons)[0];
  const gain = (p, phase) => {
    const from = base.seconds[phase].median, here = p.seconds[phase];
    return {median: from / here.median, min: from / here.max, max: from / here.min};
  };
  const datasets = PHASES.filter(([phase]) => worthDrawing(phase, points)).map(([phase, name], i) =>
    dataset(name, drawable(points.map(p => sample(p.threads, gain(p, phase)))), i));
  const [least, most] = endsOf(points);
  datasets.push(ideal("ideal", least.threads, least.threads / base.threads, most.threads, most.threads / base.threads));
  draw(`speed-up-${countText(photons)}`, `Speed-up, ${countText(photons)} photons`, datasets, threadAxis(),
       `speed-up over ${plural(base.threads, "thread")}`, short);
}

function drawPhotonRate() {
  const datasets = [], lines = [];
  photonCounts.forEach((photons, i) => {
    const points = byThreads(of(photons)), [least, most] = endsOf(points), base = of(photons)[0];
    const perThread = base.per_second.photons.median / base.threads;
    datasets.push(dataset(`${countText(photons)} photons`,
                          drawable(points.map(p => sample(p.threads, p.per_second.photons))), i));
    if (perThread > 0)
      lines.push(ideal("ideal", least.threads, least.threads * perThread, most.threads, most.threads * perThread));
  });
  draw("photons-per-second", "Photons traced per second", [...datasets, ...lines], threadAxis(), "photons per second",
       countText);
}

function drawPhotonCounts() {
  const threads = Math.max(...data.points.map(p => p.threads));
  const points = data.points.filter(p => p.threads === threads);
  const datasets = PHASES.filter(([phase]) => worthDrawing(phase, points)).map(([phase, name], i) =>
    dataset(name, drawable(points.map(p => sample(p.photons, p.seconds[phase]))), i));
  const trace = datasets.find(d => d.label === "photon trace");
  if (trace && trace.data.length) {
    const [first, last] = endsOf(trace.data);
    datasets.push(ideal("proportional", first.x, first.y, last.x, first.y * last.x / first.x));
  }
  draw("seconds-over-photons", `Time over photons, ${plural(threads, "thread")}`, datasets,
       axisWithTicks("photons emitted", countText, unique(points.map(p => p.photons))), "time [s]", short);
}

photonCounts.forEach(drawSpeedUp);
if (data.points.some(p => p.per_second.photons.median > 0)) drawPhotonRate();
if (photonCounts.length > 1) drawPhotonCounts();
})();
