"use strict";
// The photons of a render as a cloud in space, with the cells of the octree, by WebGL: orbit by pointer, touch and keys.

const KINDS = ["direct", "shadow", "caustic", "indirect"];
const KIND_COLOURS = ["#f0b000", "#8a94a6", "#38b0f0", "#e58cc0"];
const MOST_PHOTONS = 200000, MOST_CELLS = 20000;

// Points and lines share a shader. kind: 0 to 3, depth: of a cell, or -1.
const CLOUD_VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 flux;
layout(location = 2) in vec2 kind_depth;
uniform mat4 camera;
uniform vec3 colours[4];
uniform ivec4 shown;
uniform int by_flux;
uniform float depth;     // of the cells to draw; -2: all
uniform float size;
uniform float alpha;
out vec4 tint;
void main() {
  int kind = clamp(int(kind_depth.x), 0, 3);
  bool visible = shown[kind] != 0 && (kind_depth.y < 0.0 || depth < -1.5 || abs(kind_depth.y - depth) < 0.5);
  gl_Position = visible ? camera * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = size;
  float most = max(max(flux.r, flux.g), flux.b);
  vec3 hue = most > 0.0 ? pow(flux / most, vec3(1.0 / 2.2)) : vec3(0.5);
  tint = vec4(by_flux != 0 && kind_depth.y < 0.0 ? hue : colours[kind], alpha);
}`;
const CLOUD_FRAGMENT = `#version 300 es
precision highp float;
in vec4 tint;
out vec4 colour;
void main() { colour = tint; }`;

const rgbOf = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);

// Perspective times a look at a target, column by column. up: 1 for y, 2 for z.
function orbitCamera(orbit, aspect, up) {
  const {yaw, pitch, distance, target} = orbit, cp = Math.cos(pitch), sp = Math.sin(pitch);
  const flat = [cp * Math.sin(yaw), sp, cp * Math.cos(yaw)];
  const back = up === 1 ? flat : [flat[2], flat[0], flat[1]];
  const right = vec.unit(vec.cross(up === 1 ? [0, 1, 0] : [0, 0, 1], back)), above = vec.cross(back, right);
  const eye = vec.add(target, vec.scale(back, distance));
  const near = distance / 200, far = distance * 50, f = 2;  // f: of the shorter side
  const rows = [vec.scale(right, f / Math.max(1, aspect)), vec.scale(above, f * Math.min(1, aspect)), back];
  const shift = rows.map(row => -vec.dot(row, eye)), a = (far + near) / (near - far), b = 2 * far * near / (near - far);
  const matrix = new Float32Array(16);
  for (let c = 0; c < 3; ++c) matrix.set([rows[0][c], rows[1][c], a * back[c], -back[c]], 4 * c);
  matrix.set([shift[0], shift[1], a * shift[2] + b, -shift[2]], 12);
  return {matrix, right, above, perPixel: distance / f};
}

// /photons: seven numbers each. Returns six floats of each for the shader's first two inputs, and kinds.
function readPhotons(buffer) {
  const count = new DataView(buffer).getUint32(0, true), floats = new Float32Array(buffer, 4), whole = new Uint32Array(buffer, 4);
  const data = new Float32Array(8 * count), counts = [0, 0, 0, 0];
  for (let i = 0; i < count; ++i) {
    data.set(floats.subarray(7 * i, 7 * i + 6), 8 * i);
    data[8 * i + 6] = whole[7 * i + 6];
    data[8 * i + 7] = -1;
    ++counts[Math.min(whole[7 * i + 6], 3)];
  }
  return {data, count, counts};
}

const EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];  // pairs of corners

function readCells(buffer) {
  const count = new DataView(buffer).getUint32(0, true), floats = new Float32Array(buffer, 4), whole = new Uint32Array(buffer, 4);
  const data = new Float32Array(8 * 24 * count);
  let deepest = 0, at = 0;
  for (let i = 0; i < count; ++i) {
    const depth = whole[8 * i + 6];
    deepest = Math.max(deepest, depth);
    for (const corner of EDGES) {
      for (let axis = 0; axis < 3; ++axis) data[at + axis] = floats[8 * i + axis + (corner >> axis & 1 ? 3 : 0)];
      data[at + 6] = whole[8 * i + 7];
      data[at + 7] = depth;
      at += 8;
    }
  }
  return {data, count, deepest};
}

class Cloud {
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = null;
    this.orbit = {yaw: 0.6, pitch: 0.35, distance: 3, target: [0, 0, 0]};
    this.up = 1;
    this.shown = [1, 1, 1, 1];
    this.pointers = new Map();
    this.point = null;     // of an estimate, as positions of lines
    this.loaded = null;    // the render whose photons these are
    this.redraw = eachFrame(() => this.draw());
    this.listen();
    new ResizeObserver(() => this.redraw()).observe(canvas);
  }

  // Throws an Error where there is no WebGL 2.
  start() {
    if (this.gl) return;
    const gl = this.canvas.getContext("webgl2", {antialias: true});
    if (!gl) throw new Error("This view needs WebGL 2, which this browser does not offer.");
    this.gl = gl;
    this.canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => { this.gl = null; this.start(); this.upload(); this.redraw(); });
    this.program = programOf(gl, CLOUD_VERTEX, CLOUD_FRAGMENT);
    this.parts = {};
    for (const name of ["photons", "cells", "point"]) {
      const array = gl.createVertexArray(), buffer = gl.createBuffer();
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      for (const [place, numbers, offset] of [[0, 3, 0], [1, 3, 12], [2, 2, 24]]) {
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, numbers, gl.FLOAT, false, 32, offset);
      }
      this.parts[name] = {array, buffer, count: 0};
    }
  }

  async load(render) {
    this.start();
    const [photons, cells] = await Promise.all([request(`photons?most=${MOST_PHOTONS}`), request(`cells?most=${MOST_CELLS}`)]);
    this.photons = readPhotons(await photons.arrayBuffer());
    this.cells = readCells(await cells.arrayBuffer());
    if (!this.placed) this.home();
    this.placed = true;
    this.loaded = render;
    this.upload();
    this.redraw();
  }

  upload() {
    this.fill("photons", this.photons?.data);
    this.fill("cells", this.cells?.data);
    this.fill("point", this.point);
  }

  fill(name, data) {
    if (!this.gl) return;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.parts[name].buffer);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, data ?? new Float32Array(0), this.gl.STATIC_DRAW);
    this.parts[name].count = (data?.length ?? 0) / 8;
  }

  // Looks at the middle half of the photons along each axis.
  home() {
    const {data, count} = this.photons, target = [0, 0, 0], half = [1, 1, 1];
    for (let axis = 0; axis < 3 && count; ++axis) {
      const sorted = Float32Array.from({length: count}, (_, i) => data[8 * i + axis]).sort();
      const low = sorted[Math.floor(0.02 * (count - 1))], high = sorted[Math.ceil(0.98 * (count - 1))];
      target[axis] = (low + high) / 2;
      half[axis] = (high - low) / 2;
    }
    this.orbit = {yaw: 0.6, pitch: 0.35, distance: 2.6 * (Math.hypot(...half) || 1), target};
    this.redraw();
  }

  // Marks the disc of an estimate, its normal, and the octree cell of the lecture's test.
  markEstimate(estimate) {
    this.point = null;
    if (estimate) {
      const {point, normal} = estimate.hit, [u, v] = planeOf(normal), radius = Math.max(...estimate.maps.map(m => m.radius), 0);
      const on = k => {
        const angle = k * Math.PI / 24, across = vec.add(vec.scale(u, Math.cos(angle)), vec.scale(v, Math.sin(angle)));
        return vec.add(point, vec.scale(across, radius));
      };
      const corners = [point, vec.add(point, vec.scale(normal, 2 * radius))];
      for (let k = 0; k < 48; ++k) corners.push(on(k), on(k + 1));
      const {cell} = estimate;
      if (cell) corners.push(...EDGES.map(corner => cell.min.map((low, axis) => corner >> axis & 1 ? cell.max[axis] : low)));
      this.point = new Float32Array(corners.flatMap(p => [...p, 0, 0, 0, 0, -1]));
    }
    this.fill("point", this.point);
    this.redraw();
  }

  draw() {
    const {gl, canvas} = this;
    if (!gl || gl.isContextLost() || !canvas.clientWidth) return;
    const scale = fitCanvas(canvas), place = name => gl.getUniformLocation(this.program, name);
    const camera = orbitCamera(this.orbit, canvas.width / canvas.height, this.up);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.04, 0.05, 0.065, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.uniformMatrix4fv(place("camera"), false, camera.matrix);
    gl.uniform3fv(place("colours"), KIND_COLOURS.flatMap(rgbOf));
    gl.uniform4iv(place("shown"), this.shown);
    gl.uniform1i(place("by_flux"), byId("cloud-flux").checked ? 1 : 0);
    gl.uniform1f(place("depth"), Number(byId("cloud-depth").value));
    gl.uniform1f(place("size"), Number(byId("cloud-size").value) * scale);
    const draw = (name, how, alpha) => {
      gl.bindVertexArray(this.parts[name].array);
      gl.uniform1f(place("alpha"), alpha);
      gl.drawArrays(how, 0, this.parts[name].count);
    };
    draw("photons", gl.POINTS, 0.9);
    if (byId("cloud-cells").checked) draw("cells", gl.LINES, 0.35);
    gl.disable(gl.DEPTH_TEST);
    gl.uniform4iv(place("shown"), [1, 1, 1, 1]);
    gl.uniform3fv(place("colours"), [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]);
    gl.uniform1i(place("by_flux"), 0);
    draw("point", gl.LINES, 1);
  }

  turn(yaw, pitch) {
    this.orbit.yaw += yaw;
    this.orbit.pitch = clamp(this.orbit.pitch + pitch, -1.55, 1.55);
    this.redraw();
  }

  move(x, y) {
    const {right, above, perPixel} = orbitCamera(this.orbit, this.canvas.width / this.canvas.height, this.up);
    const unit = 2 * perPixel / Math.max(1, Math.min(this.canvas.clientHeight, this.canvas.clientWidth));
    this.orbit.target = vec.add(this.orbit.target, vec.add(vec.scale(right, -x * unit), vec.scale(above, y * unit)));
    this.redraw();
  }

  nearer(factor) {
    this.orbit.distance = clamp(this.orbit.distance / factor, 1e-6, 1e9);
    this.redraw();
  }

  // Returns whether the key is one of the cloud's.
  key(event) {
    const step = 0.08, turn = event.shiftKey ? (x, y) => this.move(-300 * x, 300 * y) : (x, y) => this.turn(x, y);
    const actions = {ArrowLeft: () => turn(-step, 0), ArrowRight: () => turn(step, 0), ArrowUp: () => turn(0, step),
                     ArrowDown: () => turn(0, -step), "+": () => this.nearer(1.2), "=": () => this.nearer(1.2),
                     "-": () => this.nearer(1 / 1.2), 0: () => this.home()};
    if (!Object.hasOwn(actions, event.key)) return false;
    if (this.photons) actions[event.key]();
    return true;
  }

  listen() {
    const {canvas, pointers} = this;
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.nearer(Math.exp(-clamp(event.deltaY, -300, 300) * 0.002));
    }, {passive: false});
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    canvas.addEventListener("pointermove", event => {
      const pointer = pointers.get(event.pointerId);
      if (!pointer) return;
      const dx = event.clientX - pointer.x, dy = event.clientY - pointer.y;
      const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const before = Math.hypot(pointer.x - other.x, pointer.y - other.y);
        const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
        if (before > 10 && after > 10) this.nearer(after / before);
        this.move(dx / 2, dy / 2);
      } else if (event.shiftKey || event.buttons & 6) this.move(dx, dy);
      else this.turn(-dx * 0.008, dy * 0.008);
      pointer.x = event.clientX, pointer.y = event.clientY;
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
    canvas.addEventListener("contextmenu", event => event.preventDefault());
  }
}
