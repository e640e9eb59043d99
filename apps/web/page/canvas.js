"use strict";
// Draws as gpu.js does, by a 2D canvas: pixels become colours once, and again where they or the look change.

const LEVELS = 1 << 16;  // of linear light in a table of its encoded levels, which is exact but for a level at its edges
let encodedLevels = null;

// shownColour() for the radiance of a part of a picture, several times as fast.
function radianceLevels(picture, look, data, x, y, w, h) {
  const {values, width} = picture, {gain, operator} = look, out = [0, 0, 0];
  encodedLevels ??= Uint8Array.from({length: LEVELS + 1}, (_, i) => Math.floor(255 * encode(i / LEVELS) + 0.5));
  for (let row = 0, to = 0; row < h; ++row)
    for (let from = 3 * ((y + row) * width + x), end = from + 3 * w; from < end; from += 3, to += 4) {
      tonemap(values[from], values[from + 1], values[from + 2], gain, operator, out);
      for (let c = 0; c < 3; ++c) data[to + c] = encodedLevels[Math.round(out[c] * LEVELS)];
      data[to + 3] = 255;
    }
}

class CanvasDrawer {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.shown = new Map();  // picture -> {canvas, look}
  }

  get name() { return "2D canvas"; }

  // A canvas of the picture's size with its colours.
  coloured(picture, look) {
    const key = `${look.gain} ${look.operator} ${picture.low} ${picture.high}`;
    let entry = this.shown.get(picture);
    if (!entry) {
      const canvas = make("canvas", {width: picture.width, height: picture.height});
      this.shown.set(picture, entry = {canvas, key: "", context: canvas.getContext("2d", {willReadFrequently: true})});
    }
    // What a relative picture stands on may have changed anywhere.
    const all = entry.key !== key || picture.show === SHOW.relative;
    for (const [x, y, w, h] of all ? [[0, 0, picture.width, picture.height]] : picture.dirty)
      this.colour(picture, look, entry.context, x, y, w, h);
    entry.key = key;
    picture.dirty = [];
    return entry.canvas;
  }

  colour(picture, look, context, x, y, w, h) {
    const image = context.createImageData(w, h), out = [0, 0, 0];
    if (picture.show === SHOW.radiance) {
      radianceLevels(picture, look, image.data, x, y, w, h);
      context.putImageData(image, x, y);
      return;
    }
    for (let row = 0, i = 0; row < h; ++row)
      for (let column = 0; column < w; ++column, i += 4) {
        shownColour(picture, look, (y + row) * picture.width + x + column, out);
        for (let c = 0; c < 3; ++c) image.data[i + c] = Math.floor(out[c] * 255 + 0.5);
        image.data[i + 3] = 255;
      }
    context.putImageData(image, x, y);
  }

  draw(frame) {
    const {context, canvas} = this, {now, other} = frame;
    for (const picture of this.shown.keys())
      if (picture !== now && picture !== other) this.shown.delete(picture);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.imageSmoothingEnabled = frame.scale < 1;
    const place = [frame.x, frame.y, now.width * frame.scale, now.height * frame.scale];
    context.drawImage(this.coloured(now, frame.look), ...place);
    if (!other) return;
    context.save();
    context.beginPath();
    context.rect(0, 0, frame.difference ? canvas.width : frame.split, canvas.height);
    context.clip();
    if (frame.difference) context.globalCompositeOperation = "difference";
    context.drawImage(this.coloured(other, frame.look), ...place);
    context.restore();
    if (!(frame.difference > 1)) return;
    // Adding the picture to itself doubles the difference.
    context.save();
    context.globalCompositeOperation = "lighter";
    for (let factor = 1; factor < frame.difference; factor *= 2) context.drawImage(canvas, 0, 0);
    context.restore();
  }
}

// The best drawer that this browser has. The address ends in #2d to do without WebGL.
function makeDrawer(canvas, width, height) {
  if (location.hash !== "#2d") {
    try {
      return new GpuDrawer(canvas, width, height);
    } catch (problem) {
      console.info(`drawn without WebGL: ${problem.message}`);
      const fresh = canvas.cloneNode();  // a canvas keeps its first kind of context
      canvas.replaceWith(fresh);
      canvas = fresh;
    }
  }
  return new CanvasDrawer(canvas);
}
