// SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page: from the data that the program has put into it (page.cpp) to pictures. Everything is drawn anew when
// something changes, and nothing in between. Texts of the data become text nodes, never HTML.

"use strict";
(() => {

// ---- data ------------------------------------------------------------------------------------------------

const data = JSON.parse(document.getElementById("data").textContent);
const report = data.report;

// Little-endian numbers as base64.
function unpack(text, Type) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const view = new DataView(bytes.buffer), size = Type.BYTES_PER_ELEMENT, result = new Type(bytes.length / size);
  const get = {Uint8Array: "getUint8", Uint32Array: "getUint32", Float32Array: "getFloat32"}[Type.name];
  for (let i = 0; i < result.length; ++i)
    result[i] = view[get](i * size, true);
  return result;
}

const center = data.center; // points are relative to it
const points = unpack(data.points, Float32Array);
const kindOf = unpack(data["element kinds"], Uint8Array);
const vertices = unpack(data["element vertices"], Uint32Array); // of all elements, one after the other
const labelOf = unpack(data.labels, Uint32Array);
const isInRegion = unpack(data["in region"], Uint8Array);
const ratioOf = unpack(data.ARC, Float32Array);
const steps = data.steps.map(step => ({
  name: step.name, displacements: unpack(step.displacements, Float32Array), isRemoved: unpack(step.removed, Uint8Array)
}));
const numberOfElements = kindOf.length;
const NONE = 0xffffffff;

const firstVertex = new Uint32Array(numberOfElements + 1), centroids = new Float32Array(3 * numberOfElements);
for (let e = 0; e < numberOfElements; ++e) {
  const size = data.kinds[kindOf[e]].size;
  firstVertex[e + 1] = firstVertex[e] + size;
  for (let i = firstVertex[e]; i < firstVertex[e + 1]; ++i)
    for (let c = 0; c < 3; ++c)
      centroids[3 * e + c] += points[3 * vertices[i] + c] / size;
}

// Faces of elements: four vertices each (the fourth of a triangle is NONE), whose face it is, and what is beyond.
const faces = findFaces();

function findFaces() {
  let count = 0;
  for (let e = 0; e < numberOfElements; ++e)
    count += data.kinds[kindOf[e]].faces.length;
  const corners = new Uint32Array(4 * count), owner = new Uint32Array(count), beyond = new Uint32Array(count).fill(NONE);
  // Two faces are one if their three smallest vertices are: elements conform.
  let slots = 1;
  while (slots < 2 * count)
    slots *= 2;
  const table = new Uint32Array(slots).fill(NONE), keys = new Uint32Array(3 * count), sorted = new Uint32Array(4);
  let f = 0;
  for (let e = 0; e < numberOfElements; ++e)
    for (const face of data.kinds[kindOf[e]].faces) {
      for (let i = 0; i < 4; ++i)
        corners[4 * f + i] = sorted[i] = i < face.length ? vertices[firstVertex[e] + face[i]] : NONE;
      sorted.sort();
      keys.set(sorted.subarray(0, 3), 3 * f);
      owner[f] = e;
      let slot = (Math.imul(sorted[0], 73856093) ^ Math.imul(sorted[1], 19349663) ^ Math.imul(sorted[2], 83492791));
      slot = (slot ^ (slot >>> 15)) & (slots - 1);
      for (;; slot = (slot + 1) & (slots - 1)) {
        const g = table[slot];
        if (g === NONE) {
          table[slot] = f;
          break;
        }
        if (keys[3 * g] === sorted[0] && keys[3 * g + 1] === sorted[1] && keys[3 * g + 2] === sorted[2]) {
          beyond[f] = owner[g];
          beyond[g] = e;
          break;
        }
      }
      ++f;
    }
  return {count, corners, owner, beyond};
}

const box = {min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity]};
for (let i = 0; i < points.length; ++i) {
  box.min[i % 3] = Math.min(box.min[i % 3], points[i]);
  box.max[i % 3] = Math.max(box.max[i % 3], points[i]);
}
const diagonal = Math.hypot(...box.max.map((x, c) => x - box.min[c])) || 1;

const lengthOf = (step, v) => Math.hypot(...step.displacements.subarray(3 * v, 3 * v + 3));
let largestDisplacement = 0;
for (const step of steps)
  for (let v = 0; v < points.length / 3; ++v)
    largestDisplacement = Math.max(largestDisplacement, lengthOf(step, v));

// ---- what is shown ---------------------------------------------------------------------------------------

// Where the interest is: what is resected, or the region, or the middle. There the mesh is cut at the start.
function focus() {
  const removed = steps.length > 0 ? steps[steps.length - 1].isRemoved : [];
  for (const chosen of [removed, isInRegion]) {
    const sum = [0, 0, 0];
    let count = 0;
    for (let e = 0; e < numberOfElements; ++e)
      if (chosen[e]) {
        ++count;
        for (let c = 0; c < 3; ++c)
          sum[c] += centroids[3 * e + c];
      }
    if (count > 0 && count < numberOfElements)
      return sum.map(x => x / count);
  }
  return box.min.map((x, c) => (x + box.max[c]) / 2);
}

