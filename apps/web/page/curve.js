"use strict";
// The chart of the error against time, both on logarithmic scales, as SVG.

const CURVE = {width: 320, height: 200, left: 46, right: 10, top: 8, bottom: 36};
const MOST_POINTS = 500;

function svg(tag, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// Ticks at 1, 2 and 5 times powers of ten, fewer on long axes.
function logTicks(least, most) {
  const decades = Math.log10(most / least), wanted = decades > 2.5 ? [1] : decades > 1 ? [1, 3] : [1, 2, 3, 5, 7];
  const ticks = [];
  for (let power = Math.floor(Math.log10(least)); power <= Math.log10(most); ++power)
    for (const digit of wanted) {
      const tick = digit * 10 ** power;
      if (tick >= least * 0.999 && tick <= most * 1.001) ticks.push(Number(tick.toPrecision(3)));
    }
  return ticks;
}

// The range of an axis: at least half a decade, with a margin.
function logRange(values) {
  const least = Math.min(...values), most = Math.max(...values);
  const margin = Math.max(1.15, Math.sqrt(10 ** 0.5 * least / most));
  return [least / margin, most * margin];
}

// points: [seconds, passes, relative error].
function drawCurve(box, points) {
  const some = Math.ceil(points.length / MOST_POINTS), last = points[points.length - 1];
  const drawable = points.filter((p, i) => (i % some === 0 || p === last) && p[0] > 0 && p[2] > 0 && Number.isFinite(p[2]));
  box.toggleAttribute("hidden", !drawable.length);  // SVG elements have no property of this name
  byId("curve-none").hidden = drawable.length > 0;
  if (!drawable.length) return;
  const {width, height, left, right, top, bottom} = CURVE;
  const [x0, x1] = logRange(drawable.map(p => p[0])), [y0, y1] = logRange(drawable.map(p => p[2]));
  const px = x => left + Math.log(x / x0) / Math.log(x1 / x0) * (width - left - right);
  const py = y => top + Math.log(y1 / y) / Math.log(y1 / y0) * (height - top - bottom);
  const grid = svg("g", {class: "grid"}), texts = svg("g", {class: "ticks"});
  for (const x of logTicks(x0, x1)) {
    grid.append(svg("line", {x1: px(x), x2: px(x), y1: top, y2: height - bottom}));
    texts.append(svg("text", {x: px(x), y: height - bottom + 14, "text-anchor": "middle"}, short(x)));
  }
  for (const y of logTicks(y0, y1)) {
    grid.append(svg("line", {x1: left, x2: width - right, y1: py(y), y2: py(y)}));
    texts.append(svg("text", {x: left - 5, y: py(y) + 4, "text-anchor": "end"}, short(100 * y)));
  }
  texts.append(svg("text", {x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle"}, "time [s]"),
               svg("text", {x: 12, y: (top + height - bottom) / 2, "text-anchor": "middle",
                            transform: `rotate(-90 12 ${(top + height - bottom) / 2})`}, "relative error [%]"));
  const line = drawable.map(p => `${px(p[0]).toFixed(1)},${py(p[2]).toFixed(1)}`).join(" ");
  const dots = drawable.length > 60 ? drawable.slice(-1) : drawable;
  box.replaceChildren(grid, texts, svg("polyline", {points: line, class: "curve"}),
                      ...dots.map(p => svg("circle", {cx: px(p[0]), cy: py(p[2]), r: 3, class: "dot"},
                        svg("title", {}, `${percent(p[2])} after ${durationText(p[0])} and ${p[1]} passes`))));
  const end = drawable[drawable.length - 1];
  box.setAttribute("aria-label", `Relative error over time, both on logarithmic scales: ${percent(end[2])} after `
    + `${durationText(end[0])}.`);
}
