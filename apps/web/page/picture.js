"use strict";
// The stage with the picture: zoom and pan by wheel, pointers and keys, single pixels and their numbers.

const MOST_ZOOM = 160;        // CSS pixels a picture pixel
const NUMBERS_FROM = 56;      // at this zoom pixels have room for their numbers
const CLICK_DISTANCE = 5;     // CSS pixels that a pointer may move in a click

// Numbers in a pixel have little room.
const tiny = x => Number.isFinite(x) && x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5) ? x.toExponential(1) : short(x);

class PictureView {
  // frame(): {now, other, look, split (0 to 1), difference}. hooks: onHover(x, y or null), onPick(x, y), onMoved().
  constructor(stage, width, height, frame, hooks) {
    this.stage = stage;
    this.width = width;
    this.height = height;
    this.frame = frame;
    this.hooks = hooks;
    this.drawer = makeDrawer(stage.querySelector("canvas"), width, height);
    this.drawer.onRestored = () => this.redraw();
    this.overlay = stage.querySelector(".overlay");
    this.centre = {x: width / 2, y: height / 2};
    this.zoom = 1;
    this.fitted = true;       // follows the size of the stage
    this.byKeys = false;      // shows a cross in the middle
    this.mark = null;         // a pixel that is marked
    this.pointers = new Map();
    this.redraw = eachFrame(() => this.draw());
    this.listen();
    new ResizeObserver(() => {
      if (!stage.clientWidth) return;  // hidden
      if (this.fitted) this.fit();
      else this.redraw();
    }).observe(stage);
    this.fit();
  }

  box() { return {width: Math.max(1, this.stage.clientWidth), height: Math.max(1, this.stage.clientHeight)}; }
  wholeZoom() {
    const box = this.box();
    return Math.min(box.width / this.width, box.height / this.height);
  }

  // CSS pixels from the corner of the stage to that of the picture, at whole device pixels where squares are crisp.
  origin() {
    const box = this.box(), scale = devicePixelRatio || 1;
    const x = box.width / 2 - this.centre.x * this.zoom, y = box.height / 2 - this.centre.y * this.zoom;
    return {x: Math.round(x * scale) / scale, y: Math.round(y * scale) / scale};
  }

  // The pixel at a place of the stage, or null.
  pixelAt(left, top) {
    const origin = this.origin();
    const x = Math.floor((left - origin.x) / this.zoom), y = Math.floor((top - origin.y) / this.zoom);
    return x >= 0 && y >= 0 && x < this.width && y < this.height ? {x, y} : null;
  }

  pixelInMiddle() {
    const box = this.box();
    return this.pixelAt(box.width / 2, box.height / 2);
  }

  fit() {
    this.fitted = true;
    this.centre = {x: this.width / 2, y: this.height / 2};
    this.zoom = Math.min(this.wholeZoom(), MOST_ZOOM);
    this.moved();
  }

  // Changes the zoom while the picture stays where it is at a place of the stage.
  zoomTo(zoom, left, top) {
    const box = this.box();
    left ??= box.width / 2, top ??= box.height / 2;
    const x = this.centre.x + (left - box.width / 2) / this.zoom, y = this.centre.y + (top - box.height / 2) / this.zoom;
    this.zoom = clamp(zoom, Math.min(this.wholeZoom() / 2, 1), MOST_ZOOM);
    this.centre = {x: x - (left - box.width / 2) / this.zoom, y: y - (top - box.height / 2) / this.zoom};
    this.fitted = false;
    this.moved();
  }

  pan(left, top) {
    this.centre.x -= left / this.zoom;
    this.centre.y -= top / this.zoom;
    this.fitted = false;
    this.moved();
  }

  moved() {
    this.centre.x = clamp(this.centre.x, 0, this.width);
    this.centre.y = clamp(this.centre.y, 0, this.height);
    this.stage.classList.toggle("whole", this.fitted);
    this.hooks.onMoved();
    if (this.byKeys) this.hooks.onHover(this.pixelInMiddle());
    this.redraw();
  }

  useKeys(on) {
    if (this.byKeys === on) return;
    this.byKeys = on;
    this.hooks.onHover(on ? this.pixelInMiddle() : null);
    this.redraw();
  }

  // Returns whether the key is one of the picture's.
  key(event) {
    const step = event.shiftKey ? this.zoom : 60;
    const middle = this.pixelInMiddle();
    const actions = {
      ArrowLeft: () => this.pan(step, 0), ArrowRight: () => this.pan(-step, 0),
      ArrowUp: () => this.pan(0, step), ArrowDown: () => this.pan(0, -step),
      "+": () => this.zoomTo(this.zoom * 1.5), "=": () => this.zoomTo(this.zoom * 1.5), "-": () => this.zoomTo(this.zoom / 1.5),
      0: () => this.fit(), 1: () => this.zoomTo(1 / (devicePixelRatio || 1)),
      Enter: () => { if (middle) this.hooks.onPick(middle.x, middle.y); }};
    if (!Object.hasOwn(actions, event.key) || event.key === "Enter" && event.target !== this.stage) return false;
    if (event.key.startsWith("Arrow") || event.key === "Enter") this.useKeys(true);
    actions[event.key]();
    return true;
  }