const start = focus();
const state = {
  color: steps.length > 0 ? "displacement" : "kind",
  step: steps.length, // 0: as it was
  amount: 1,          // times the displacement
  axis: 0,            // of the cut; -1: none
  cut: [...start],    // for each axis
  side: start[0] >= (box.min[0] + box.max[0]) / 2 ? 1 : -1, // the smaller part is taken away
  leastRatio: 1,
  hidden: new Set(),  // categories of the legend
  isPatient: true,
  hasEdges: true,
  hasPlaces: true,
  picked: -1,
  place: -1
};
const unit = () => state.isPatient ? " mm" : "";

const KIND_COLORS = ["#f7cc5c", "#e67345", "#8c6bad", "#6ba6d4"];
const LABEL_COLORS = ["#eddbcc", "#5c9ecc", "#f29e4d", "#73b36b", "#b885bf", "#d9635f", "#8f7a66", "#e8c84a"];
const REGION_COLORS = ["#d5dde6", "#e9a8c6"];
const RATIO_COLORS = ["#8cb8d6", "#f7e69e", "#f59e42", "#d43d29", "#73051a"];
const SHIFT_COLORS = ["#f7f5eb", "#fcd985", "#f28545", "#bf2e52", "#520d52"];
const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
const ramps = new Map([RATIO_COLORS, SHIFT_COLORS].map(colors => [colors, colors.map(rgb)]));

// Writes three bytes: the color at t of [0, 1].
function ramp(colors, t, target, at) {
  const stops = ramps.get(colors), x = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(x), stops.length - 2);
  for (let c = 0; c < 3; ++c)
    target[at + c] = stops[k][c] + (x - k) * (stops[k + 1][c] - stops[k][c]);
}

const worstRatio = ratioOf.reduce((a, b) => Math.max(a, b), 1);
const topRatio = Math.min(Math.max(Math.ceil(10 * worstRatio) / 10, 1.5), 7); // the paper calls up to 7 acceptable

const subdomainNames = new Map(data["subdomain names"]);
const labels = [...new Set(labelOf)].sort((a, b) => a - b);
const labelRow = new Map(labels.map((label, i) => [label, i]));
const nameOf = label => (subdomainNames.get(label) ?? "subdomain") + ` (${label})`;
const elementsName = (n, kind) => `${count(n)} ${n === 1 ? kind.name : kind.plural}`;

// Modes of color. Those with categories have a row for each in the legend; the others a ramp.
const MODES = {
  kind: {name: "Kind", caption: "Kind of element", category: e => kindOf[e],
         rows: data.kinds.map((kind, k) => ({name: kind.plural, color: KIND_COLORS[k]}))},
  ratio: {name: "ARC", caption: "Aspect-ratio coefficient, 1 is ideal", colors: RATIO_COLORS, from: 1, to: topRatio},
  label: {name: "Label", caption: "Label", category: e => labelRow.get(labelOf[e]),
          rows: labels.map((label, i) => ({name: nameOf(label), color: LABEL_COLORS[i % LABEL_COLORS.length]}))},
  region: {name: "Region", caption: "Region of interest", category: e => isInRegion[e],
           rows: [{name: "outside", color: REGION_COLORS[0]}, {name: "meets the region", color: REGION_COLORS[1]}]},
  displacement: {name: "Shift", caption: "Displacement, mm", colors: SHIFT_COLORS, from: 0,
                 to: largestDisplacement || 1}
};
if (steps.length === 0)
  delete MODES.displacement;
if (!isInRegion.includes(1))
  delete MODES.region;
for (const mode of Object.values(MODES))
  if (mode.category) {
    for (const row of mode.rows)
      row.count = 0;
    for (let e = 0; e < numberOfElements; ++e)
      ++mode.rows[mode.category(e)].count;
  }

const isShown = new Uint8Array(numberOfElements);
let numberShown = 0;

function selectElements() {
  const mode = MODES[state.color], removed = state.step > 0 ? steps[state.step - 1].isRemoved : [];
  numberShown = 0;
  for (let e = 0; e < numberOfElements; ++e) {
    isShown[e] = !removed[e] && ratioOf[e] >= state.leastRatio
      && (state.axis < 0 || state.side * (centroids[3 * e + state.axis] - state.cut[state.axis]) <= 0)
      && !(mode.category && state.hidden.has(mode.category(e)));
    numberShown += isShown[e];
  }
}

// Where vertices are, deformed.
function positions() {
  if (state.step === 0)
    return points;
  const u = steps[state.step - 1].displacements;
  return points.map((x, i) => x + state.amount * u[i]);
}

// ---- the picture -----------------------------------------------------------------------------------------

