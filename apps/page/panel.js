// SPDX-FileCopyrightText: 2026 The Mixed_mesh_3 authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places, settings, legend and report. Texts of the data become text nodes, never HTML.

// ---- places ----------------------------------------------------------------------------------------------

const relative = p => p.map((x, c) => x - center[c]);
const controlPoints =
  (report["control points"] ?? [])
    .map(c => [relative(c.position), relative(c.position.map((x, k) => x + c.displacement[k]))]);
const lostEdges = ofWhole(report.fitting)?.["sharp edges"]?.lost ?? [];
const places = findPlaces();

// What the report says of the whole mesh, unless the page has only a part of the mesh.
function ofWhole(measured) { return report.extracted ? undefined : measured; }

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
  const distances = ofWhole(report.surface)?.["Hausdorff distance"];
  if (distances) {
    const [d, what] = ["from mesh to surface", "from surface to mesh"]
                        .map(key => [distances[key], key])
                        .reduce((a, b) => a[0].distance >= b[0].distance ? a : b);
    const at = relative(d.at),
          isThere = p => p && Math.hypot(...p.map((x, c) => x - at[c])) < 1e-3 * diagonal;
    if (!result.some(place => isThere(place.at)))  // a warning tells it already
      result.push({kind: "note", at, length: d.distance, text: `Farthest ${what}`});
  }
  const shift = report["shift after resection"] ?? report.shift;
  const radius = report.parameters?.["radius of control points"].value;
  if (shift)
    result.push({
      kind: "note",
      at: relative(shift.at),
      length: shift["largest displacement"],
      text: "Largest displacement"
        + (radius > 0 ? ` (at control points, the mean within ${number(radius)} mm is prescribed)` : "")
    });
  const worst = ratioOf.indexOf(worstRatio);
  if (worst >= 0)
    result.push({
      kind: "note",
      element: worst,
      at: [...centroids.subarray(3 * worst, 3 * worst + 3)],
      text: `Largest aspect ratio: ${number(worstRatio)}, ${data.kinds[kindOf[worst]].name} ${worst}`
    });
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
  if (state.axis >= 0) state.cut[state.axis] = place.at[state.axis];
  if (place.element !== undefined) pick(place.element);
  controls.update();
  showSettings();
  askDraw();
}

function pick(e) {
  state.picked = e;
  askDraw();
  const card = $("picked");
  card.hidden = e < 0;
  if (e < 0) return;
  const at = [0, 1, 2].map(c => centroids[3 * e + c] + center[c]);
  const names = state.isPatient ? ["R", "A", "S"] : ["x", "y", "z"];
  const rows = [
    ["ARC", number(ratioOf[e])], ["Label", nameOf(labelOf[e])],
    ["Center", at.map((x, c) => `${names[c]} ${x.toFixed(1)}`).join(", ") + unit()]
  ];
  if (MODES.region) rows.push(["Region", isInRegion[e] ? "meets it" : "outside"]);
  if (state.step > 0) {
    const own = vertices.subarray(firstVertex[e], firstVertex[e + 1]), step = steps[state.step - 1];
    rows.push(["Shift", number(own.reduce((sum, v) => sum + step.lengths[v], 0) / own.length) + "\u00a0mm"]);
  }
  const close = make("button", {"aria-label": "Close", onclick: () => pick(-1)}, "\u00d7");
  card.replaceChildren(make("h3", {}, `${capital(data.kinds[kindOf[e]].name)} ${e}`), close, list(rows));
}

// ---- texts and elements of the page ----------------------------------------------------------------------

function number(x) {
  if (x === null || x === undefined || !Number.isFinite(x)) return x === Infinity ? "\u221e" : "\u2013";
  return Number(x.toPrecision(3)).toLocaleString("en", {maximumSignificantDigits: 3}).replace("-", "\u2212");
}
function count(n) { return n.toLocaleString("en"); }
function percent(x) {
  return x === undefined ? "\u2013" : (100 * x).toFixed(x > 0.9995 || x === 0 ? 0 : 1) + "\u00a0%";
}
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
  for (const [name, value] of rows) element.append(make("dt", {}, name), make("dd", {}, value));
  return element;
}

