"use strict";
// What the charts of all reports share: texts of numbers, colours and axes. Texts are inserted as text nodes only, never
// as HTML.
const byId = id => document.getElementById(id);

// Colours are functions, which Chart.js calls whenever it draws, so that charts follow the page between light and dark.
const colour = name => () => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const seriesColour = index => () => {
  const colours = colour("series")().split(" ");
  return colours[index % colours.length];
};
// For prints in grey.
const SHAPES = ["circle", "rect", "triangle", "rectRot", "star", "crossRot", "cross"];

function countText(n) {
  for (const [unit, letter] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]])
    if (n >= unit) return `${+(n / unit).toPrecision(3)}${letter}`;
  return String(n);
}
const short = x => String(+x.toPrecision(3));
const percent = x => `${short(100 * x)} %`;
const secondsText = s => `${short(s)} s`;

function dataset(name, points, index, more = {}) {
  return {label: name, data: points, borderColor: seriesColour(index), backgroundColor: seriesColour(index),
          borderWidth: 1.5, pointRadius: 4.5, pointHoverRadius: 7, pointStyle: SHAPES[index % SHAPES.length], showLine: true, ...more};
}

const sorted = points => points.sort((a, b) => a.x - b.x);

// Labels ticks at 1, 2 and 5 times powers of ten, fewer on long axes and more on short ones. The ends of an axis,
// which are not round numbers, get no label.
function tickText(format) {
  return function (value, _index, ticks) {
    const mantissa = value / 10 ** Math.floor(Math.log10(value) + 1e-9), digit = Math.round(mantissa);
    const decades = Math.log10(ticks[ticks.length - 1].value / ticks[0].value);
    const wanted = decades > 4 ? [1] : decades > 1.6 ? [1, 2, 5] : [1, 2, 3, 5, 7];
    return Math.abs(mantissa - digit) < 1e-6 && wanted.includes(digit) ? format(value) : null;
  };
}

// A logarithmic axis from slightly below the least value to slightly above the greatest, at least 0.8 decades
// long, so that it contains some ticks.
function logAxis(title, format, values) {
  const least = Math.min(...values), most = Math.max(...values);
  const margin = Math.max(1.25, Math.sqrt(10 ** 0.8 * least / most));
  const range = values.length ? {min: least / margin, max: most * margin} : {};
  return {type: "logarithmic", ...range, title: {display: true, text: title}, grid: {color: colour("grid")},
          ticks: {callback: tickText(format), maxRotation: 0, autoSkip: false}};
}

Chart.defaults.color = colour("chart-ink");
Chart.defaults.font.family = getComputedStyle(document.documentElement).fontFamily;
// Pages are printed light, but the styles for print do not hold yet when the charts for print are drawn.
function followScheme(prints) {
  document.documentElement.toggleAttribute("data-prints", prints);
  for (const id in Chart.instances) Chart.instances[id].update("none");
}
followScheme(false);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => followScheme(false));
addEventListener("beforeprint", () => {
  followScheme(true);
  for (const id in Chart.instances) Chart.instances[id].resize();
});
addEventListener("afterprint", () => followScheme(false));