const $ = id => document.getElementById(id);
const view = $("view"), canvas = $("canvas"), overlay = $("overlay");
let renderer, camera, controls, surface, lines, outline, drawnFaces, scene;

function setUpScene() {
  THREE.ColorManagement.enabled = false; // colors are those of the legend
  renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  scene = new THREE.Scene();
  camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 8 * diagonal); // so that the scale holds everywhere
  camera.up.set(0, 0, 1);
  scene.add(new THREE.AmbientLight(0xffffff, 0.66 * Math.PI), camera);
  const light = new THREE.DirectionalLight(0xffffff, 0.42 * Math.PI);
  light.position.set(0.4, 0.7, 1);
  camera.add(light, light.target);
  const surfaceMaterial = new THREE.MeshLambertMaterial({vertexColors: true, flatShading: true, side: THREE.DoubleSide,
                                                         polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
  surface = new THREE.Mesh(new THREE.BufferGeometry(), surfaceMaterial);
  lines = new THREE.LineSegments(new THREE.BufferGeometry(),
                                 new THREE.LineBasicMaterial({color: 0x1a222b, transparent: true, opacity: 0.55}));
  outline = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0xd02070, depthTest: false}));
  outline.renderOrder = 1;
  scene.add(surface, lines, outline);
  controls = new THREE.OrbitControls(camera, canvas);
  controls.minZoom = 0.2;
  controls.maxZoom = 200;
  controls.addEventListener("change", render);
}

function setGeometry(object, attributes) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  for (const [name, array] of Object.entries(attributes))
    object.geometry.setAttribute(name, new THREE.BufferAttribute(array, 3, array instanceof Uint8Array));
}

// Draws the faces between what is shown and what is not.
function draw() {
  selectElements();
  const drawn = [];
  let triangles = 0;
  for (let f = 0; f < faces.count; ++f)
    if (isShown[faces.owner[f]] && (faces.beyond[f] === NONE || !isShown[faces.beyond[f]])) {
      drawn.push(f);
      triangles += faces.corners[4 * f + 3] === NONE ? 1 : 2;
    }
  const mode = MODES[state.color], where = positions();
  const xyz = new Float32Array(9 * triangles), color = new Uint8Array(9 * triangles), ends = [];
  drawnFaces = new Uint32Array(triangles);
  const categoryColors = mode.category ? mode.rows.map(row => rgb(row.color)) : [];
  const step = state.step > 0 ? steps[state.step - 1] : null, one = new Uint8Array(3);
  let t = 0;
  for (const f of drawn) {
    const e = faces.owner[f], corners = faces.corners.subarray(4 * f, 4 * f + 4), size = corners[3] === NONE ? 3 : 4;
    if (mode.category)
      one.set(categoryColors[mode.category(e)]);
    else if (state.color === "ratio")
      ramp(mode.colors, (ratioOf[e] - mode.from) / (mode.to - mode.from), one, 0);
    for (let i = 0; i + 2 < size; ++i, ++t) {
      drawnFaces[t] = f;
      for (const [k, corner] of [0, i + 1, i + 2].entries()) {
        const v = corners[corner], at = 9 * t + 3 * k;
        for (let c = 0; c < 3; ++c)
          xyz[at + c] = where[3 * v + c];
        if (state.color === "displacement")
          ramp(mode.colors, step ? state.amount * lengthOf(step, v) / mode.to : 0, color, at);
        else
          color.set(one, at);
      }
    }
    for (let i = 0; i < size; ++i) { // each edge once, as the face beyond has it the other way round
      const a = corners[i], b = corners[(i + 1) % size];
      if (a < b)
        ends.push(a, b);
    }
  }
  setGeometry(surface, {position: xyz, color});
  setGeometry(lines, {position: pointsOf(ends, where)});
  lines.visible = state.hasEdges;
  drawPicked(where);
  $("shown").textContent = `${count(numberShown)} of ${count(numberOfElements)} elements shown`;
  $("shown").dataset.shown = numberShown;
  render();
}

function pointsOf(list, where) {
  const xyz = new Float32Array(3 * list.length);
  for (let i = 0; i < list.length; ++i)
    for (let c = 0; c < 3; ++c)
      xyz[3 * i + c] = where[3 * list[i] + c];
  return xyz;
}

function drawPicked(where) {
  const e = state.picked, ends = [];
  if (e >= 0 && isShown[e])
    for (const face of data.kinds[kindOf[e]].faces)
      face.forEach((v, i) => ends.push(vertices[firstVertex[e] + v], vertices[firstVertex[e] + face[(i + 1) % face.length]]));
  setGeometry(outline, {position: pointsOf(ends, where)});
}

let isDrawAsked = false;
function askDraw() { // once a frame, however fast a slider moves
  if (!isDrawAsked)
    requestAnimationFrame(() => { isDrawAsked = false; draw(); });
  isDrawAsked = true;
}

function render() {
  renderer.render(scene, camera);
  drawOverlay();
}

