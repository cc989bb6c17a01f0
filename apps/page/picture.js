// SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh in 3D, what lies over it (directions, scale, places), mouse and keys. All is drawn anew when
// something changes, and nothing in between.

const $ = id => document.getElementById(id);
const view = $("view"), canvas = $("canvas"), overlay = $("overlay");
let renderer, camera, controls, surface, lines, outline, lost, drawnFaces, scene;

function setUpScene() {
  THREE.ColorManagement.enabled = false;  // colors are those of the legend
  renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  scene = new THREE.Scene();
  camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 8 * diagonal);  // so that the scale holds everywhere
  camera.up.set(0, 0, 1);
  scene.add(new THREE.AmbientLight(0xffffff, 0.68 * Math.PI), camera);
  const light = new THREE.DirectionalLight(0xffffff, 0.36 * Math.PI);
  light.position.set(0.1, 0.5, 1);
  camera.add(light, light.target);
  const surfaceMaterial = new THREE.MeshLambertMaterial({
    vertexColors: true,
    flatShading: true,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1
  });
  surface = new THREE.Mesh(new THREE.BufferGeometry(), surfaceMaterial);
  lines = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({color: 0x1a222b, transparent: true, opacity: 0.55}));
  outline = new THREE.LineSegments(
    new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0xd02070, depthTest: false}));
  outline.renderOrder = 1;
  lost = new THREE.LineSegments(  // seen through the mesh, as they are inside or outside of it
    new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0xe00000, depthTest: false}));
  lost.renderOrder = 1;
  setGeometry(lost, {position: pointsOfLost()});
  scene.add(surface, lines, outline, lost);
  controls = new THREE.OrbitControls(camera, canvas);
  controls.minZoom = 0.2;
  controls.maxZoom = 200;
  controls.addEventListener("change", askRender);
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
    const e = faces.owner[f], corners = faces.corners.subarray(4 * f, 4 * f + 4),
          size = corners[3] === NONE ? 3 : 4;
    if (mode.category)
      one.set(categoryColors[mode.category(e)]);
    else if (state.color === "ratio")
      ramp(mode.colors, (ratioOf[e] - mode.from) / (mode.to - mode.from), one, 0);
    for (let i = 0; i + 2 < size; ++i, ++t) {
      drawnFaces[t] = f;
      for (const [k, corner] of [0, i + 1, i + 2].entries()) {
        const v = corners[corner], at = 9 * t + 3 * k;
        for (let c = 0; c < 3; ++c) xyz[at + c] = where[3 * v + c];
        if (state.color === "displacement")
          ramp(mode.colors, step ? state.amount * step.lengths[v] / mode.to : 0, color, at);
        else
          color.set(one, at);
      }
    }
    for (let i = 0; i < size; ++i) {  // each edge once, as the face beyond has it the other way round
      const a = corners[i], b = corners[(i + 1) % size];
      if (a < b) ends.push(a, b);
    }
  }
  setGeometry(surface, {position: xyz, color});
  setGeometry(lines, {position: pointsOf(ends, where)});
  lines.visible = state.hasEdges;
  lost.visible = state.hasLost;
  drawPicked(where);
  $("shown").replaceChildren(
    `${count(numberShown)} of ${count(numberOfElements)}`, make("span", {}, " elements shown"));
  Object.assign($("shown").dataset, {elements: numberShown, faces: drawn.length});  // for tests
}

function pointsOf(list, where) {
  const xyz = new Float32Array(3 * list.length);
  for (let i = 0; i < list.length; ++i)
    for (let c = 0; c < 3; ++c) xyz[3 * i + c] = where[3 * list[i] + c];
  return xyz;
}

// The ends of the segments of sharp edges of the surface that no edges of the mesh follow.
function pointsOfLost() {
  const points = [];
  for (const part of lostEdges)
    for (let i = 0; i + 1 < part.length; ++i) points.push(...relative(part[i]), ...relative(part[i + 1]));
  return new Float32Array(points);
}

function drawPicked(where) {
  const e = state.picked, ends = [];
  if (e >= 0 && isShown[e])
    for (const face of data.kinds[kindOf[e]].faces)
      face.forEach(
        (v, i) =>
          ends.push(vertices[firstVertex[e] + v], vertices[firstVertex[e] + face[(i + 1) % face.length]]));
  setGeometry(outline, {position: pointsOf(ends, where)});
}

// Once a frame, however fast a slider or the mouse moves.
let isFrameAsked = false, isDrawAsked = false;

function askRender() {
  if (!isFrameAsked) requestAnimationFrame(frame);
  isFrameAsked = true;
}

function askDraw() {
  isDrawAsked = true;
  askRender();
}

function frame() {
  if (isDrawAsked) draw();
  isFrameAsked = isDrawAsked = false;
  render();
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
  askRender();
}

function resize() {
  const width = view.clientWidth, height = view.clientHeight;
  if (width === 0 || height === 0) return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  const half = 0.37 * diagonal / Math.min(1, width / height);  // a brain leaves some margin for the letters
  camera.left = -half * width / height;
  camera.right = half * width / height;
  camera.top = half;
  camera.bottom = -half;
  camera.updateProjectionMatrix();
  render();  // at once, as the canvas is empty now
}

// ---- on top of the picture: directions, scale, places ----------------------------------------------------