// A row of the settings: buttons of which one is pressed.
function choice(name, options, current, choose) {
  const buttons = make("div", {class: "choice", role: "group", "aria-label": name});
  for (const [value, text, title] of options)
    buttons.append(make(
      "button", {
        type: "button",
        "aria-pressed": value === current,
        "data-value": value,
        title: title ?? "",
        onclick: () => choose(value)
      },
      text));
  return make("div", {class: "row"}, make("span", {class: "name"}, name), buttons);
}

function slider(name, attributes, text, change) {
  const output = make("output", {}, text(attributes.value));
  const input = make("input", {
    type: "range",
    ...attributes,
    oninput: () => {
      change(Number(input.value));
      output.textContent = text(Number(input.value));
      askDraw();
    }
  });
  return make("label", {class: "row"}, make("span", {class: "name"}, name), input, output);
}

const AXES = () => state.isPatient ? [["Sagittal", "R", "L"], ["Coronal", "A", "P"], ["Axial", "S", "I"]] :
                                     [["x", "", ""], ["y", "", ""], ["z", "", ""]];

function cutText(x) {
  const [, plus, minus] = AXES()[state.axis], there = x + center[state.axis];
  if (!state.isPatient) return number(there);
  return `${plus && there >= 0 ? plus : minus} ${Math.abs(there).toFixed(1)}\u00a0mm`;
}

// What depends on the state is made anew, with the focus on what had it.
function showSettings() {
  const active = document.activeElement, section = active?.closest("#settings > div")?.id;
  const where = section && [...$(section).querySelectorAll("button, input")].indexOf(active);
  const set = changes => () => {
    Object.assign(state, changes);
    update();
  };
  if (steps.length > 0) {
    const names = ["Before", ...steps.map(step => capital(step.name))];
    const amount = slider(
      "Deformation", {id: "amount", min: 0, max: 3, step: 0.05, value: state.amount},
      x => "\u00d7 " + x.toFixed(2), x => {
        state.amount = x;
      });
    amount.querySelector("input").disabled = state.step === 0;
    $("steps").replaceChildren(
      choice("State", names.map((name, i) => [i, name]), state.step, i => set({step: i})()), amount);
  }
  $("colors").replaceChildren(
    choice("Color", Object.entries(MODES).map(([key, mode]) => [key, mode.name]), state.color, key => {
      state.hidden.clear();
      set({color: key})();
    }));
  const cut =
    choice("Cut", [[-1, "Off"], ...AXES().map(([name], c) => [c, name])], state.axis, c => set({axis: c})());
  $("cuts").replaceChildren(cut);
  if (state.axis >= 0) {
    const low = box.min[state.axis], high = box.max[state.axis];
    const row = slider(
      "Position", {id: "cut", min: low, max: high, step: (high - low) / 500, value: state.cut[state.axis]},
      cutText, x => {
        state.cut[state.axis] = x;
      });
    const flip = make(
      "div", {class: "row"}, make("span", {class: "name"}),
      make("button", {type: "button", id: "flip", onclick: set({side: -state.side})}, "Other side"));
    $("cuts").append(row, flip);
  }
  $("filter").replaceChildren(slider(
    "ARC from",
    {id: "least", min: 1, max: Math.min(worstRatio, topRatio), step: 0.01, value: state.leastRatio},
    x => x.toFixed(2), x => {
      state.leastRatio = x;
    }));
  const directions = state.isPatient ? "RLAPSI" : ["+x", "\u2212x", "+y", "\u2212y", "+z", "\u2212z"];
  $("views").replaceChildren(choice(
    "View from", [...[...directions].map((text, i) => [i, text]), [6, "\u27f2", "As at the start"]], null,
    i => lookFrom(DIRECTIONS[i])));
  const check = (key, text) => {
    const input = make("input", {
      type: "checkbox",
      id: key,
      onchange: () => {
        state[key] = input.checked;
        update();
      }
    });
    input.checked = state[key];
    return make("label", {}, input, text);
  };
  $("switches")
    .replaceChildren(
      check("hasEdges", "Edges"), check("hasPlaces", "Places"),
      ...(lostEdges.length > 0 ? [check("hasLost", "Lost sharp edges")] : []));
  if (!data["is in patient space"])
    $("switches")
      .append(
        check("isPatient", "Patient axes, mm"),
        make("p", {}, `${fileName(sourceFile)} does not say its unit or axes: mm and RAS are assumed.`));
  if (where >= 0) $(section).querySelectorAll("button, input")[where]?.focus();
}

