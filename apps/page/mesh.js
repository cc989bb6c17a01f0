// SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh that the program has put into the page (page.cpp), which elements are shown, and their colors.

const data = JSON.parse(document.getElementById("data").textContent);
const report = data.report;

// Little-endian numbers as base64.
function unpack(text, Type) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const view = new DataView(bytes.buffer), size = Type.BYTES_PER_ELEMENT,
        result = new Type(bytes.length / size);
  const get = {Uint8Array: "getUint8", Uint32Array: "getUint32", Float32Array: "getFloat32"}[Type.name];
  for (let i = 0; i < result.length; ++i) result[i] = view[get](i * size, true);
  return result;
}

const center = data.center;  // points are relative to it
const points = unpack(data.points, Float32Array);
const kindOf = unpack(data["element kinds"], Uint8Array);
const vertices = unpack(data["element vertices"], Uint32Array);  // of all elements, one after the other
const labelOf = unpack(data.labels, Uint32Array);
const isInRegion = unpack(data["in region"], Uint8Array);
const ratioOf = unpack(data.ARC, Float32Array);
const steps = data.steps.map(step => ({
                               name: step.name,
                               displacements: unpack(step.displacements, Float32Array),
                               isRemoved: unpack(step.removed, Uint8Array)
                             }));
const numberOfElements = kindOf.length;
const NONE = 0xffffffff;

const firstVertex = new Uint32Array(numberOfElements + 1), centroids = new Float32Array(3 * numberOfElements);
for (let e = 0; e < numberOfElements; ++e) {
  const size = data.kinds[kindOf[e]].size;
  firstVertex[e + 1] = firstVertex[e] + size;
  for (let i = firstVertex[e]; i < firstVertex[e + 1]; ++i)
    for (let c = 0; c < 3; ++c) centroids[3 * e + c] += points[3 * vertices[i] + c] / size;
}

// Faces: four vertices each (the fourth of a triangle is NONE), the element, and the one beyond.
const faces = findFaces();

function findFaces() {
  let count = 0;
  for (let e = 0; e < numberOfElements; ++e) count += data.kinds[kindOf[e]].faces.length;
  const corners = new Uint32Array(4 * count), owner = new Uint32Array(count),
        beyond = new Uint32Array(count).fill(NONE);
  // Two faces are one if their three smallest vertices are: elements conform.
  let slots = 1;
  while (slots < 2 * count) slots *= 2;
  const table = new Uint32Array(slots).fill(NONE), keys = new Uint32Array(3 * count),
        sorted = new Uint32Array(4);
  let f = 0;
  for (let e = 0; e < numberOfElements; ++e)
    for (const face of data.kinds[kindOf[e]].faces) {
      for (let i = 0; i < 4; ++i)
        corners[4 * f + i] = sorted[i] = i < face.length ? vertices[firstVertex[e] + face[i]] : NONE;
      sorted.sort();
      keys.set(sorted.subarray(0, 3), 3 * f);
      owner[f] = e;
      let slot =
        (Math.imul(sorted[0], 73856093) ^ Math.imul(sorted[1], 19349663) ^ Math.imul(sorted[2], 83492791));
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

const box = {
  min: [Infinity, Infinity, Infinity],
  max: [-Infinity, -Infinity, -Infinity]
};
for (let i = 0; i < points.length; ++i) {
  box.min[i % 3] = Math.min(box.min[i % 3], points[i]);
  box.max[i % 3] = Math.max(box.max[i % 3], points[i]);
}
const diagonal = Math.hypot(...box.max.map((x, c) => x - box.min[c])) || 1;

let largestDisplacement = 0;
for (const step of steps) {
  const u = step.displacements;
  step.lengths =
    new Float32Array(u.length / 3).map((_, v) => Math.hypot(u[3 * v], u[3 * v + 1], u[3 * v + 2]));
  largestDisplacement = step.lengths.reduce((a, b) => Math.max(a, b), largestDisplacement);
}

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
        for (let c = 0; c < 3; ++c) sum[c] += centroids[3 * e + c];
      }
    if (count > 0 && count < numberOfElements) return sum.map(x => x / count);
  }
  return box.min.map((x, c) => (x + box.max[c]) / 2);
}

const start = focus();
const state = {
  color: steps.length > 0     ? "displacement" :
    new Set(labelOf).size > 1 ? "label" :
                                "kind",
  step: steps.length,                                        // 0: as it was
  amount: 1,                                                 // times the displacement
  axis: 0,                                                   // of the cut; -1: none
  cut: [...start],                                           // for each axis
  side: start[0] >= (box.min[0] + box.max[0]) / 2 ? 1 : -1,  // the smaller part is taken away
  leastRatio: 1,
  hidden: new Set(),  // categories of the legend
  isPatient: true,
  hasEdges: true,
  hasPlaces: true,
  hasLost: true,
  picked: -1,
  place: -1
};
const unit = () => state.isPatient ? "\u00a0mm" : "";

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
  for (let c = 0; c < 3; ++c) target[at + c] = stops[k][c] + (x - k) * (stops[k + 1][c] - stops[k][c]);
}

const worstRatio = ratioOf.reduce((a, b) => Math.max(a, b), 1);
const topRatio = Math.min(Math.max(Math.ceil(10 * worstRatio) / 10, 1.5), 7);  // acceptable in the paper

const subdomainNames = new Map(data["subdomain names"]);
const labels = [...new Set(labelOf)].sort((a, b) => a - b);
const labelRow = new Map(labels.map((label, i) => [label, i]));
const nameOf = label => (subdomainNames.get(label) ?? "subdomain") + ` (${label})`;

// Modes of color. Those with categories have a row for each in the legend; the others a ramp.
const MODES = {
  kind: {
    name: "Kind",
    caption: "Kind of element",
    category: e => kindOf[e],
    rows: data.kinds.map((kind, k) => ({name: kind.plural, color: KIND_COLORS[k]}))
  },
  ratio: {
    name: "ARC",
    caption: "Aspect-ratio coefficient, 1 is ideal",
    colors: RATIO_COLORS,
    from: 1,
    to: topRatio
  },
  label: {
    name: "Label",
    caption: "Label",
    category: e => labelRow.get(labelOf[e]),
    rows: labels.map((label, i) => ({name: nameOf(label), color: LABEL_COLORS[i % LABEL_COLORS.length]}))
  },
  region: {
    name: "Region",
    caption: "Region of interest",
    category: e => isInRegion[e],
    rows: [{name: "outside", color: REGION_COLORS[0]}, {name: "meets the region", color: REGION_COLORS[1]}]
  },
  displacement:
    {name: "Shift", caption: "Displacement, mm", colors: SHIFT_COLORS, from: 0, to: largestDisplacement || 1}
};
if (steps.length === 0) delete MODES.displacement;
if (!isInRegion.includes(1) || !isInRegion.includes(0)) delete MODES.region;  // none, or everywhere
for (const mode of Object.values(MODES))
  if (mode.category) {
    for (const row of mode.rows) row.count = 0;
    for (let e = 0; e < numberOfElements; ++e) ++mode.rows[mode.category(e)].count;
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
  if (state.step === 0) return points;
  const u = steps[state.step - 1].displacements;
  return points.map((x, i) => x + state.amount * u[i]);
}