const svg = (name, attributes = {}, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

// The letters of a direction, the nearest axis first: AR, say.
function directionName(d) {
  const names =
    state.isPatient ? ["RL", "AP", "SI"] : [["+x", "\u2212x"], ["+y", "\u2212y"], ["+z", "\u2212z"]];
  return [0, 1, 2]
    .filter(c => Math.abs(d[c]) > 0.38)
    .sort((a, b) => Math.abs(d[b]) - Math.abs(d[a]))
    .map(c => names[c][d[c] > 0 ? 0 : 1])
    .join(state.isPatient ? "" : " ");
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
    letter(width - 26, height / 2, right), letter(26, height / 2, minus(right)), letter(width / 2, 20, up),
    letter(width / 2, height - 20, minus(up)),
    svg(
      "g", {class: "scale", "data-length": length},
      svg("path", {class: "bar", d: `M${x0} ${y0 - 5}v5h${pixels}v-5`}),
      svg("text", {x: x0 + pixels / 2, y: y0 - 14}, number(length) + unit()))
  ];
  if (state.hasPlaces) {
    const d = controlPoints.map(([from, to]) => arrow(onScreen(from), onScreen(to))).join("");
    parts.push(svg("path", {class: "control edge", d}), svg("path", {class: "control", d}));
    parts.push(...pinsOf(places.map(place => place.at && onScreen(place.at))));
  }
  overlay.replaceChildren(...parts);
}

// Badges of places: those that would overlap are one, which tells all of them, and shows the next at each
// click.
function pinsOf(positions) {
  const RADIUS = 9, groups = [];
  const order = positions.map((_, i) => i).filter(i => positions[i]);
  order.sort((i, j) => (j === state.place) - (i === state.place) || i - j);  // the current one keeps its own
  for (const i of order) {
    const [x, y] = positions[i];
    const group = groups.find(g => Math.hypot(g.x - x, g.y - y) <= 2 * RADIUS);
    if (group)
      group.members.push(i);
    else
      groups.push({x, y, members: [i]});
  }
  return groups.map(({x, y, members}) => {
    const isWarning = members.some(i => places[i].kind === "warning"), isCurrent = members[0] === state.place;
    const text = `${members[0] + 1}${members.length > 1 ? "+" : ""}`;
    const pin = svg(
      "g", {
        class: `pin ${isWarning ? "warning" : "note"}${isCurrent ? " current" : ""}`,
        transform: `translate(${x} ${y})`,
        "data-places": members.map(i => i + 1).join(" ")
      },
      svg("title", {}, members.map(i => `${i + 1}: ${places[i].text}`).join("\n")),
      svg("circle", {r: RADIUS}), svg("text", {class: text.length < 3 ? "" : "long"}, text));
    const next = [...members].sort((i, j) => i - j).find(i => i > state.place);
    pin.addEventListener("click", () => showPlace(next ?? Math.min(...members)));
    return pin;
  });
}

// A dot, a line, a head.
function arrow([x, y], [X, Y]) {
  const l = Math.hypot(X - x, Y - y), [u, v] = l > 0 ? [(X - x) / l, (Y - y) / l] : [0, 0],
        h = Math.min(7, l);
  const left = [X - h * u + h / 2 * v, Y - h * v - h / 2 * u],
        right = [X - h * u - h / 2 * v, Y - h * v + h / 2 * u];
  return `M${x - 3} ${y}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0ZM${x} ${y}L${X} ${Y}L${left}L${right}L${X} ${Y}`;
}

// ---- mouse and keys --------------------------------------------------------------------------------------

function listen() {
  let pressed = null;
  canvas.addEventListener("pointerdown", event => {
    pressed = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointerup", event => {
    if (
      !pressed || event.button !== 0
      || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4)
      return;
    const bounds = canvas.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera(
      new THREE.Vector2(
        2 * (event.clientX - bounds.left) / bounds.width - 1,
        1 - 2 * (event.clientY - bounds.top) / bounds.height),
      camera);
    const hit = ray.intersectObject(surface)[0];
    pick(hit ? faces.owner[drawnFaces[hit.faceIndex]] : -1);
  });
  const turn = (azimuth, height) => {
    const offset = camera.position.clone().sub(controls.target), r = offset.length();
    const longitude = Math.atan2(offset.y, offset.x) + azimuth;
    const latitude = Math.min(Math.max(Math.asin(offset.z / r) + height, -1.5707), 1.5707);
    camera.position
      .set(
        Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude),
        Math.sin(latitude))
      .multiplyScalar(r)
      .add(controls.target);
  };
  const zoom = factor => {
    camera.zoom = Math.min(Math.max(camera.zoom * factor, 0.2), 200);
    camera.updateProjectionMatrix();
  };
  const cut = share => {
    if (state.axis < 0) return;
    const low = box.min[state.axis], high = box.max[state.axis];
    state.cut[state.axis] = Math.min(Math.max(state.cut[state.axis] + share * (high - low), low), high);
    update();
  };
  const keys = {
    ArrowLeft: () => turn(-0.12, 0),
    ArrowRight: () => turn(0.12, 0),
    ArrowUp: () => turn(0, 0.12),
    ArrowDown: () => turn(0, -0.12),
    "+": () => zoom(1.2),
    "=": () => zoom(1.2),
    "-": () => zoom(1 / 1.2),
    "[": () => cut(-0.02),
    "]": () => cut(0.02),
    0: () => lookFrom(DIRECTIONS[6])
  };
  [..."rlapsi"].forEach((key, i) => {
    keys[key] = () => lookFrom(DIRECTIONS[i]);
  });
  canvas.addEventListener("keydown", event => {
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
    controls.update();
    askRender();
  });
  new ResizeObserver(resize).observe(view);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", askRender);
}