// Looks from a direction at all of the mesh.
function lookFrom(direction) {
  const d = new THREE.Vector3(...direction).normalize();
  controls.target.set(...box.min.map((x, c) => (x + box.max[c]) / 2));
  camera.position.copy(controls.target).addScaledVector(d, 4 * diagonal);
  camera.zoom = 1;
  camera.updateProjectionMatrix();
  controls.update();
  render();
}

function resize() {
  const width = view.clientWidth, height = view.clientHeight;
  if (width === 0 || height === 0)
    return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  const half = 0.46 * diagonal / Math.min(1, width / height); // a brain leaves some margin for the letters
  camera.left = -half * width / height;
  camera.right = half * width / height;
  camera.top = half;
  camera.bottom = -half;
  camera.updateProjectionMatrix();
  render();
}

// ---- on top of the picture: directions, scale, places ----------------------------------------------------

const svg = (name, attributes = {}, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes))
    element.setAttribute(key, value);
  element.append(...children);
  return element;
};

// The letters of a direction, the nearest axis first: AR, say.
function directionName(d) {
  const names = state.isPatient ? ["RL", "AP", "SI"] : [["+x", "\u2212x"], ["+y", "\u2212y"], ["+z", "\u2212z"]];
  return [0, 1, 2].filter(c => Math.abs(d[c]) > 0.38).sort((a, b) => Math.abs(d[b]) - Math.abs(d[a]))
    .map(c => names[c][d[c] > 0 ? 0 : 1]).join(state.isPatient ? "" : " ");
}

function drawOverlay() {
  const width = view.clientWidth, height = view.clientHeight, m = camera.matrixWorld.elements;
  const right = [m[0], m[1], m[2]], up = [m[4], m[5], m[6]], minus = d => d.map(x => -x);
  const letter = (x, y, d) => svg("text", {x, y, class: "direction"}, directionName(d));
  const perPixel = (camera.top - camera.bottom) / camera.zoom / height;
  const onScreen = p => {
    const q = new THREE.Vector3(...p).project(camera);
    return [(q.x + 1) / 2 * width, (1 - q.y) / 2 * height];
  };
  const most = Math.min(180, 0.35 * width) * perPixel, power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map(x => x * power).find(x => x <= most) ?? power, pixels = length / perPixel;
  const x0 = 18, y0 = height - 18;
  const parts = [
    letter(width - 26, height / 2, right), letter(26, height / 2, minus(right)),
    letter(width / 2, 20, up), letter(width / 2, height - 20, minus(up)),
    svg("g", {class: "scale", "data-length": length},
        svg("path", {class: "bar", d: `M${x0} ${y0 - 5}v5h${pixels}v-5`}),
        svg("text", {x: x0 + pixels / 2, y: y0 - 14}, number(length) + unit()))
  ];
  if (state.hasPlaces) {
    for (const control of controlPoints) {
      const [a, b] = [onScreen(control.from), onScreen(control.to)];
      parts.push(svg("g", {class: "control"}, svg("title", {}, control.text), svg("circle", {cx: a[0], cy: a[1], r: 3.5}),
                     svg("path", {d: arrow(a, b)})));
    }
    places.forEach((place, i) => {
      if (!place.at)
        return;
      const [x, y] = onScreen(place.at);
      const pin = svg("g", {class: `pin ${place.kind}${i === state.place ? " current" : ""}`,
                            transform: `translate(${x} ${y})`},
                      svg("title", {}, place.text), svg("circle", {r: 9}), svg("text", {}, i + 1));
      pin.addEventListener("click", () => showPlace(i));
      parts.push(pin);
    });
  }
  overlay.replaceChildren(...parts);
}

function arrow([x, y], [X, Y]) {
  const l = Math.hypot(X - x, Y - y), [u, v] = l > 0 ? [(X - x) / l, (Y - y) / l] : [0, 0], h = Math.min(7, l);
  return `M${x} ${y}L${X} ${Y}L${X - h * u + h / 2 * v} ${Y - h * v - h / 2 * u}`
    + `L${X - h * u - h / 2 * v} ${Y - h * v + h / 2 * u}L${X} ${Y}`;
}

// ---- places ----------------------------------------------------------------------------------------------

const relative = p => p.map((x, c) => x - center[c]);
const controlPoints = (report["control points"] ?? []).map((c, i) => ({
  from: relative(c.position), to: relative(c.position.map((x, k) => x + c.displacement[k])),
  text: `Control point ${i + 1}, measured: ${number(Math.hypot(...c.displacement))} mm`
}));
const places = findPlaces();

