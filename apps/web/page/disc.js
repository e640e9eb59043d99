"use strict";
// A plane view of what a density estimate read: the disc around a point, its photons, and the octree cell around it.

const vec = {
  add: (a, b) => a.map((x, i) => x + b[i]),
  sub: (a, b) => a.map((x, i) => x - b[i]),
  scale: (a, s) => a.map(x => x * s),
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  unit: a => vec.scale(a, 1 / (Math.hypot(...a) || 1))};

// Two unit vectors across a unit normal.
function planeOf(normal) {
  const axis = Math.abs(normal[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  const u = vec.unit(vec.cross(axis, normal));
  return [u, vec.cross(normal, u)];
}

// The part of a square of the plane around the point that lies in a box, as points [a, b] of the plane
// (Sutherland and Hodgman 1974).
function cutOfBox(point, [u, v], box, half) {
  let polygon = [[-half, -half], [half, -half], [half, half], [-half, half]];
  for (let axis = 0; axis < 3; ++axis)
    for (const [side, sign] of [[box.min[axis], 1], [box.max[axis], -1]]) {
      const inside = ([a, b]) => sign * (point[axis] + a * u[axis] + b * v[axis] - side);
      const kept = [];
      polygon.forEach((p, i) => {
        const q = polygon[(i + 1) % polygon.length], d = inside(p), e = inside(q);
        if (d >= 0) kept.push(p);
        if (d >= 0 !== e >= 0) kept.push(p.map((x, k) => x + d / (d - e) * (q[k] - x)));
      });
      polygon = kept;
    }
  return polygon;
}

// A flux as a colour: its hue at full brightness.
function hueOf(r, g, b) {
  const most = Math.max(r, g, b);
  if (!(most > 0)) return "rgb(128 128 128)";
  return `rgb(${[r, g, b].map(x => Math.round(255 * encode(clip(x / most)))).join(" ")})`;
}

// Draws one map of an estimate into a canvas, out to the disc's edge, or to those of the whole cell; returns
// [x, y, photon] of the dots in CSS pixels.
function drawDisc(canvas, estimate, map, wholeCell) {
  const scale = fitCanvas(canvas), context = canvas.getContext("2d"), side = Math.min(canvas.clientWidth, canvas.clientHeight);
  const {point, normal} = estimate.hit, plane = planeOf(normal);
  const ofDisc = Math.max(map.radius, ...map.photons.map(p => p[6])) || 1;
  const {cell} = estimate, cut = cell ? cutOfBox(point, plane, cell, Math.hypot(...vec.sub(cell.max, cell.min))) : [];
  const reach = wholeCell ? Math.max(ofDisc, ...cut.flat().map(Math.abs)) : ofDisc, unit = side / 2 / (1.12 * reach);
  const at = (a, b) => [canvas.clientWidth / 2 + a * unit, canvas.clientHeight / 2 - b * unit];
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  if (cut.length) {
    context.beginPath();
    cut.forEach(([a, b], i) => i ? context.lineTo(...at(a, b)) : context.moveTo(...at(a, b)));
    context.closePath();
    context.fillStyle = cell.trusted ? "rgb(0 158 115 / .18)" : "rgb(213 94 0 / .18)";
    context.strokeStyle = cell.trusted ? "#00b383" : "#e8772e";
    context.fill();
    context.stroke();
  }
  context.strokeStyle = "rgb(255 255 255 / .85)";
  context.lineWidth = 1.5;
  context.beginPath();
  context.arc(...at(0, 0), map.radius * unit, 0, 2 * Math.PI);
  context.stroke();
  const most = Math.max(...map.photons.map(p => p[7])) || 1;
  const dots = map.photons.map(photon => {
    const across = vec.sub(photon.slice(0, 3), point);
    return [...at(vec.dot(across, plane[0]), vec.dot(across, plane[1])), photon];
  });
  for (const [x, y, photon] of dots) {
    context.globalAlpha = 0.25 + 0.75 * clamp(photon[7] / most, 0, 1);
    context.fillStyle = hueOf(photon[3], photon[4], photon[5]);
    context.beginPath();
    context.arc(x, y, 1.2 + 2.6 * Math.sqrt(clamp(photon[7] / most, 0, 1)), 0, 2 * Math.PI);
    context.fill();
  }
  context.globalAlpha = 1;
  drawScaleBar(context, canvas, reach, unit);
  return dots;
}

function drawScaleBar(context, canvas, reach, unit) {
  const power = 10 ** Math.floor(Math.log10(reach)), length = [5, 2, 1].map(k => k * power).find(l => l <= reach) ?? power;
  const x = 10, y = canvas.clientHeight - 10;
  context.fillStyle = context.strokeStyle = "#fff";
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + length * unit, y);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.fillText(`${short(length)} m`, x, y - 4);
}