const DIRECTIONS = [
  [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, -1e-4, 1], [0, 1e-4, -1], [1.0 * state.side, 0.75, 0.55]
];

function showLegend() {
  const mode = MODES[state.color], legend = $("legend");
  const caption = make("p", {class: "caption"}, mode.caption);
  if (mode.category) {
    const rows = make("div", {class: "rows"});
    mode.rows.forEach((row, i) => {
      if (row.count === 0) return;
      const toggle = () => {
        if (!state.hidden.delete(i)) state.hidden.add(i);
        update();
        legend.querySelectorAll("button")[index]?.focus();
      };
      const index = rows.childElementCount;
      rows.append(make(
        "button",
        {type: "button", "aria-pressed": !state.hidden.has(i), title: "Show or hide", onclick: toggle},
        make("span", {class: "swatch", style: `background: ${row.color}`}), make("span", {}, row.name),
        make("span", {}, count(row.count))));
    });
    legend.replaceChildren(caption, rows, ...arrowsExplained());
    return;
  }
  const ticks = [0, 1, 2, 3, 4].map(i => mode.from + i / 4 * (mode.to - mode.from));
  const isOpen = state.color === "ratio" && worstRatio > topRatio;
  legend.replaceChildren(
    caption,
    make("div", {class: "ramp", style: `background: linear-gradient(to right, ${mode.colors.join(", ")})`}),
    make(
      "div", {class: "ticks"},
      ...ticks.map((x, i) => make("span", {}, (isOpen && i === 4 ? "\u2265 " : "") + number(x)))),
    ...arrowsExplained());
}

function arrowsExplained() {
  if (controlPoints.length === 0 || !state.hasPlaces) return [];
  return [make("p", {class: "caption arrows"}, `measured at ${count(controlPoints.length)} control points`)];
}

function update() {
  showSettings();
  showLegend();
  showFacts();
  showSubdomains();
  askDraw();
}

// ---- the report ------------------------------------------------------------------------------------------

const sourceFile = report.inputs.surface?.file ?? report.inputs.mesh?.file ?? "";

function showFacts() {
  const mesh = report.extracted ?? report.mesh ?? report.inputs.mesh, fidelity = ofWhole(report.surface),
        shift = report["shift after resection"] ?? report.shift;
  const cubic = volume => state.isPatient ? `${number(volume / 1000)}\u00a0ml` : number(volume);
  const facts =
    [["vertices", count(mesh.vertices)], ["elements", count(mesh.elements)], ["volume", cubic(mesh.volume)]];
  if (fidelity)
    facts.push(
      ["at most from the surface", number(fidelity["Hausdorff distance"].distance) + unit()],
      ["of the surface\u2019s volume", percent(fidelity["ratio of volumes"])]);
  const completion = report.inputs.surface?.completion;
  if (completion) {
    const added = completion["voxels added by closing"] + completion["voxels filled in"];
    facts.push(["of its voxels added to the image", percent(added / completion.voxels)]);
  }
  if (shift)
    facts.push(
      ["largest shift", number(shift["largest displacement"]) + "\u00a0mm"],
      ["control points missed by up to", number(shift["control points missed by at most"]) + "\u00a0mm"]);
  if (report.resection)
    facts.push(["resected", number(report.resection["cavity volume"] / 1000) + "\u00a0ml"]);
  if (report.octree) facts.push(["largest ARC", number(worstRatio)]);
  while (facts.length % 3 !== 0) facts.push(["", ""]);
  $("facts").replaceChildren(
    ...facts.map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))));
  const lengths = $("places").querySelectorAll("[data-length]");
  lengths.forEach(span => {
    span.textContent = `: ${number(Number(span.dataset.length))}${unit()}`;
  });
}