// Warnings, those that name a point with it; then what is worth looking at.
function findPlaces() {
  const result = [], differences = report.topology?.differences ?? [];
  const pointIn = text => {
    const match = /\((-?[\d.e+-]+), (-?[\d.e+-]+), (-?[\d.e+-]+)\)/.exec(text);
    return match ? relative(match.slice(1).map(Number)) : undefined;
  };
  for (const text of report.warnings ?? []) {
    const difference = differences.find(d => text.endsWith(d.text));
    result.push({kind: "warning", text, at: difference ? relative(difference.at) : pointIn(text)});
  }
  for (const d of differences)
    if (!result.some(place => place.text.endsWith(d.text)))
      result.push({kind: "warning", text: d.text, at: relative(d.at)});
  const distances = report.surface?.["Hausdorff distance"];
  if (distances) {
    const [d, what] = ["from mesh to surface", "from surface to mesh"].map(key => [distances[key], key])
      .reduce((a, b) => a[0].distance >= b[0].distance ? a : b);
    result.push({kind: "note", at: relative(d.at), length: d.distance, text: `Farthest ${what}`});
  }
  const shift = report["shift after resection"] ?? report.shift;
  if (shift)
    result.push({kind: "note", at: relative(shift.at), length: shift["largest displacement"], text: "Largest displacement"});
  const worst = ratioOf.indexOf(worstRatio);
  if (worst >= 0)
    result.push({kind: "note", element: worst, at: [...centroids.subarray(3 * worst, 3 * worst + 3)],
                 text: `Largest aspect ratio: ${number(worstRatio)}, ${data.kinds[kindOf[worst]].name} ${worst}`});
  return result;
}

// Moves it into the middle, without turning; of a cut mesh, the cut goes there.
function showPlace(i) {
  const place = places[i];
  state.place = i;
  const offset = camera.position.clone().sub(controls.target);
  controls.target.set(...place.at);
  camera.position.copy(controls.target).add(offset);
  camera.zoom = Math.max(camera.zoom, 2.2);
  camera.updateProjectionMatrix();
  if (state.axis >= 0)
    state.cut[state.axis] = place.at[state.axis];
  if (place.element !== undefined)
    pick(place.element);
  controls.update();
  showSettings();
  draw();
}

function pick(e) {
  state.picked = e;
  const card = $("picked");
  card.hidden = e < 0;
  if (e < 0)
    return;
  const at = [0, 1, 2].map(c => centroids[3 * e + c] + center[c]);
  const names = state.isPatient ? ["R", "A", "S"] : ["x", "y", "z"];
  const rows = [["ARC", number(ratioOf[e])], ["Label", nameOf(labelOf[e])],
                ["Center", at.map((x, c) => `${names[c]} ${x.toFixed(1)}`).join(", ") + unit()]];
  if (MODES.region)
    rows.push(["Region", isInRegion[e] ? "meets it" : "outside"]);
  if (state.step > 0) {
    const own = vertices.subarray(firstVertex[e], firstVertex[e + 1]), step = steps[state.step - 1];
    rows.push(["Shift", number(own.reduce((sum, v) => sum + lengthOf(step, v), 0) / own.length) + " mm"]);
  }
  const close = make("button", {"aria-label": "Close", onclick: () => { pick(-1); draw(); }}, "\u00d7");
  card.replaceChildren(make("h3", {}, `${capital(data.kinds[kindOf[e]].name)} ${e}`), close, list(rows));
}

// ---- texts and elements of the page ----------------------------------------------------------------------

function number(x) {
  if (x === null || x === undefined || !Number.isFinite(x))
    return x === Infinity ? "\u221e" : "\u2013";
  return Number(x.toPrecision(3)).toLocaleString("en", {maximumSignificantDigits: 3}).replace("-", "\u2212");
}
function count(n) { return n.toLocaleString("en"); }
function percent(x) { return x === undefined ? "\u2013" : (100 * x).toFixed(x > 0.9995 || x === 0 ? 0 : 1) + " %"; }
function capital(text) { return text.charAt(0).toUpperCase() + text.slice(1); }
function fileName(path) { return path.split("/").pop(); }

function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on"))
      element.addEventListener(key.slice(2), value);
    else
      element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function list(rows) {
  const element = make("dl");
  for (const [name, value] of rows)
    element.append(make("dt", {}, name), make("dd", {}, value));
  return element;
}

// A row of the settings: buttons of which one is pressed.
function choice(name, options, current, choose) {
  const buttons = make("div", {class: "choice", role: "group", "aria-label": name});
  for (const [value, text, title] of options)
    buttons.append(make("button", {type: "button", "aria-pressed": value === current, "data-value": value,
                                   title: title ?? "", onclick: () => choose(value)}, text));
  return make("div", {class: "row"}, make("span", {class: "name"}, name), buttons);
}

function slider(name, attributes, text, change) {
  const output = make("output", {}, text(attributes.value));
  const input = make("input", {type: "range", ...attributes, oninput: () => {
    change(Number(input.value));
    output.textContent = text(Number(input.value));
    askDraw();
  }});
  return make("label", {class: "row"}, make("span", {class: "name"}, name), input, output);
}

