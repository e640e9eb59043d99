"use strict";
// From floats to what the screen shows: the operators of render/picture/tonemap.cpp, the automatic exposure of
// render/picture/exposure.cpp, and colour ramps. gpu.js has the same operators as a shader.
const OPERATORS = ["srgb", "reinhard", "filmic"];
const MOST_STOPS = 64;

// How the numbers of a layer become colours.
const SHOW = {radiance: 0, plain: 1, normal: 2, ramp: 3, relative: 4, encoded: 5};

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const clip = v => v > 0 ? Math.min(v, 1) : 0;  // NaN gives 0
const encode = v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
const FILMIC = {a: 2.51, b: 0.03, c: 2.43, d: 0.59, e: 0.14};

function filmic(x) {
  if (!(x > 0)) return 0;
  if (x > 1e6) return 1;
  const {a, b, c, d, e} = FILMIC;
  return clip(x * (a * x + b) / (x * (c * x + d) + e));
}

// The value that `filmic` maps to t.
function beforeFilmic(t) {
  const a = FILMIC.a - t * FILMIC.c, b = FILMIC.b - t * FILMIC.d, c = -t * FILMIC.e;
  return (-b + Math.sqrt(b * b - 4 * a * c)) / (2 * a);
}

// Linear radiance to linear display values; writes three numbers to out.
function tonemap(r, g, b, gain, operator, out) {
  r *= gain, g *= gain, b *= gain;
  if (operator === "filmic") {
    out[0] = filmic(r), out[1] = filmic(g), out[2] = filmic(b);
    return;
  }
  let scale = 1;
  if (operator === "reinhard") {
    const Y = luminance(r, g, b);
    if (Number.isFinite(Y)) scale = 1 / (1 + Math.max(Y, 0));
  }
  out[0] = clip(r * scale), out[1] = clip(g * scale), out[2] = clip(b * scale);
}

// A ramp of 256 encoded colours from stops, which are linear light.
function rampOf(stops, encoded) {
  const ramp = new Uint8ClampedArray(256 * 4);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
    for (let c = 0; c < 3; ++c) {
      const v = stops[k][c] + (at - k) * (stops[k + 1][c] - stops[k][c]);
      ramp[4 * i + c] = Math.round(255 * (encoded ? v : encode(v)));
    }
    ramp[4 * i + 3] = 255;
  }
  return ramp;
}

// heat: the colours of `kaustik compare --heatmap`. even: viridis (Smith and van der Walt 2015), even steps for the eye.
const RAMPS = {
  even: rampOf([[.267, .005, .329], [.283, .141, .458], [.254, .265, .53], [.207, .372, .553], [.164, .471, .558],
                [.128, .567, .551], [.135, .659, .518], [.267, .749, .441], [.478, .821, .318], [.741, .873, .15],
                [.993, .906, .144]], true),
  heat: rampOf([[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0], [1, 1, 1]], false)};

// Where a relative error stands on the ramp, which goes from 1 % to 100 %.
const heatPlace = error => error > 0 ? Math.log10(error) / 2 + 1 : error === 0 ? 0 : NaN;

// The root of the mean of e^2 / (R^2 + 0.01) over the channels: what relMSE is made of.
function relativeError(values, base, i) {
  let sum = 0;
  for (let c = 0; c < 3; ++c) sum += values[i + c] ** 2 / (base[i + c] ** 2 + 0.01) / 3;
  return Math.sqrt(sum);
}

function fromRamp(ramp, place, out) {
  if (Number.isNaN(place)) {
    out[0] = out[2] = 1, out[1] = 0;  // magenta marks what is not a number
    return;
  }
  const i = 4 * Math.round(255 * clamp(place, 0, 1));
  for (let c = 0; c < 3; ++c) out[c] = ramp[i + c] / 255;
}

// What pixel `index` of a picture looks like, as three encoded values in [0, 1]. look: {gain, operator}.
function shownColour(picture, look, index, out) {
  const {values, show} = picture;
  const i = index * picture.channels;
  if (show === SHOW.radiance) tonemap(values[i], values[i + 1], values[i + 2], look.gain, look.operator, out);
  else if (show === SHOW.ramp)
    fromRamp(RAMPS.even, (values[i] - picture.low) / (picture.high - picture.low), out);
  else if (show === SHOW.relative) fromRamp(RAMPS.heat, heatPlace(relativeError(values, picture.base, i)), out);
  else if (show === SHOW.normal) {
    const none = values[i] === 0 && values[i + 1] === 0 && values[i + 2] === 0;
    for (let c = 0; c < 3; ++c) out[c] = none ? 0 : clip((values[i + c] + 1) / 2);
  } else
    for (let c = 0; c < 3; ++c) out[c] = clip(values[i + c]);
  if (show === SHOW.radiance || show === SHOW.plain)
    for (let c = 0; c < 3; ++c) out[c] = encode(out[c]);
}

// The radiance that an operator shows as middle grey.
function radianceOfGrey(operator) {
  const grey = 0.18;
  return operator === "reinhard" ? grey / (1 - grey) : operator === "filmic" ? beforeFilmic(grey) : grey;
}

// Mean luminances of blocks of 4 x 4 pixels, those above 0. Pixels that show mostly a light are left out; lights: as
// many values as the picture has, or null.
function blockLuminances(picture, lights) {
  const side = 4, {width, height, values} = picture, found = [];
  for (let y0 = 0; y0 < height; y0 += side)
    for (let x0 = 0; x0 < width; x0 += side) {
      let sum = 0, count = 0;
      for (let y = y0; y < Math.min(y0 + side, height); ++y)
        for (let x = x0; x < Math.min(x0 + side, width); ++x) {
          const i = 3 * (y * width + x), Y = luminance(values[i], values[i + 1], values[i + 2]);
          if (!Number.isFinite(Y)) continue;
          if (lights && luminance(lights[i], lights[i + 1], lights[i + 2]) > 0.5 * Y) continue;
          sum += Y;
          ++count;
        }
      const mean = sum / Math.max(count, 1);
      if (Number.isFinite(mean) && mean > 0) found.push(mean);
    }
  return found;
}

// The exposure in stops that shows the log-average luminance as middle grey, without the brightest hundredth of the
// blocks and those that are black beside the brightest twentieth.
function automaticExposure(picture, lights, operator) {
  let found = blockLuminances(picture, lights);
  if (!found.length) found = blockLuminances(picture, null);
  if (!found.length) return 0;
  const sorted = Float64Array.from(found).sort();
  const reachedBy = share => sorted[sorted.length - 1 - Math.min(Math.floor(share * sorted.length), sorted.length - 1)];
  const most = reachedBy(0.01), least = reachedBy(0.05) * 2 ** -8;
  let sum = 0, count = 0;
  for (const Y of sorted)
    if (Y >= least && Y <= most) sum += Math.log2(Y), ++count;
  const stops = Math.log2(radianceOfGrey(operator)) - sum / count;
  return Math.round(100 * clamp(stops, -MOST_STOPS, MOST_STOPS)) / 100;
}
