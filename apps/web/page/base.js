"use strict";
// What all parts of the page share: texts of numbers, requests to the program, announcements. Texts of others are
// inserted as text nodes only, never as HTML.
const byId = id => document.getElementById(id);
const clamp = (x, least, most) => Math.min(Math.max(x, least), most);

function countText(n) {
  for (const [unit, letter] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]])
    if (n >= unit) return `${+(n / unit).toPrecision(3)}${letter}`;
  return String(n);
}

// Three digits, without a long tail of zeros: 1.23e-7, 0.0123, 123, 12300.
function short(x) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf";
  if (x === 0) return "0";
  const size = Math.abs(x);
  return size < 1e-3 || size >= 1e6 ? x.toExponential(2) : String(+x.toPrecision(3));
}

const percent = x => `${short(100 * x)} %`;

function durationText(seconds) {
  if (!(seconds < 1e9)) return "very long";
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds), h = Math.floor(whole / 3600), m = Math.floor(whole / 60) % 60, s = whole % 60;
  if (h >= 48) return `${Math.round(whole / 86400)} days`;
  return h ? `${h} h ${m} min` : m ? `${m} min ${s} s` : `${s} s`;
}

// An element with attributes, and children that are elements or texts.
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== false && value !== null) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children);
  return element;
}

// Tells a screen reader, once.
function announce(text) {
  const voice = byId("voice");
  if (voice.textContent !== text) voice.textContent = text;
}

// The error of an answer in words, as the program gives it.
async function problemOf(answer) {
  try {
    return (await answer.json()).error ?? `status ${answer.status}`;
  } catch {
    return `status ${answer.status}`;
  }
}

// Paths are relative to the address of the page. Throws an Error that says what is wrong.
async function request(path, options) {
  const answer = await fetch(path, {cache: "no-store", ...options});
  if (!answer.ok) throw new Error(await problemOf(answer));
  return answer;
}

// Calls fn at most once in so many milliseconds, and once more after the last request.
function throttled(milliseconds, fn) {
  let timer = null, last = -Infinity;
  return () => {
    if (timer !== null) return;
    timer = setTimeout(() => { timer = null; last = performance.now(); fn(); },
                       Math.max(0, last + milliseconds - performance.now()));
  };
}

// Calls fn once in the next frame, however often it is asked for before.
function eachFrame(fn) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; fn(); });
  };
}

const colourOf = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Sizes a canvas to its box in device pixels, and returns how many of them make a CSS pixel.
function fitCanvas(canvas) {
  const scale = devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * scale));
  const height = Math.max(1, Math.round(canvas.clientHeight * scale));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  return scale;
}