const AXES = () => state.isPatient ? [["Sagittal", "R", "L"], ["Coronal", "A", "P"], ["Axial", "S", "I"]]
                                   : [["x", "", ""], ["y", "", ""], ["z", "", ""]];

function cutText(x) {
  const [, plus, minus] = AXES()[state.axis], there = x + center[state.axis];
  if (!state.isPatient)
    return number(there);
  return `${plus && there >= 0 ? plus : minus} ${Math.abs(there).toFixed(1)} mm`;
}

// What depends on the state is made anew, with the focus on what had it.
function showSettings() {
  const active = document.activeElement, section = active?.closest("#settings > div")?.id;
  const where = section && [...$(section).querySelectorAll("button, input")].indexOf(active);
  const set = changes => () => { Object.assign(state, changes); update(); };
  if (steps.length > 0) {
    const names = ["Before", ...steps.map(step => capital(step.name))];
    const amount = slider("Deformation", {id: "amount", min: 0, max: 3, step: 0.05, value: state.amount},
                          x => "\u00d7 " + x.toFixed(2), x => { state.amount = x; });
    amount.querySelector("input").disabled = state.step === 0;
    $("steps").replaceChildren(choice("State", names.map((name, i) => [i, name]), state.step, i => set({step: i})()), amount);
  }
  $("colors").replaceChildren(choice("Color", Object.entries(MODES).map(([key, mode]) => [key, mode.name]), state.color,
                                     key => { state.hidden.clear(); set({color: key})(); }));
  const cut = choice("Cut", [[-1, "Off"], ...AXES().map(([name], c) => [c, name])], state.axis, c => set({axis: c})());
  $("cuts").replaceChildren(cut);
  if (state.axis >= 0) {
    const low = box.min[state.axis], high = box.max[state.axis];
    const row = slider("Position", {id: "cut", min: low, max: high, step: (high - low) / 500, value: state.cut[state.axis]},
                       cutText, x => { state.cut[state.axis] = x; });
    const flip = make("div", {class: "row"}, make("span", {class: "name"}),
                      make("button", {type: "button", id: "flip", onclick: set({side: -state.side})}, "Other side"));
    $("cuts").append(row, flip);
  }
  $("filter").replaceChildren(slider("ARC from", {id: "least", min: 1, max: Math.min(worstRatio, topRatio), step: 0.01,
                                                  value: state.leastRatio}, x => x.toFixed(2),
                                     x => { state.leastRatio = x; }));
  const directions = state.isPatient ? "RLAPSI" : ["+x", "\u2212x", "+y", "\u2212y", "+z", "\u2212z"];
  $("views").replaceChildren(choice("View from", [...[...directions].map((text, i) => [i, text]), [6, "\u27f2", "As at the start"]],
                                    null, i => lookFrom(DIRECTIONS[i])));
  const check = (key, text) => {
    const input = make("input", {type: "checkbox", id: key, onchange: () => { state[key] = input.checked; update(); }});
    input.checked = state[key];
    return make("label", {}, input, text);
  };
  $("switches").replaceChildren(check("hasEdges", "Edges"), check("hasPlaces", "Places"));
  if (!data["is in patient space"])
    $("switches").append(check("isPatient", "Patient axes, mm"),
                         make("p", {}, `${fileName(sourceFile)} does not say its unit or axes: mm and RAS are assumed.`));
  if (where >= 0)
    $(section).querySelectorAll("button, input")[where]?.focus();
}

const DIRECTIONS = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, -1e-4, 1], [0, 1e-4, -1],
                    [1.0 * state.side, 0.75, 0.55]];

function showLegend() {
  const mode = MODES[state.color], legend = $("legend");
  const caption = make("p", {class: "caption"}, mode.caption);
  if (mode.category) {
    const rows = make("div", {class: "rows"});
    mode.rows.forEach((row, i) => {
      if (row.count === 0)
        return;
      const toggle = () => {
        if (!state.hidden.delete(i))
          state.hidden.add(i);
        update();
        legend.querySelectorAll("button")[index]?.focus();
      };
      const index = rows.childElementCount;
      rows.append(make("button", {type: "button", "aria-pressed": !state.hidden.has(i), title: "Show or hide", onclick: toggle},
                       make("span", {class: "swatch", style: `background: ${row.color}`}), make("span", {}, row.name),
                       make("span", {}, count(row.count))));
    });
    legend.replaceChildren(caption, rows);
    return;
  }
  const ticks = [0, 1, 2, 3, 4].map(i => mode.from + i / 4 * (mode.to - mode.from));
  const isOpen = state.color === "ratio" && worstRatio > topRatio;
  legend.replaceChildren(
    caption, make("div", {class: "ramp", style: `background: linear-gradient(to right, ${mode.colors.join(", ")})`}),
    make("div", {class: "ticks"}, ...ticks.map((x, i) => make("span", {}, (isOpen && i === 4 ? "\u2265 " : "") + number(x)))));
}

