// What the page can show instead of the picture: layers and the error of every pixel, from numbers to colours. Nothing
// is rendered for it; the server makes a layer of a few samples when it is asked for. Used by view.js.
"use strict";

// Of the picture with number `epoch`; without `values` while there is none.
let layer = { name: "picture", epoch: null, samples: 0, width: 0, height: 0, channels: 0, values: null };

const isLayerShown = () => layer.name !== "picture" && layer.values !== null;

function setLayer(name) {
  layer = { name, epoch: null, samples: 0, values: null };
  document.getElementById("layer").value = name;
  legend(name === "picture" ? null : "waiting for it …");
  draw();
  showPick();
  fetchLayer();
}

function nextLayer(step) {
  const options = [...document.getElementById("layer").options].map((option) => option.value);
  setLayer(options[(options.indexOf(layer.name) + step + options.length) % options.length]);
}

// ---- From the server

// Whether what is shown is of an older picture: another camera or scene, or fewer samples where that matters.
function isLayerOld() {
  if (!state || !state.scene || layer.name === "picture") return false;
  if (layer.epoch === null || layer.epoch < state.epoch) return true;
  return layer.name === "error" && state.error_samples !== null && layer.samples !== state.error_samples;
}

let fetchingLayer = false;
async function fetchLayer() {
  if (layer.values && layer.epoch < state.epoch) {
    // What another camera sees is no layer of this picture.
    layer.values = null;
    draw();
  }
  if (fetchingLayer || !isLayerOld()) return;
  if (layer.name === "error" && state.error_samples === null) {
    legend("the error of a pixel needs a sample in each of the picture's four parts");
    return;
  }
  fetchingLayer = true;
  const { name } = layer;
  const answer = await fetch(`layer?name=${name}`).catch(() => null);
  const bytes = answer && answer.status === 200 ? await answer.arrayBuffer().catch(() => null) : null;
  fetchingLayer = false;
  if (name !== layer.name) return fetchLayer();
  if (bytes) {
    const [width, height, channels, epoch, samples] = new Uint32Array(bytes, 0, 5);
    layer = { name, epoch, samples, width, height, channels, values: new Float32Array(bytes, 20) };
    draw();
    showPick();
    if (isLayerOld()) fetchLayer();
  } else if (answer && answer.status !== 409) {
    // The next event may bring what it needs.
    legend((await answer.text()).trim());
  } else if (answer) {
    fetchLayer();
  }
}

// ---- Numbers to colours, 0 to 255

const NOTHING = [0, 0, 0];
const grey = (x) => [255 * x, 255 * x, 255 * x];
const shown = (x) => 255 * srgb(Math.min(Math.max(x, 0), 1));

// Black, violet, orange, white for 0 to 1: brighter is more, also without colours.
function heat(x) {
  const t = Math.min(Math.max(x, 0), 1);
  return [255 * Math.min(1, 1.6 * t), 255 * Math.max(0, 1.7 * t - 0.7), 255 * Math.max(0.9 * Math.sin(Math.PI * Math.min(1, 1.7 * t)), 4 * t - 3)];
}

// Numbers that follow each other get colours that differ: hues a golden angle apart.
function ofNumber(n) {
  if (n === 0) return NOTHING;
  const hue = (n * 0.61803398875) % 1;
  return [0, 1 / 3, 2 / 3].map((third) => 70 + 170 * Math.min(1, Math.max(0, Math.abs(((hue + third) % 1) * 6 - 3) - 1)));
}

// Where all but one in fifty of the numbers lie, on either side.
function range(values, channels, channel) {
  const step = channels * Math.max(1, Math.floor(values.length / channels / 20000));
  const some = [];
  for (let i = channel; i < values.length; i += step) if (!Number.isNaN(values[i])) some.push(values[i]);
  some.sort((a, b) => a - b);
  const at = (share) => some[Math.round(share * (some.length - 1))];
  return some.length ? [at(0.02), at(0.98)] : [0, 1];
}

const within = (x, [from, to]) => Math.min(Math.max(to > from ? (x - from) / (to - from) : 0.5, 0), 1);
const ERRORS = [-3, 0]; // powers of ten

// A function from the numbers of a pixel to its colour, and what the legend says.
function colouring({ name, values, channels }) {
  const metres = ([from, to]) => `${digits(from, 3)} m to ${digits(to, 3)} m`;
  switch (name) {
    case "error":
      return [([x]) => heat(within(Math.log10(Math.max(x, 1e-9)), ERRORS)), "relative standard error of a pixel, 0.1 % to 100 %", heat];
    case "albedo":
      return [(rgb) => rgb.map(shown), "albedo of the first surface that is no mirror"];
    case "normal":
      return [(n) => (Math.hypot(...n) > 0 ? n.map((x) => 127.5 + 127.5 * x) : NOTHING), "normal: x red, y green, z blue"];
    case "depth": {
      const ends = range(values, 1, 0);
      return [([x]) => grey(0.05 + 0.95 * (1 - within(x, ends))), `along the view, white to black: ${metres(ends)}`];
    }
    case "position": {
      const ends = [0, 1, 2].map((axis) => range(values, 3, axis));
      return [(p) => p.map((x, axis) => 255 * within(x, ends[axis])), ends.map((e, axis) => `${"xyz"[axis]} ${metres(e)}`).join(", ")];
    }
    case "uv":
      return [([u, v]) => [255 * (u - Math.floor(u)), 255 * (v - Math.floor(v)), 0], "u red, v green"];
    case "alpha":
      return [([x]) => grey(x), "share of the samples that see the scene"];
    default:
      return [([n]) => ofNumber(n), `a colour for each ${name}`];
  }
}

// Draws the layer; false where the picture is to be drawn.
function drawLayer() {
  if (!isLayerShown()) return false;
  const { width, height, channels, values } = layer;
  const [colour, said, bar] = colouring(layer);
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const image = context.createImageData(width, height);
  const of = new Array(channels);
  for (let i = 0, j = 0; i < values.length; i += channels, j += 4) {
    for (let k = 0; k < channels; k++) of[k] = values[i + k];
    const rgb = Number.isNaN(of[0]) ? NOTHING : colour(of);
    [image.data[j], image.data[j + 1], image.data[j + 2], image.data[j + 3]] = [rgb[0], rgb[1], rgb[2], 255];
  }
  context.putImageData(image, 0, 0);
  legend(said, bar);
  arrange();
  return true;
}

function legend(text, bar) {
  const place = document.getElementById("legend");
  place.hidden = text === null;
  place.replaceChildren(text || "");
  if (!bar) return;
  const strip = document.createElement("canvas");
  [strip.className, strip.width, strip.height] = ["bar", 256, 1];
  const pixels = strip.getContext("2d");
  const image = pixels.createImageData(256, 1);
  for (let i = 0; i < 256; i++) image.data.set([...bar(i / 255), 255], 4 * i);
  pixels.putImageData(image, 0, 0);
  place.prepend(strip);
}

// What the layer says of a pixel, as rows of a table.
function layerAt([x, y]) {
  if (!isLayerShown() || x >= layer.width || y >= layer.height) return [];
  const at = layer.channels * (y * layer.width + x);
  const numbers = [...layer.values.slice(at, at + layer.channels)];
  const text = numbers.map((n) => (layer.name === "error" ? percent(n) : digits(n, 5))).join(", ");
  return [[layer.name, Number.isNaN(numbers[0]) ? "nothing" : text]];
}
