// The page of `rtr view`. The server sends its state as events and the picture as 16-bit floats; exposure, tone map,
// zoom and shift are done here, without rendering again. Places are metres in the world, as in scene texts.
"use strict";

const $ = (id) => document.getElementById(id);
const [stage, canvas] = [$("stage"), $("picture")];
const context = canvas.getContext("2d");

let state = null; // what the server said last
let film = null; // { width, height, samples, id, half: Uint16Array }
let view = null; // the camera, ahead of the server while it is moved
let look = { exposure: 0, curve: 0, own: true }; // `own`: as the scene says
let place = { zoom: 1, x: 0, y: 0, fitted: true }; // of the picture on the stage, CSS pixels for each image pixel
let marked = null; // the pixel that was picked
let focusing = false;

// ---- Numbers

const digits = (x, n) => Number(x.toPrecision(n)).toString();
const rate = (x) => (x >= 1e6 ? `${(x / 1e6).toFixed(2)} M/s` : x > 0 ? `${Math.round(x / 1e3)} k/s` : "–");
const percent = (x) => (x == null ? "–" : `${(100 * x).toPrecision(2)} %`);
function time(s) {
  if (s == null) return "–";
  if (s < 60) return `${s.toFixed(s < 10 ? 1 : 0)} s`;
  return s < 3600 ? `${Math.floor(s / 60)} min` : `${Math.floor(s / 3600)} h ${Math.floor((s / 60) % 60)} min`;
}

// ---- Film to screen: every channel goes through one table of all 16-bit floats

const linear = new Float32Array(65536);
for (let bits = 0; bits < 65536; bits++) {
  const [exponent, fraction] = [(bits >> 10) & 31, bits & 1023];
  const size = exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : (2 ** -14 * fraction) / 1024;
  linear[bits] = bits & 0x8000 ? 0 : exponent === 31 ? 65504 : size;
}
const CURVES = [
  (x) => x,
  (x) => x / (1 + x),
  (x) => (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), // Narkowicz 2015
];
const srgb = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const table = new Uint8ClampedArray(65536);

function fillTable() {
  const [gain, curve] = [2 ** look.exposure, CURVES[look.curve] || CURVES[0]];
  for (let bits = 0; bits < 65536; bits++) table[bits] = 255 * srgb(Math.min(curve(linear[bits] * gain), 1));
}