  listen() {
    const stage = this.stage, place = event => this.placeOf(event);
    stage.addEventListener("wheel", event => {
      event.preventDefault();
      const unit = event.deltaMode === 1 ? 20 : event.deltaMode === 2 ? 300 : 1, at = place(event);
      this.zoomTo(this.zoom * Math.exp(-clamp(event.deltaY * unit, -300, 300) * 0.002), at.x, at.y);
    }, {passive: false});
    stage.addEventListener("pointerdown", event => {
      if (event.button !== 0 || event.target.closest("[data-own-pointer]")) return;
      stage.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, {...place(event), path: 0});
      this.pinched ||= this.pointers.size > 1;
    });
    stage.addEventListener("pointermove", event => {
      const at = place(event);
      if (this.pointers.has(event.pointerId)) this.drag(event.pointerId, at);
      else if (event.target.closest("[data-own-pointer]")) return;
      this.byKeys = false;
      this.hooks.onHover(this.pixelAt(at.x, at.y));
    });
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, event => this.lift(event));
    stage.addEventListener("pointerleave", event => {
      if (!this.byKeys && event.pointerType === "mouse") this.hooks.onHover(null);
    });
    stage.addEventListener("dblclick", event => {
      if (!event.target.closest("[data-own-pointer]")) this.zoomTo(this.zoom * 2, place(event).x, place(event).y);
    });
    stage.addEventListener("blur", () => this.useKeys(false));
  }

  // Of an event, from the corner of the stage.
  placeOf(event) {
    const box = this.stage.getBoundingClientRect();
    return {x: event.clientX - box.left, y: event.clientY - box.top};
  }

  // The end of a drag, or of a click.
  lift(event) {
    const pointer = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    const pixel = pointer && this.pixelAt(pointer.x, pointer.y);
    if (event.type === "pointerup" && pixel && pointer.path < CLICK_DISTANCE && !this.pinched) {
      this.hooks.onHover(pixel);
      this.hooks.onPick(pixel.x, pixel.y);
    }
    if (!this.pointers.size) this.pinched = false;
  }

  drag(id, at) {
    const pointer = this.pointers.get(id);
    const others = [...this.pointers].filter(([other]) => other !== id).map(([, value]) => value);
    pointer.path += Math.hypot(at.x - pointer.x, at.y - pointer.y);
    if (others.length) {
      const other = others[0], before = Math.hypot(pointer.x - other.x, pointer.y - other.y);
      const after = Math.hypot(at.x - other.x, at.y - other.y);
      this.pan((at.x - pointer.x) / 2, (at.y - pointer.y) / 2);
      if (before > 10 && after > 10) this.zoomTo(this.zoom * after / before, (at.x + other.x) / 2, (at.y + other.y) / 2);
    } else if (pointer.path >= CLICK_DISTANCE) {
      this.pan(at.x - pointer.x, at.y - pointer.y);
    }
    pointer.x = at.x, pointer.y = at.y;
  }

  draw() {
    const scale = fitCanvas(this.drawer.canvas), frame = this.frame(), origin = this.origin();
    this.drawer.draw({...frame, x: origin.x * scale, y: origin.y * scale, scale: this.zoom * scale,
                      split: frame.split * this.drawer.canvas.width});
    fitCanvas(this.overlay);
    const context = this.overlay.getContext("2d");
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, this.overlay.clientWidth, this.overlay.clientHeight);
    if (this.zoom >= NUMBERS_FROM) this.drawNumbers(context, frame, origin);
    if (this.mark) this.drawMark(context, origin);
    if (this.byKeys) this.drawCross(context);
  }

  // The numbers of the pixels in sight, dark on light ones and light on dark ones.
  drawNumbers(context, frame, origin) {
    const box = this.box(), zoom = this.zoom, colour = [0, 0, 0];
    const size = clamp(Math.floor(zoom / 5.2), 10, 15);
    context.font = `${size}px ui-monospace, "DejaVu Sans Mono", "Liberation Mono", Menlo, monospace`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const first = {x: Math.max(0, Math.floor(-origin.x / zoom)), y: Math.max(0, Math.floor(-origin.y / zoom))};
    for (let y = first.y; y < this.height && origin.y + y * zoom < box.height; ++y)
      for (let x = first.x; x < this.width && origin.x + x * zoom < box.width; ++x) {
        const middle = origin.x + (x + 0.5) * zoom;
        const picture = frame.other && !frame.difference && middle < frame.split * box.width ? frame.other : frame.now;
        const index = y * this.width + x, {channels, values} = picture;
        shownColour(picture, frame.look, index, colour);
        const dark = frame.difference || luminance(...colour) < 0.5;
        context.fillStyle = dark ? "rgb(255 255 255 / .92)" : "rgb(0 0 0 / .88)";
        for (let c = 0; c < channels; ++c)
          context.fillText(tiny(values[index * channels + c]), middle,
                           origin.y + (y + 0.5) * zoom + (c - (channels - 1) / 2) * (size + 2), zoom - 3);
      }
  }

  drawMark(context, origin) {
    const side = Math.max(this.zoom, 9);
    const x = origin.x + (this.mark.x + 0.5) * this.zoom, y = origin.y + (this.mark.y + 0.5) * this.zoom;
    for (const [colour, more] of [["#000", 1.5], ["#ffd24d", 0]]) {
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      context.strokeRect(x - side / 2 - more, y - side / 2 - more, side + 2 * more, side + 2 * more);
    }
  }

  drawCross(context) {
    const box = this.box(), x = box.width / 2, y = box.height / 2;
    for (const [colour, width] of [["rgb(0 0 0 / .7)", 3], ["#fff", 1]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + 5 * dx, y + 5 * dy);
        context.lineTo(x + 16 * dx, y + 16 * dy);
      }
      context.stroke();
    }
  }
}
