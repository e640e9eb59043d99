"use strict";
// What the picture is compared with: earlier states and renders that are kept in memory, and a picture from a file.

const MOST_KEPT = 6;

// The picture of a file as the browser decodes it, scaled to the window of the render where its size differs. It may
// have the size of the full picture, or that of the window.
async function pictureOfFile(file, info) {
  const bitmap = await createImageBitmap(file);
  const width = info.x1 - info.x0, height = info.y1 - info.y0, full = [info.full_width, info.full_height];
  const canvas = make("canvas", {width, height}), context = canvas.getContext("2d", {willReadFrequently: true});
  const {width: w, height: h} = bitmap;
  const note = w === width && h === height || w === full[0] && h === full[1] ? "" : ` (scaled from ${w} x ${h})`;
  if (w === width && h === height) context.drawImage(bitmap, 0, 0);
  else context.drawImage(bitmap, -info.x0, -info.y0, ...full);
  bitmap.close();
  const pixels = context.getImageData(0, 0, width, height).data, values = new Float32Array(3 * width * height);
  for (let i = 0, j = 0; i < pixels.length; i += 4)
    for (let c = 0; c < 3; ++c) values[j++] = pixels[i + c] / 255;
  const layer = {name: "", label: "file", channels: 3, show: SHOW.encoded};
  return {name: file.name + note, file: new Picture(layer, width, height, values)};
}

class Compare {
  // layers: Layers; now(): the picture shown; look(): how; onChange(): draw again.
  constructor(layers, now, look, onChange) {
    this.layers = layers;
    this.now = now;
    this.look = look;
    this.onChange = onChange;
    this.entries = [];   // {id, name, layers: Map or file: Picture, automatic}
    this.chosen = null;
    this.split = 0.5;
    this.count = 0;
    this.measure = throttled(500, () => this.measureNow());
    this.listen();
    this.update();
  }

  // The picture to compare with, or null.
  other() {
    if (!this.chosen) return null;
    return this.chosen.file ?? this.chosen.layers.get(this.now().name) ?? null;
  }

  difference() { return this.other() ? Number(byId("difference").value) : 0; }

  // Keeps all layers as they are. automatic: takes the place of the last one that was kept so.
  keep(name, automatic = false) {
    const copied = this.layers.copies();
    if (!copied.size) return;
    if (automatic) this.entries = this.entries.filter(entry => !entry.automatic);
    this.add({name, layers: copied, automatic}, !automatic || !this.chosen || this.chosen.automatic);
  }

  add(entry, choose) {
    entry.id = String(++this.count);
    this.entries.push(entry);
    if (this.entries.length > MOST_KEPT) this.entries.splice(this.entries.findIndex(e => e !== this.chosen), 1);
    if (choose) this.chosen = entry;
    this.update();
    announce(`Kept to compare with: ${entry.name}`);
  }

  async load(file) {
    const note = byId("compare-note");
    try {
      this.add(await pictureOfFile(file, this.layers.info), true);
    } catch {
      note.textContent = `${file.name} is no picture that this browser can decode. PNG and JPEG files can be loaded.`;
      announce(note.textContent);
    }
  }

  // The picture that the program was given to compare with.
  async loadReference(name) {
    const {info} = this.layers, {width, height} = this.layers;
    const values = new Float32Array(await (await request("reference")).arrayBuffer());
    const picture = new Picture(info.layers[0], width, height, values);
    this.add({name: `reference: ${name}`, layers: new Map([[picture.name, picture]])}, true);
  }

  update() {
    const select = byId("compare-with");
    select.replaceChildren(new Option("nothing", ""), ...this.entries.map(entry => new Option(entry.name, entry.id)));
    select.value = this.chosen?.id ?? "";
    select.disabled = !this.entries.length;
    byId("difference").disabled = !this.chosen;
    byId("forget").disabled = !this.chosen;
    this.refresh();
  }