function draw() {
  if (!film || drawLayer()) return;
  const { width, height, half } = film;
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const image = context.createImageData(width, height);
  const pixels = image.data;
  for (let i = 0, j = 0; i < half.length; i += 3, j += 4) {
    pixels[j] = table[half[i]];
    pixels[j + 1] = table[half[i + 1]];
    pixels[j + 2] = table[half[i + 2]];
    pixels[j + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  arrange();
}

// ---- Where the picture is on the stage

const size = () => (state && state.size) || [canvas.width, canvas.height];

function fit() {
  const [w, h] = size();
  const zoom = Math.min((stage.clientWidth - 32) / w, (stage.clientHeight - 32) / h, 4);
  place = { zoom, x: (stage.clientWidth - w * zoom) / 2, y: (stage.clientHeight - h * zoom) / 2, fitted: true };
  arrange();
}

function zoomBy(factor, x = stage.clientWidth / 2, y = stage.clientHeight / 2) {
  const zoom = Math.min(Math.max(place.zoom * factor, 0.02), 64);
  const scale = zoom / place.zoom;
  place = { zoom, x: x - (x - place.x) * scale, y: y - (y - place.y) * scale, fitted: false };
  arrange();
}

function shiftBy(x, y) {
  place = { ...place, x: place.x + x, y: place.y + y, fitted: false };
  arrange();
}

function arrange() {
  const [w, h] = size();
  // A coarse picture is stretched to the whole size.
  const [sx, sy] = [(w * place.zoom) / canvas.width, (h * place.zoom) / canvas.height];
  canvas.style.transform = `translate(${place.x}px, ${place.y}px) scale(${sx}, ${sy})`;
  canvas.classList.toggle("sharp", canvas.width === w && place.zoom >= 3);
  $("mark").hidden = !marked;
  if (marked) {
    $("mark").style.left = `${place.x + (marked[0] + 0.5) * place.zoom}px`;
    $("mark").style.top = `${place.y + (marked[1] + 0.5) * place.zoom}px`;
  }
}

function pixelAt(event) {
  const box = stage.getBoundingClientRect();
  const [x, y] = [event.clientX - box.left, event.clientY - box.top];
  const pixel = [Math.floor((x - place.x) / place.zoom), Math.floor((y - place.y) / place.zoom)];
  const [w, h] = size();
  return pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < w && pixel[1] < h ? pixel : null;
}

// ---- Talking to the server

let fetching = false;
async function fetchFilm() {
  if (fetching) return;
  fetching = true;
  try {
    while (state && state.shot && (!film || film.id !== state.shot.id % 2 ** 32)) {
      const answer = await fetch("film");
      if (answer.status !== 200) break;
      const bytes = await answer.arrayBuffer();
      const [width, height, samples, id] = new Uint32Array(bytes, 0, 4);
      film = { width, height, samples, id, half: new Uint16Array(bytes, 16) };
      draw();
    }
  } catch {
    // The events say when the server is back.
  }
  fetching = false;
}

const post = (path, value) => fetch(path, { method: "POST", body: JSON.stringify(value) }).catch(() => null);

// One camera is on its way at a time; the newest goes next.
let [sending, unsent] = [false, false];
async function sendCamera() {
  unsent = true;
  if (sending) return;
  sending = true;
  while (unsent) {
    unsent = false;
    await post("camera", view);
  }
  sending = false;
}

function connect() {
  const events = new EventSource("events");
  events.onmessage = (event) => hear(JSON.parse(event.data));
  events.onerror = () => {
    $("phase").textContent = "no connection";
    $("phase").className = "lost";
  };
}

function hear(news) {
  const before = state;
  state = news;
  // Events of a camera that is still being moved are old.
  if (!sending && news.view && performance.now() - movedAt > 500) view = { ...news.view };
  if (look.own) Object.assign(look, { exposure: news.exposure, curve: news.tone_map });
  const other = !before || before.scene !== news.scene || String(before.size) !== String(news.size);
  if (!before || look.own) showLook();
  if (other) fit();
  show();
  fetchFilm();
  fetchLayer();
}

// ---- What the state looks like

function show() {
  const name = state.scene || "no scene yet";
  $("scene").textContent = name;
  document.title = `${name} – rtr view`;
  $("phase").textContent = state.phase;
  $("phase").className = state.phase;
  $("samples").textContent = state.shot ? `${state.shot.samples} / ${state.spp}` : "–";
  $("error").textContent = percent(state.error);
  $("rays").textContent = rate(state.rays_per_second);
  $("left").textContent = state.phase === "rendering" ? time(state.seconds_left) : "–";
  $("stop").textContent = state.phase === "stopped" ? "Go on" : "Stop";
  $("stop").disabled = state.phase === "done" || state.phase === "loading";
  drawPlot(state.curve);
  $("message").hidden = !state.message;
  $("text").textContent = state.message || "";
  $("message").firstElementChild.textContent = state.shot ? "Something is wrong; this is the last good picture" : "Something is wrong";
  showCamera();
}

function rows(list, pairs) {
  list.replaceChildren();
  for (const [name, value, where] of pairs) {
    const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
    dt.textContent = name;
    dd.textContent = value;
    if (where) {
      const span = document.createElement("span");
      span.className = "place";
      span.textContent = where;
      dd.append(span);
    }
    list.append(dt, dd);
  }
}

// What is this small beside the rest is rounding.
const vector = (v) => v.map((x) => digits(Math.abs(x) < 1e-6 * Math.hypot(...v) ? 0 : x, 4)).join(", ");

function showCamera() {
  if (!view) return;
  const lens = view.aperture > 0 ? `${digits(1e3 * view.aperture, 3)} mm, sharp at ${digits(view.focus, 4)} m` : "pinhole";
  const width = 2 * Math.tan((view.fov * Math.PI) / 360) * Math.hypot(...sub(view.to, view.from));
  const seen = {
    perspective: [["field of view", `${digits(view.fov, 4)}°`], ["lens", lens]],
    orthographic: [["width", `${digits(width, 4)} m`]],
    panoramic: [],
  };
  rows($("camera"), [
    ["type", state.camera],
    ["from", vector(view.from)],
    ["to", vector(view.to)],
    ...(seen[state.camera] || []),
  ]);
}

function showLook() {
  $("exposure").value = look.exposure;
  $("stops").textContent = `${look.exposure >= 0 ? "+" : "−"}${Math.abs(look.exposure).toFixed(1)} EV`;
  $("curve").value = look.curve;
  fillTable();
  draw();
}

function setLook(change) {
  Object.assign(look, change, { own: false });
  look.exposure = Math.min(Math.max(look.exposure, -8), 8);
  showLook();
}

let hinting = 0;
function hint(text) {
  clearTimeout(hinting);
  $("hint").textContent = text;
  $("hint").hidden = false;
  hinting = setTimeout(() => ($("hint").hidden = true), 2000);
}

// ---- What is seen

async function pick(pixel) {
  const answer = await fetch(`pick?x=${pixel[0]}&y=${pixel[1]}`).catch(() => null);
  if (!answer || !answer.ok) return null;
  const found = await answer.json();
  marked = pixel;
  arrange();
  const s = found.surface;
  const named = (label, d) => (d ? [[label, d.name, d.file ? `${d.file}:${d.line}` : ""]] : []);
  const facts = s
    ? [
        ...named("instance", s.instance),
        ...named("light", s.light),
        ...named("object", s.object),
        ...named("shape", s.shape),
        ...named("asset", s.asset),
        ...(s.asset ? [["part", s.part || "all of it"]] : []),
        ...named("material", s.material),
        ["position", `${vector(s.position)} m`],
        ["distance", `${digits(s.distance, 5)} m`],
        ["normal", vector(s.normal)],
        ["side", s.front ? "front" : "back"],
      ]
    : [["", "the sky"]];
  picked = facts;
  showPick();
  return s;
}

let picked = [];
function showPick() {
  if (marked) rows($("pick"), [["pixel", marked.join(", ")], ...layerAt(marked), ...picked]);
}

async function click(pixel) {
  if (!pixel) return;
  const surface = await pick(pixel);
  if (!focusing) return;
  setFocusing(false);
  if (!surface || !view) return;
  if (state.camera !== "perspective") {
    hint(`${digits(surface.depth, 4)} m away; of this camera everything is sharp`);
    return;
  }
  if (!(view.aperture > 0)) {
    hint(`${digits(surface.depth, 4)} m away; a pinhole has no focus: give the camera an aperture`);
    return;
  }
  view.focus = surface.depth;
  moved();
}

function setFocusing(on) {
  focusing = on;
  stage.classList.toggle("focusing", on);
  $("focus").setAttribute("aria-pressed", on);
  if (on) hint("click what should be sharp");
}

// ---- The camera

const sub = (a, b) => a.map((x, i) => x - b[i]);
const add = (a, b, k = 1) => a.map((x, i) => x + k * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

let movedAt = -Infinity;
function moved() {
  movedAt = performance.now();
  marked = null;
  arrange();
  showCamera();
  sendCamera();
}

// Turns the camera about what it looks at: radians to the right, and up.
function turn(right, up) {
  if (!view) return;
  const axis = unit(view.up);
  const arm = sub(view.from, view.to);
  const length = Math.hypot(...arm);
  const height = Math.asin(Math.min(Math.max(dot(arm, axis) / length, -1), 1));
  const flat = add(arm, axis, -dot(arm, axis));
  if (!(Math.hypot(...flat) > 0)) return;
  const [x, z] = [unit(flat), unit(cross(axis, flat))];
  const limit = Math.PI / 2 - 0.01;
  const raised = Math.min(Math.max(height + up, -limit), limit);
  const around = add(x.map((c) => c * Math.cos(right)), z, Math.sin(right));
  const next = add(around.map((c) => c * Math.cos(raised)), axis, Math.sin(raised));
  view.from = add(view.to, next, length);
  moved();
}

// Moves nearer to what it looks at, or away; what is sharp stays as it is in the picture.
function dolly(factor) {
  if (!view) return;
  view.from = add(view.to, sub(view.from, view.to), factor);
  view.focus *= factor;
  moved();
}

// Moves the camera and what it looks at, in units of their distance.
function slide(right, up) {
  if (!view) return;
  const forward = sub(view.to, view.from);
  const length = Math.hypot(...forward);
  const x = unit(cross(forward, view.up));
  const y = unit(cross(x, forward));
  const step = add(x.map((c) => c * right * length), y, up * length);
  [view.from, view.to] = [add(view.from, step), add(view.to, step)];
  moved();
}

function home() {
  if (!state || !state.own_view) return;
  view = { ...state.own_view };
  marked = null;
  movedAt = -Infinity;
  arrange();
  showCamera();
  post("camera", null);
}

const isTold = () => !sending && state && JSON.stringify(flat(state.view)) === JSON.stringify(flat(view));
const flat = (v) => v && [v.from, v.to, v.up, v.fov, v.focus, v.aperture];

async function copyCamera() {
  // The text is the server's, which may not have told yet what was sent last.
  for (let i = 0; i < 50 && !isTold(); i++) await new Promise((done) => setTimeout(done, 20));
  const text = state && state.text;
  if (!text) return;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Pages that are not from this machine may not use the clipboard directly.
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  hint("copied: paste it over the camera of the scene text");
}

function save() {
  canvas.toBlob((blob) => {
    if (!blob) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    const name = ((state && state.scene) || "view").replace(/^.*[\\/]/, "").replace(/\.pack$/, "");
    const what = isLayerShown() ? layer.name : `${film ? film.samples : 0}spp`;
    link.download = `${name}-${what}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}

const stop = () => state && post("stop", state.phase !== "stopped");

// ---- Mouse and keys

let drag = null;
stage.addEventListener("pointerdown", (event) => {
  if (event.target.closest("#message") || event.button > 2) return;
  stage.setPointerCapture(event.pointerId);
  const shifts = event.shiftKey || event.button !== 0;
  drag = { x: event.clientX, y: event.clientY, far: 0, shifts, button: event.button };
});
stage.addEventListener("pointermove", (event) => {
  if (!drag) return;
  const [x, y] = [event.clientX - drag.x, event.clientY - drag.y];
  drag.far += Math.abs(x) + Math.abs(y);
  if (drag.far < 4) return;
  [drag.x, drag.y] = [event.clientX, event.clientY];
  stage.classList.add("turning");
  if (drag.shifts) shiftBy(x, y);
  else turn(-x / 200, y / 200);
});
stage.addEventListener("pointerup", (event) => {
  stage.classList.remove("turning");
  if (drag && drag.far < 4 && drag.button === 0) click(pixelAt(event));
  drag = null;
});
stage.addEventListener("pointercancel", () => (drag = null));
stage.addEventListener("contextmenu", (event) => event.preventDefault());
stage.addEventListener("wheel", (event) => {
  if (event.target.closest("#message")) return;
  event.preventDefault();
  const box = stage.getBoundingClientRect();
  const step = Math.max(-1, Math.min(1, event.deltaY / 100));
  if (event.ctrlKey || event.altKey) dolly(1.15 ** step);
  else zoomBy(1.2 ** -step, event.clientX - box.left, event.clientY - box.top);
}, { passive: false });

const KEYS = {
  ArrowLeft: (e) => (e.shiftKey ? shiftBy(-30, 0) : turn(-0.1, 0)),
  ArrowRight: (e) => (e.shiftKey ? shiftBy(30, 0) : turn(0.1, 0)),
  ArrowUp: (e) => (e.shiftKey ? shiftBy(0, -30) : turn(0, 0.1)),
  ArrowDown: (e) => (e.shiftKey ? shiftBy(0, 30) : turn(0, -0.1)),
  w: () => dolly(1 / 1.15), s: () => dolly(1.15),
  a: () => slide(-0.05, 0), d: () => slide(0.05, 0), q: () => slide(0, -0.05), e: () => slide(0, 0.05),
  "+": () => zoomBy(1.25), "=": () => zoomBy(1.25), "-": () => zoomBy(0.8),
  0: fit, 1: () => zoomBy(1 / place.zoom),
  "[": () => setLook({ exposure: look.exposure - 0.25 }), "]": () => setLook({ exposure: look.exposure + 0.25 }),
  t: () => setLook({ curve: (look.curve + 1) % 3 }),
  l: (e) => nextLayer(e.shiftKey ? -1 : 1),
  f: () => setFocusing(!focusing), c: copyCamera, r: home, p: save, " ": stop,
  Escape: () => setFocusing(false),
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|BUTTON|SUMMARY|TEXTAREA)$/.test(event.target.tagName)) return;
  const act = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!act) return;
  event.preventDefault();
  act(event);
});

$("exposure").addEventListener("input", () => setLook({ exposure: Number($("exposure").value) }));
$("curve").addEventListener("change", () => setLook({ curve: Number($("curve").value) }));
$("layer").addEventListener("change", () => setLayer($("layer").value));
$("as-scene").addEventListener("click", () => {
  look.own = true;
  if (state) Object.assign(look, { exposure: state.exposure, curve: state.tone_map });
  showLook();
});
for (const [id, act] of [["fit", fit], ["whole", KEYS[1]], ["focus", KEYS.f], ["copy", copyCamera], ["home", home], ["save", save], ["stop", stop], ["over-samples", () => plotOver("samples")], ["over-time", () => plotOver("seconds")]]) {
  $(id).addEventListener("click", () => act());
}
new ResizeObserver(() => place.fitted && fit()).observe(stage);

fillTable();
connect();