// Subdomains of the page, with their volumes beside those of the surfaces or voxels that they come from.
function showSubdomains() {
  const told = (report.subdomains ?? []).filter(s => labelRow.has(s.index));
  $("subdomains").hidden = told.length === 0;
  const unitOfVolume = state.isPatient ? "ml" : "", inUnit = x => state.isPatient ? x / 1000 : x;
  const difference = s => s["ratio of volumes"] == null ?
    "\u2013" :
    (100 * (s["ratio of volumes"] - 1)).toFixed(1).replace("-", "\u2212").replace(/^(?=[1-9]|0.*[1-9])/, "+");
  const head = ["", "Elements", `Volume ${unitOfVolume}`, `Input ${unitOfVolume}`, "Difference, %"];
  $("subdomains")
    .querySelector("table")
    .replaceChildren(
      make("tr", {}, ...head.map(text => make("th", {scope: "col"}, text))),
      ...told.map(
        s => make(
          "tr", {},
          ...
            [nameOf(s.index), count(s.elements), number(inUnit(s.volume)),
             number(s["volume of surface"] == null ? undefined : inUnit(s["volume of surface"])),
             difference(s)]
              .map(text => make("td", {}, text)))));
}

// The paper's Table 1: what elements of each kind are like.
function showTable() {
  const rows = data.kinds.map((kind, k) => [capital(kind.plural), e => kindOf[e] === k]).reverse();
  rows.push(["All", () => true]);
  const head = make(
    "tr", {},
    ...["", "Number", "Mean", "Min", "Max", "\u2264 7, %", "1.3\u20137, %"].map(
      text => make("th", {scope: "col"}, text)));
  $("table").replaceChildren(head);
  for (const [name, belongs] of rows) {
    const values = ratioOf.filter((_, e) => belongs(e)), n = values.length;
    const mean = values.reduce((a, b) => a + b, 0) / n,
          share = (low, high) => values.filter(x => low <= x && x <= high).length / n;
    const cells = n === 0 ? Array(5).fill("\u2013") : [
      mean.toFixed(2), values.reduce((a, b) => Math.min(a, b)).toFixed(2),
      values.reduce((a, b) => Math.max(a, b)).toFixed(2),
      ...[share(0, 7), share(1.3, 7)].map(x => (100 * x).toFixed(x === 1 ? 0 : 1))
    ];
    $("table").append(make(
      "tr", {}, make("td", {}, name), make("td", {}, count(n)), ...cells.map(text => make("td", {}, text))));
  }
}