  // After another layer or another picture was chosen, or pixels changed.
  refresh() {
    const other = this.other(), difference = this.difference();
    byId("divider").hidden = !other || difference > 0;
    for (const tag of ["tag-left", "tag-right"]) byId(tag).hidden = !other || difference > 0;
    byId("tag-left").textContent = this.chosen?.name ?? "";
    byId("compare-note").textContent = this.chosen && !other
      ? "The picture that is compared with does not have this layer." : "";
    if (other) this.measure();
    this.place();
    this.onChange();
  }

  place() {
    byId("divider").style.left = `${100 * this.split}%`;
    byId("divider").setAttribute("aria-valuenow", String(Math.round(100 * this.split)));
  }

  moveTo(split) {
    this.split = clamp(split, 0, 1);
    this.place();
    this.onChange();
  }

  measureNow() {
    const other = this.other(), now = this.now();
    if (!other) return;
    const note = byId("compare-note");
    if (other.show === SHOW.radiance && now.show === SHOW.radiance) {
      note.textContent = `Relative difference ${percent(rootOfRelMse(now.values, other.values))}, the square root of relMSE.`;
    } else {
      const levels = meanDifference(now, other, this.look());
      note.textContent = `Mean difference as displayed ${short(255 * levels)} of 255 levels.`;
    }
  }

  listen() {
    byId("keep").addEventListener("click", () => this.keepNow());
    byId("forget").addEventListener("click", () => {
      this.entries = this.entries.filter(entry => entry !== this.chosen);
      this.chosen = null;
      this.update();
    });
    byId("reference-file").addEventListener("change", event => {
      if (event.target.files.length) this.load(event.target.files[0]);
      event.target.value = "";
    });
    byId("compare-with").addEventListener("change", event => {
      this.chosen = this.entries.find(entry => entry.id === event.target.value) ?? null;
      this.update();
    });
    byId("difference").addEventListener("change", () => this.refresh());
    this.listenToDivider(byId("divider"));
  }

  listenToDivider(divider) {
    const stage = divider.parentElement;
    const follow = event => {
      const box = stage.getBoundingClientRect();
      this.moveTo((event.clientX - box.left) / box.width);
    };
    divider.addEventListener("pointerdown", event => {
      event.preventDefault();
      divider.focus({preventScroll: true});
      divider.setPointerCapture(event.pointerId);
    });
    divider.addEventListener("pointermove", event => { if (divider.hasPointerCapture(event.pointerId)) follow(event); });
    divider.addEventListener("keydown", event => {
      const steps = {ArrowLeft: -0.01, ArrowDown: -0.01, ArrowRight: 0.01, ArrowUp: 0.01, PageDown: -0.1, PageUp: 0.1,
                     Home: -1, End: 1};
      if (!Object.hasOwn(steps, event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      this.moveTo(this.split + steps[event.key]);
    });
  }

  keepNow() { this.keep(this.nameNow?.() ?? "kept"); }
}

// The root of the mean of (I - R)^2 / (R^2 + 0.01), without values that are not finite.
function rootOfRelMse(image, reference) {
  let sum = 0, count = 0;
  for (let i = 0; i < image.length; ++i) {
    const error = (image[i] - reference[i]) ** 2 / (reference[i] ** 2 + 0.01);
    if (Number.isFinite(error)) sum += error, ++count;
  }
  return Math.sqrt(sum / Math.max(count, 1));
}

// The mean over at most some 100,000 pixels of the difference of their encoded values.
function meanDifference(a, b, look) {
  const pixels = a.width * a.height, step = Math.max(1, Math.floor(pixels / 1e5)), one = [0, 0, 0], two = [0, 0, 0];
  let sum = 0, count = 0;
  for (let i = 0; i < pixels; i += step, ++count) {
    shownColour(a, look, i, one);
    shownColour(b, look, i, two);
    for (let c = 0; c < 3; ++c) sum += Math.abs(one[c] - two[c]) / 3;
  }
  return sum / Math.max(count, 1);
}
