"use strict";
// The floats of the picture's layers, kept up to date with what the program has.

const isRelative = name => name === "error" || name === "bias";

// Emitted light that mirrors and glass show: the automatic exposure needs it, and /info need not list it.
const SHOWN_BY_OTHERS = {name: "denoising_emitted", label: "", channels: 3, unit: "W/(m^2 sr)"};

// How a layer of /info is shown.
function showOf(layer) {
  if (layer.channels === 1) return SHOW.ramp;
  if (isRelative(layer.name)) return SHOW.relative;
  if (/normal$/.test(layer.name)) return SHOW.normal;
  return /^W/.test(layer.unit ?? "") ? SHOW.radiance : SHOW.plain;
}

// One layer of the rendered window. `dirty` holds the parts [x, y, w, h] that a drawer has not seen yet.
class Picture {
  constructor(layer, width, height, values) {
    this.name = layer.name;
    this.label = layer.label || layer.name || "all light";
    this.unit = layer.unit ?? "";
    this.channels = layer.channels;
    this.show = layer.show ?? showOf(layer);
    this.width = width;
    this.height = height;
    this.values = values ?? new Float32Array(width * height * layer.channels);
    this.radiance = null;  // the picture that a relative one is relative to
    this.low = 0, this.high = 1;
    this.touch();
  }

  get base() { return this.radiance.values; }

  touch() { this.dirty = [[0, 0, this.width, this.height]]; }

  copy(radiance = null) {
    const copied = new Picture(this, this.width, this.height, this.values.slice());
    copied.radiance = radiance;
    copied.low = this.low, copied.high = this.high;
    return copied;
  }

  // Writes a tile of values, whose corner is at (x, y) of the window. Parts outside of the window are left out.
  write(x, y, w, h, values) {
    const x0 = Math.max(x, 0), x1 = Math.min(x + w, this.width), y0 = Math.max(y, 0), y1 = Math.min(y + h, this.height);
    if (x0 >= x1 || y0 >= y1) return;
    for (let row = y0; row < y1; ++row) {
      const from = ((row - y) * w + x0 - x) * this.channels;
      this.values.set(values.subarray(from, from + (x1 - x0) * this.channels), (row * this.width + x0) * this.channels);
    }
    this.dirty.push([x0, y0, x1 - x0, y1 - y0]);
    if (this.dirty.length > 4096) this.touch();
  }

  // The range of a ramp: from the hundredth to the last hundredth of the values above 0.
  fitRange() {
    if (this.show !== SHOW.ramp) return;
    const step = Math.max(1, Math.floor(this.values.length / 20000)), found = [];
    for (let i = 0; i < this.values.length; i += step)
      if (this.values[i] > 0 && Number.isFinite(this.values[i])) found.push(this.values[i]);
    if (!found.length) return;
    const sorted = Float32Array.from(found).sort(), last = sorted.length - 1;
    this.low = sorted[Math.floor(0.01 * last)];
    this.high = sorted[Math.ceil(0.99 * last)];
    if (!(this.high > this.low)) this.low = 0, this.high ||= 1;
  }
}

// Calls fn(x, y, w, h, values) for the tiles of an answer of /pixels; returns what its head says.
function readTiles(buffer, channels, fn) {
  const numbers = new DataView(buffer);
  const head = {version: numbers.getUint32(0, true) + 2 ** 32 * numbers.getUint32(4, true),
                render: numbers.getUint32(8, true), tiles: numbers.getUint32(12, true)};
  let at = 16;
  for (let tile = 0; tile < head.tiles; ++tile) {
    const [x, y, w, h] = [0, 4, 8, 12].map(offset => numbers.getUint32(at + offset, true));
    at += 16;
    if (fn) fn(x, y, w, h, new Float32Array(buffer, at, w * h * channels));
    at += 4 * w * h * channels;
  }
  return head;
}