// Bins of a tenth, as in the report: the first has all below 1.1, the last all from 3 on.
function showHistogram() {
  const edges = Array.from({length: 20}, (_, i) => (i + 11) / 10), bins = Array(21).fill(0);
  for (const ratio of ratioOf) {
    const bin = edges.findIndex(edge => ratio < edge);
    ++bins[bin < 0 ? 20 : bin];
  }
  const before = ofWhole(report.quality)?.histograms.ARC.before;
  const share = (list, i) => list[i] / list.reduce((a, b) => a + b, 0);
  const top = Math.max(...bins.map((_, i) => Math.max(share(bins, i), before ? share(before, i) : 0)));
  const width = 360, height = 120, bar = width / 21, y = x => height * (1 - x / top);
  const picture = svg(
    "svg",
    {viewBox: `0 -4 ${width} ${height + 24}`, role: "img", "aria-label": "Histogram of the aspect ratio"});
  bins.forEach((n, i) => {
    const c = new Uint8Array(3);
    ramp(RATIO_COLORS, (0.05 + i / 10) / (topRatio - 1), c, 0);
    const range = i === 20 ? "3 and more" : `${(1 + i / 10).toFixed(1)} to ${(1.1 + i / 10).toFixed(1)}`;
    picture.append(svg(
      "rect", {
        x: i * bar + 1,
        width: bar - 2,
        y: y(share(bins, i)),
        height: height - y(share(bins, i)),
        fill: `rgb(${c.join()})`
      },
      svg("title", {}, `${range}: ${count(n)} elements, ${percent(share(bins, i))}`)));
  });
  if (before)
    picture.append(svg("path", {
      class: "before",
      d: "M0 " + height + before.map((_, i) => `V${y(share(before, i))}h${bar}`).join("") + "V" + height
    }));
  picture.append(svg("line", {x1: 0, x2: width, y1: height, y2: height}));
  for (const x of [1, 1.5, 2, 2.5, 3])
    picture.append(svg(
      "text", {x: Math.max((x - 1) * 10 * bar, 9), y: height + 16},
      (x === 3 ? "\u2265 " : "") + x.toFixed(1)));
  $("histogram")
    .replaceChildren(
      picture,
      make(
        "p", {},
        before ? "Share of elements; the line is before the boundary was fitted." : "Share of elements."));
}

function showPlaces() {
  $("places").hidden = places.length === 0;
  $("places").querySelector("ol").replaceChildren(...places.map((place, i) => {
    const text = make("span", {}, place.text);
    if (place.length !== undefined) text.append(make("span", {"data-length": place.length}));
    const item = make("li", {class: place.kind}, make("span", {"aria-hidden": "true"}, i + 1), text);
    if (place.at)
      item.append(make(
        "button", {type: "button", onclick: () => showPlace(i), "aria-label": `Show place ${i + 1}`},
        "Show"));
    return item;
  }));
}

function showChecks() {
  const checks = Object.entries({...report.checks, ...report["checks of fidelity"]});
  for (const [key, text] of [
         ["shift", "by the shift"], ["shift after resection", "by the shift after resection"]])
    if (report[key]) checks.push([`no element inverted ${text}`, report[key]["inverted elements"] === 0]);
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
      details.addEventListener("toggle", () => {
        if (details.childElementCount === 1) details.append(tree(x));
      });
      element.append(details);
    } else {
      element.append(
        make("dt", {}, key), make("dd", {}, Array.isArray(x) ? x.join(", ") : String(x ?? "\u2013")));
    }
  return element;
}

function showReport() {
  const name = fileName(sourceFile), program = report.program;
  document.title = `${name} \u2013 ${program.name}`;
  $("title").textContent = name;
  $("subtitle").textContent = program.name === "brain_shift" ?
    "Brain shift" :
    "Mixed-element mesh" + (report.status && `: ${report.status}`);
  canvas.setAttribute("aria-label", `The mesh of ${name} in 3D`);
  $("command").textContent = data.command;
  $("report").append(tree(report));
  $("credits").textContent =
    `${program.name} ${program.version}, CGAL ${program.CGAL}. Drawn with three.js (MIT license).`;
  showTable();
  showHistogram();
  showPlaces();
  showChecks();
  showFacts();
  showSubdomains();
}

// ---- start -----------------------------------------------------------------------------------------------

showReport();
$("main").hidden = false;
try {
  setUpScene();
} catch (error) {
  view.replaceChildren(
    make("p", {class: "error"}, "This browser cannot draw in 3D: WebGL is missing or switched off."));
  $("settings").hidden = true;  // those of the picture
  return;
}
listen();
update();
lookFrom(DIRECTIONS[6]);
draw();
resize();
document.documentElement.dataset.firstPicture = Math.round(performance.now());
window.mixedMeshPage = {
  state,
  update,
  frame,
  camera: () => camera,
  lost: () => lost.visible ? lost.geometry.attributes.position.count / 2 : 0
};  // for the console