function update() {
  showSettings();
  showLegend();
  draw();
}

// ---- the report ------------------------------------------------------------------------------------------

const sourceFile = report.inputs.surface?.file ?? report.inputs.mesh?.file ?? "";

function showFacts() {
  const mesh = report.mesh ?? report.inputs.mesh, fidelity = report.surface, shift = report["shift after resection"] ?? report.shift;
  const cubic = volume => state.isPatient ? `${count(Math.round(volume / 1000))} ml` : number(volume);
  const facts = [["vertices", count(mesh.vertices)], ["elements", count(mesh.elements)], ["volume", cubic(mesh.volume)]];
  if (fidelity)
    facts.push(["Hausdorff distance to the surface", number(fidelity["Hausdorff distance"].distance) + unit()],
               ["of the surface\u2019s volume", percent(fidelity["ratio of volumes"])]);
  if (shift)
    facts.push(["largest shift", number(shift["largest displacement"]) + " mm"],
               ["control points missed by up to", number(shift["control points missed by at most"]) + " mm"]);
  if (report.resection)
    facts.push(["resected", number(report.resection["cavity volume"] / 1000) + " ml"]);
  if (report.octree)
    facts.push(["largest ARC", number(worstRatio)]);
  while (facts.length % 3 !== 0)
    facts.push(["", ""]);
  $("facts").replaceChildren(...facts.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))));
  const lengths = $("places").querySelectorAll("[data-length]");
  lengths.forEach(span => { span.textContent = `: ${number(Number(span.dataset.length))}${unit()}`; });
}

// The paper's Table 1: what elements of each kind are like.
function showTable() {
  const rows = data.kinds.map((kind, k) => [capital(kind.plural), e => kindOf[e] === k]).reverse();
  rows.push(["All", () => true]);
  const head = make("tr", {}, ...["", "Number", "Mean", "Min", "Max", "\u2264 7", "1.3 to 7"].map(text => make("th", {scope: "col"}, text)));
  $("table").replaceChildren(head);
  for (const [name, belongs] of rows) {
    const values = ratioOf.filter((_, e) => belongs(e)), n = values.length;
    const mean = values.reduce((a, b) => a + b, 0) / n, share = (low, high) => values.filter(x => low <= x && x <= high).length / n;
    const cells = n === 0 ? Array(5).fill("\u2013")
      : [mean.toFixed(2), values.reduce((a, b) => Math.min(a, b)).toFixed(2), values.reduce((a, b) => Math.max(a, b)).toFixed(2),
         percent(share(0, 7)), percent(share(1.3, 7))];
    $("table").append(make("tr", {}, make("td", {}, name), make("td", {}, count(n)), ...cells.map(text => make("td", {}, text))));
  }
}

// Bins of a tenth, as in the report: the first has all below 1.1, the last all from 3 on.
function showHistogram() {
  const edges = Array.from({length: 20}, (_, i) => (i + 11) / 10), bins = Array(21).fill(0);
  for (const ratio of ratioOf)
    ++bins[edges.filter(edge => edge <= ratio).length];
  const before = report.quality?.histograms.ARC.before;
  const share = (list, i) => list[i] / list.reduce((a, b) => a + b, 0);
  const top = Math.max(...bins.map((_, i) => Math.max(share(bins, i), before ? share(before, i) : 0)));
  const width = 360, height = 120, bar = width / 21, y = x => height * (1 - x / top);
  const picture = svg("svg", {viewBox: `0 -4 ${width} ${height + 24}`, role: "img", "aria-label": "Histogram of the aspect ratio"});
  bins.forEach((n, i) => {
    const c = new Uint8Array(3);
    ramp(RATIO_COLORS, (0.05 + i / 10) / (topRatio - 1), c, 0);
    const range = i === 20 ? "3 and more" : `${(1 + i / 10).toFixed(1)} to ${(1.1 + i / 10).toFixed(1)}`;
    picture.append(svg("rect", {x: i * bar + 1, width: bar - 2, y: y(share(bins, i)), height: height - y(share(bins, i)),
                                fill: `rgb(${c.join()})`},
                       svg("title", {}, `${range}: ${count(n)} elements, ${percent(share(bins, i))}`)));
  });
  if (before)
    picture.append(svg("path", {class: "before", d: "M0 " + height + before.map((_, i) => `V${y(share(before, i))}h${bar}`).join("") + "V" + height}));
  picture.append(svg("line", {x1: 0, x2: width, y1: height, y2: height}));
  for (const x of [1, 1.5, 2, 2.5, 3])
    picture.append(svg("text", {x: Math.max((x - 1) * 10 * bar, 5), y: height + 16}, (x === 3 ? "\u2265 " : "") + x.toFixed(1)));
  $("histogram").replaceChildren(picture, make("p", {}, before ? "Share of elements; the line is before the boundary was fitted."
                                                               : "Share of elements."));
}

