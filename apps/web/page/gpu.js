"use strict";
// Draws a picture, or two on the sides of a divider, by WebGL 2 from float textures. canvas.js does the same without it.

const VERTEX = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`;

const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
struct Layer { int show; vec2 range; };
uniform sampler2D now_values, now_base, other_values, other_base, ramps;
uniform Layer now, other;
uniform ivec2 size;       // of the picture
uniform vec2 origin;      // of the picture in the canvas, from its upper left corner
uniform float scale;      // canvas pixels a picture pixel
uniform float height;     // of the canvas
uniform float split;      // left of it stands the other picture
uniform float difference; // factor of the difference; 0: none
uniform float gain;
uniform int operator;     // the index in OPERATORS
out vec4 colour;

const float a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14;

bool number(float x) { return x == x; }
float clip(float x) { return x > 0.0 ? min(x, 1.0) : 0.0; }
vec3 clip(vec3 v) { return vec3(clip(v.x), clip(v.y), clip(v.z)); }
float filmic(float x) {
  if (!(x > 0.0)) return 0.0;
  if (x > 1e6) return 1.0;
  return clip(x * (a * x + b) / (x * (c * x + d) + e));
}
float encode(float x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055; }
vec3 encode(vec3 v) { return vec3(encode(v.x), encode(v.y), encode(v.z)); }

vec3 tonemap(vec3 v) {
  v *= gain;
  if (operator == 2) return vec3(filmic(v.x), filmic(v.y), filmic(v.z));
  float Y = dot(v, vec3(0.2126, 0.7152, 0.0722));
  if (operator == 1 && Y == Y && !isinf(Y)) v /= 1.0 + max(Y, 0.0);
  return clip(v);
}

vec3 from_ramp(float place, float row) {
  if (!number(place)) return vec3(1.0, 0.0, 1.0);
  return texelFetch(ramps, ivec2(int(clamp(place, 0.0, 1.0) * 255.0 + 0.5), int(row)), 0).rgb;
}

vec3 shown(Layer layer, vec3 v, vec3 base) {
  if (layer.show == 0) return encode(tonemap(v));
  if (layer.show == 1) return encode(clip(v));
  if (layer.show == 2) return v == vec3(0.0) ? v : clip((v + 1.0) / 2.0);
  if (layer.show == 3) return from_ramp((v.x - layer.range.x) / (layer.range.y - layer.range.x), 0.0);
  if (layer.show == 4) {
    vec3 squares = v * v / (base * base + 0.01);
    float error = sqrt((squares.x + squares.y + squares.z) / 3.0);
    return from_ramp(error == 0.0 ? 0.0 : log(error) / log(100.0) + 1.0, 1.0);
  }
  return clip(v);
}

vec3 now_at(ivec2 p) { return shown(now, texelFetch(now_values, p, 0).rgb, texelFetch(now_base, p, 0).rgb); }
vec3 other_at(ivec2 p) { return shown(other, texelFetch(other_values, p, 0).rgb, texelFetch(other_base, p, 0).rgb); }
vec3 at(ivec2 p, bool left) {
  if (difference > 0.0) return min(abs(now_at(p) - other_at(p)) * difference, 1.0);
  return left ? other_at(p) : now_at(p);
}

void main() {
  vec2 place = vec2(gl_FragCoord.x, height - gl_FragCoord.y);
  vec2 p = (place - origin) / scale;
  if (p.x < 0.0 || p.y < 0.0 || p.x >= float(size.x) || p.y >= float(size.y)) discard;
  bool left = place.x < split;
  int n = int(clamp(ceil(1.0 / scale - 0.01), 1.0, 8.0));
  if (n == 1) {
    colour = vec4(at(ivec2(p), left), 1.0);
    return;
  }
  // The mean over the pixels that this one covers, in nearly linear light.
  vec3 sum = vec3(0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      vec2 q = p + ((vec2(i, j) + 0.5) / float(n) - 0.5) / scale;
      vec3 v = at(clamp(ivec2(q), ivec2(0), size - 1), left);
      sum += v * v;
    }
  colour = vec4(sqrt(sum / float(n * n)), 1.0);
}`;