// Fetches the layers that are wanted, one request at a time and always the newest state.
class Layers {
  // onChange(picture): pixels have arrived.
  constructor(info, onChange) {
    this.info = info;
    this.onChange = onChange;
    this.width = info.x1 - info.x0;
    this.height = info.y1 - info.y0;
    this.slots = new Map();
    this.status = null;
    this.fetching = false;
    this.offline = false;
    for (const layer of [SHOWN_BY_OTHERS, ...info.layers])
      this.slots.set(layer.name, {layer, picture: null, version: 0, render: 0, seen: "", old: false});
    this.wanted = [""];
    this.extra = [];       // layers to fetch once, after the wanted ones
  }

  picture(name) {
    const slot = this.slots.get(name);
    if (!slot.picture) {
      slot.picture = new Picture(slot.layer, this.width, this.height);
      if (slot.picture.show === SHOW.relative) slot.picture.radiance = this.picture("");
    }
    return slot.picture;
  }

  // All layers that have pixels, as they are now.
  copies() {
    const copied = new Map();
    for (const [name, slot] of this.slots)
      if (slot.version && !isRelative(name) && slot.layer !== SHOWN_BY_OTHERS) copied.set(name, slot.picture.copy());
    for (const [name, slot] of this.slots)
      if (slot.version && isRelative(name)) copied.set(name, slot.picture.copy(copied.get("")));
    return copied;
  }

  // The program is another one, whose versions mean other pixels.
  forget() {
    for (const slot of this.slots.values()) Object.assign(slot, {version: 0, render: 0, seen: ""});
  }

  // Layers to keep up to date, the most important one first.
  want(names) {
    this.wanted = names.filter(name => this.slots.has(name));
    this.pump();
  }

  notice(status) {
    this.status = status;
    this.pump();
  }

  // Brings layers up to date once. The promise holds whether that has worked.
  once(names) {
    return new Promise(resolve => {
      this.extra.push(...names.map((name, i) => ({name, done: i + 1 === names.length ? resolve : () => {}})));
      if (this.offline) this.giveUp();
      else this.pump();
    });
  }

  giveUp() {
    for (const {done} of this.extra.splice(0)) done(false);
  }

  key() { return `${this.status.render}/${this.status.version}`; }

  // Whether all wanted layers are as new as the last event says.
  upToDate() {
    return this.status !== null && !this.fetching && this.wanted.every(name => this.slots.get(name).seen === this.key());
  }

  async pump() {
    if (this.fetching || this.offline || !this.status) return;
    this.fetching = true;
    try {
      for (;;) {
        const name = this.wanted.find(n => this.slots.get(n).seen !== this.key());
        if (!this.status.version || name === undefined && !this.extra.length) break;
        await this.fetchOne(this.slots.get(name ?? this.extra[0].name));
        if (name === undefined) this.extra.shift().done(true);
      }
    } catch (problem) {
      console.info(`pixels: ${problem.message}`);  // the next event asks again
      this.giveUp();
    } finally {
      this.fetching = false;
    }
  }

  async fetchOne(slot) {
    const seen = this.key();
    const since = slot.render === this.status.render ? slot.version : 0;
    const answer = await request(`pixels?layer=${encodeURIComponent(slot.layer.name)}&since=${since}`);
    const buffer = await answer.arrayBuffer();
    const picture = this.picture(slot.layer.name);
    const {render, tiles} = readTiles(buffer, picture.channels);
    if (render !== slot.render) {
      slot.render = render;
      slot.version = 0;
      slot.old = true;  // the pixels stay until the new render has some
      if (since !== 0) return;  // its tiles are asked for from the start
    }
    if (slot.old && tiles) {
      picture.values.fill(0);
      picture.touch();
      slot.old = false;
    }
    const x0 = this.info.x0, y0 = this.info.y0;
    const head = readTiles(buffer, picture.channels, (x, y, w, h, values) => picture.write(x - x0, y - y0, w, h, values));
    slot.version = head.version;
    slot.seen = seen;
    if (head.tiles) this.onChange(picture);
  }
}