function showPlaces() {
  $("places").hidden = places.length === 0;
  $("places").querySelector("ol").replaceChildren(...places.map((place, i) => {
    const text = make("span", {}, place.text);
    if (place.length !== undefined)
      text.append(make("span", {"data-length": place.length}));
    const item = make("li", {class: place.kind}, make("span", {"aria-hidden": "true"}, i + 1), text);
    if (place.at)
      item.append(make("button", {type: "button", onclick: () => showPlace(i), "aria-label": `Show place ${i + 1}`}, "Show"));
    return item;
  }));
}

function showChecks() {
  const checks = Object.entries(report.checks ?? {});
  for (const [key, text] of [["shift", "by the shift"], ["shift after resection", "by the shift after resection"]])
    if (report[key])
      checks.push([`no element inverted ${text}`, report[key]["inverted elements"] === 0]);
  $("checks").hidden = checks.length === 0;
  $("checks").querySelector("ul").replaceChildren(
    ...checks.map(([name, holds]) => make("li", {class: holds ? "holds" : "fails"}, capital(name))));
}

// Any JSON: objects become lists, and what is in them opens on demand.
function tree(value) {
  const element = make("dl");
  for (const [key, x] of Object.entries(value))
    if (x !== null && typeof x === "object" && !(Array.isArray(x) && x.every(y => typeof y !== "object"))) {
      const details = make("details", {style: "grid-column: 1 / -1"}, make("summary", {}, key));
      details.addEventListener("toggle", () => { if (details.childElementCount === 1) details.append(tree(x)); });
      element.append(details);
    } else {
      element.append(make("dt", {}, key), make("dd", {}, Array.isArray(x) ? x.join(", ") : String(x ?? "\u2013")));
    }
  return element;
}

function showReport() {
  const name = fileName(sourceFile), program = report.program;
  document.title = `${name} \u2013 ${program.name}`;
  $("title").textContent = name;
  $("subtitle").textContent = program.name === "brain_shift" ? "Brain shift" : `Mixed-element mesh: ${report.status}`;
  canvas.setAttribute("aria-label", `The mesh of ${name} in 3D`);
  $("command").textContent = data.command;
  $("report").append(tree(report));
  $("credits").textContent = `${program.name} ${program.version}, CGAL ${program.CGAL}. Drawn with three.js (MIT license).`;
  showTable();
  showHistogram();
  showPlaces();
  showChecks();
}

// ---- mouse and keys --------------------------------------------------------------------------------------

function listen() {
  let pressed = null;
  canvas.addEventListener("pointerdown", event => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener("pointerup", event => {
    if (!pressed || event.button !== 0 || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4)
      return;
    const bounds = canvas.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - bounds.left) / bounds.width - 1,
                                        1 - 2 * (event.clientY - bounds.top) / bounds.height), camera);
    const hit = ray.intersectObject(surface)[0];
    pick(hit ? faces.owner[drawnFaces[hit.faceIndex]] : -1);
    draw();
  });
  const turn = (azimuth, height) => {
    const offset = camera.position.clone().sub(controls.target), r = offset.length();
    const longitude = Math.atan2(offset.y, offset.x) + azimuth;
    const latitude = Math.min(Math.max(Math.asin(offset.z / r) + height, -1.5707), 1.5707);
    camera.position.set(Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude), Math.sin(latitude))
      .multiplyScalar(r).add(controls.target);
  };
  const zoom = factor => { camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.2), 200); camera.updateProjectionMatrix(); };
  const cut = share => {
    if (state.axis < 0)
      return;
    const low = box.min[state.axis], high = box.max[state.axis];
    state.cut[state.axis] = Math.min(Math.max(state.cut[state.axis] + share * (high - low), low), high);
    update();
  };
  const keys = {ArrowLeft: () => turn(-0.12, 0), ArrowRight: () => turn(0.12, 0), ArrowUp: () => turn(0, 0.12),
                ArrowDown: () => turn(0, -0.12), "+": () => zoom(1.2), "=": () => zoom(1.2), "-": () => zoom(1 / 1.2),
                "[": () => cut(-0.02), "]": () => cut(0.02), 0: () => lookFrom(DIRECTIONS[6])};
  [..."rlapsi"].forEach((key, i) => { keys[key] = () => lookFrom(DIRECTIONS[i]); });
  canvas.addEventListener("keydown", event => {
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey)
      return;
    event.preventDefault();
    action();
    controls.update();
    render();
  });
  new ResizeObserver(resize).observe(view);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", render);
}

showReport();
showFacts();
$("main").hidden = false;
try {
  setUpScene();
} catch (error) {
  view.replaceChildren(make("p", {class: "error"}, "This browser cannot draw in 3D: WebGL is missing or switched off."));
  return;
}
listen();
resize();
update();
lookFrom(DIRECTIONS[6]);
document.documentElement.dataset.firstPicture = Math.round(performance.now());
window.mixedMeshPage = {state, update, render};

})();