// Throws an Error with the compiler's words.
function programOf(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
      throw new Error(gl.getShaderInfoLog(shader));
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program));
  return program;
}

class GpuDrawer {
  // Throws an Error where WebGL 2 is missing, or textures of this size are.
  constructor(canvas, width, height) {
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2", {antialias: false, premultipliedAlpha: false});
    if (!this.gl) throw new Error("no WebGL 2");
    if (Math.max(width, height) > this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE)) throw new Error("too many pixels");
    canvas.addEventListener("webglcontextlost", event => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => { this.start(); this.onRestored?.(); });
    this.start();
  }

  get name() { return "WebGL"; }

  start() {
    const gl = this.gl;
    this.program = programOf(gl, VERTEX, FRAGMENT);
    this.places = new Map();
    this.textures = new Map();  // picture -> texture
    this.ramps = gl.createTexture();
    this.bind(4, this.ramps);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 2, 0, gl.RGBA, gl.UNSIGNED_BYTE,
                  new Uint8Array([...RAMPS.even, ...RAMPS.heat]));
  }

  place(name) {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name);
  }

  bind(unit, texture) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T])
      gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  }

  // Binds the texture of a picture with all its pixels.
  use(unit, picture) {
    const gl = this.gl, {width, height, channels} = picture;
    const format = channels === 1 ? gl.RED : gl.RGB, stored = channels === 1 ? gl.R32F : gl.RGB32F;
    let texture = this.textures.get(picture);
    const fresh = !texture;
    if (fresh) this.textures.set(picture, texture = gl.createTexture());
    this.bind(unit, texture);
    if (fresh) gl.texStorage2D(gl.TEXTURE_2D, 1, stored, width, height);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, width);
    for (const [x, y, w, h] of fresh ? [[0, 0, width, height]] : picture.dirty) {
      gl.pixelStorei(gl.UNPACK_SKIP_PIXELS, x);
      gl.pixelStorei(gl.UNPACK_SKIP_ROWS, y);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, w, h, format, gl.FLOAT, picture.values);
    }
    for (const name of [gl.UNPACK_ROW_LENGTH, gl.UNPACK_SKIP_PIXELS, gl.UNPACK_SKIP_ROWS]) gl.pixelStorei(name, 0);
    picture.dirty = [];
  }

  useLayer(name, unit, picture) {
    const gl = this.gl;
    this.use(unit, picture);
    this.use(unit + 1, picture.radiance ?? picture);
    gl.uniform1i(this.place(`${name}_values`), unit);
    gl.uniform1i(this.place(`${name}_base`), unit + 1);
    gl.uniform1i(this.place(`${name}.show`), picture.show);
    gl.uniform2f(this.place(`${name}.range`), picture.low, picture.high);
  }

  forgetAllBut(pictures) {
    for (const [picture, texture] of this.textures)
      if (!pictures.includes(picture)) {
        this.gl.deleteTexture(texture);
        this.textures.delete(picture);
      }
  }

  // frame: {now, other (or null), look, x, y, scale, split, difference}, lengths in pixels of the canvas.
  draw(frame) {
    const gl = this.gl, {canvas} = this, other = frame.other ?? frame.now;
    if (gl.isContextLost()) return;
    this.forgetAllBut([frame.now, frame.now.radiance, other, other.radiance]);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.program);
    this.useLayer("now", 0, frame.now);
    this.useLayer("other", 2, other);
    gl.uniform1i(this.place("ramps"), 4);
    gl.uniform2i(this.place("size"), frame.now.width, frame.now.height);
    gl.uniform2f(this.place("origin"), frame.x, frame.y);
    gl.uniform1f(this.place("scale"), frame.scale);
    gl.uniform1f(this.place("height"), canvas.height);
    gl.uniform1f(this.place("split"), frame.other ? frame.split : -1);
    gl.uniform1f(this.place("difference"), frame.other ? frame.difference : 0);
    gl.uniform1f(this.place("gain"), frame.look.gain);
    gl.uniform1i(this.place("operator"), OPERATORS.indexOf(frame.look.operator));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
