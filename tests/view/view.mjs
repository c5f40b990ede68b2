// `rtr view` in Chromium: node tests/view/view.mjs RTR WORK [SCENE SHOT.png]
//
// Looks at `room.rts` as a user does, and fails at the first thing that is not as it should be. With SCENE and SHOT.png
// it only makes the picture for docs/guide.md. Playwright is found through NODE_PATH.

import { spawn } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { createRequire } from "node:module";
import { connect, createServer } from "node:net";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const [rtr, work, scene, shot] = process.argv.slice(2);
const room = readFileSync(join(dirname(fileURLToPath(import.meta.url)), "room.rts"), "utf8");
const LIMIT = 60_000; // for one wait, on a busy machine

function check(is, what) {
  if (!is) throw new Error(`not so: ${what}`);
  console.log(`ok: ${what}`);
}

// Starts `rtr view`, and gives its process and the URL that it prints.
function serve(args) {
  const child = spawn(rtr, ["view", "--port", "0", "--no-browser", ...args], { cwd: work, stdio: ["ignore", "pipe", "inherit"] });
  const url = new Promise((done, fail) => {
    let text = "";
    child.stdout.on("data", (data) => {
      text += data;
      if (text.includes("\n")) done(text.split("\n")[0]);
    });
    child.on("exit", (code) => fail(new Error(`rtr view has ended with ${code}`)));
  });
  return { child, url };
}

async function stop(child) {
  child.removeAllListeners("exit");
  if (child.exitCode !== null) return;
  const ended = new Promise((done) => child.on("exit", done));
  child.kill("SIGINT");
  await ended;
}

async function open(browser, url, height = 760) {
  const page = await browser.newPage({ viewport: { width: 1280, height } });
  page.on("pageerror", (error) => console.log(`page: ${error}`));
  page.on("console", (line) => line.type() === "error" && console.log(`page: ${line.text()}`));
  const answer = await page.goto(url);
  check(answer.status() === 200, "the page is served");
  return page;
}

const inPage = (page, text, arg) => page.evaluate(text, arg);
const until = (page, text, arg) => page.waitForFunction(text, arg, { timeout: LIMIT, polling: 20 });
const done = (page) => until(page, () => state && state.phase === "done" && film && film.id === state.shot.id);

// Mean of all channels of the picture on the screen, 0 to 255.
const mean = (page) =>
  inPage(page, () => {
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let sum = 0;
    for (let i = 0; i < data.length; i++) if (i % 4 < 3) sum += data[i];
    return sum / (0.75 * data.length);
  });

async function clickPixel(page, x, y) {
  const [left, top] = await inPage(page, ([x, y]) => {
    const box = stage.getBoundingClientRect();
    return [box.left + place.x + (x + 0.5) * place.zoom, box.top + place.y + (y + 0.5) * place.zoom];
  }, [x, y]);
  await page.mouse.click(left, top);
}

// Of more samples than any machine renders while somebody looks: the picture must not be done before the page is there.
async function grows(browser) {
  const { child, url } = serve(["room.rts", "--spp", "1000000"]);
  try {
    const page = await open(browser, await url);
    await until(page, () => film && film.width === 320 && film.samples > 0);
    const first = await inPage(page, () => film.samples);
    await until(page, (first) => film.samples > first, first);
    check((await mean(page)) > 10, "a picture appears, and its samples rise");
    await page.close();
  } finally {
    await stop(child);
  }
}

async function ends(page) {
  await done(page);
  check((await page.textContent("#samples")) === "64 / 64", "it comes to its end");
}

async function looks(page) {
  const [id, before] = [await inPage(page, () => film.id), await mean(page)];
  await page.keyboard.press("]");
  await page.keyboard.press("]");
  const brighter = await mean(page);
  await page.selectOption("#curve", "1");
  const mapped = await mean(page);
  check(brighter > before + 5 && mapped < brighter - 5, "exposure and tone map change the pixels");
  await page.click("#as-scene");
  check(Math.abs((await mean(page)) - before) < 0.01 && (await inPage(page, () => film.id)) === id, "and nothing was rendered for it");
}

async function picks(page) {
  const line = (text) => room.split("\n").findIndex((line) => line.startsWith(text)) + 1;
  await clickPixel(page, 222, 95);
  await until(page, () => document.getElementById("pick").textContent.includes("pillar"));
  const said = await page.textContent("#pick");
  for (const [what, start] of [["pillar", "instance pillar"], ["post", "object post"], ["blue", "material blue"]]) {
    check(said.includes(`${what}room.rts:${line(start)}`), `a click says ${what} and its line`);
  }
}

const layerOf = (page, name) => until(page, (name) => layer.name === name && isLayerShown() && layer.epoch === state.epoch, name);
// What the layer holds of a pixel, and its colour on the screen.
const valuesAt = (page, x, y) => inPage(page, ([x, y]) => [...layer.values.slice(layer.channels * (y * layer.width + x)).slice(0, layer.channels)], [x, y]);
const colourAt = (page, x, y) => inPage(page, ([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3), [x, y]);
const surfaceAt = (page, x, y) => inPage(page, async ([x, y]) => (await (await fetch(`pick?x=${x}&y=${y}`)).json()).surface, [x, y]);
const near = (a, b, by) => a.length === b.length && a.every((x, i) => Math.abs(x - b[i]) <= by);

async function layers(page) {
  const [id, picture] = [await inPage(page, () => film.id), await colourAt(page, 222, 95)];
  const surface = await surfaceAt(page, 222, 95);
  await page.selectOption("#layer", "albedo");
  await layerOf(page, "albedo");
  check(near(await colourAt(page, 222, 95), [0x35, 0x61, 0x8f], 1), "the albedo of the pillar is its colour in the scene");
  await clickPixel(page, 222, 95);
  await until(page, () => document.getElementById("pick").textContent.includes("albedo0.03"));
  check((await page.textContent("#pick")).includes("pillar"), "a click tells its numbers");
  await page.selectOption("#layer", "normal");
  await layerOf(page, "normal");
  check(near(await valuesAt(page, 222, 95), surface.normal, 1e-3), "the normal is that of the surface");
  await page.selectOption("#layer", "depth");
  await layerOf(page, "depth");
  check(near(await valuesAt(page, 222, 95), [surface.depth], 0.02 * surface.depth), "the depth is where it is");
  const [close, far] = [await colourAt(page, 222, 95), await colourAt(page, 300, 60)];
  check(close[0] > far[0] + 20 && /m to .* m/.test(await page.textContent("#legend")), "near is brighter than far, and the legend says how far");
  await page.selectOption("#layer", "alpha");
  await layerOf(page, "alpha");
  check((await valuesAt(page, 160, 2))[0] === 0 && (await valuesAt(page, 222, 95))[0] === 1, "alpha tells the sky from the scene");
  for (const name of ["instance", "material", "object"]) {
    await page.selectOption("#layer", name);
    await layerOf(page, name);
    const [pillar, ground] = [await colourAt(page, 222, 95), await colourAt(page, 160, 170)];
    check(!near(pillar, ground, 30), `each ${name} has a colour of its own`);
  }
  for (const name of ["position", "uv"]) {
    await page.selectOption("#layer", name);
    await layerOf(page, name);
  }
  check((await inPage(page, () => film.id)) === id, "and nothing was rendered for all that");
  await page.selectOption("#layer", "depth");
  await layerOf(page, "depth");
  await page.focus("#stage");
  await page.keyboard.press("ArrowLeft");
  await until(page, () => String(state.view.from) !== String(state.own_view.from));
  await layerOf(page, "depth");
  const moved = await surfaceAt(page, 160, 100);
  check(near(await valuesAt(page, 160, 100), [moved.depth], 0.02 * moved.depth), "a layer follows the camera");
  await page.keyboard.press("r");
  await until(page, () => String(state.view.from) === String(state.own_view.from));
  await page.keyboard.press("l");
  check((await page.inputValue("#layer")) === "position", "L shows the next layer");
  await page.selectOption("#layer", "picture");
  await done(page);
  check(near(await colourAt(page, 222, 95), picture, 0), "the picture comes back as it was");
}

async function errors(page) {
  await page.selectOption("#layer", "error");
  await until(page, () => layer.name === "error" && isLayerShown() && layer.samples === 64);
  const [rms, told] = await inPage(page, () => {
    const { values } = layer;
    return [Math.sqrt(values.reduce((sum, x) => sum + x * x, 0) / values.length), state.error];
  });
  check(Math.abs(rms / told - 1) < 1e-3, "the errors of the pixels are the error of the picture");
  check((await page.textContent("#legend")).includes("relative standard error"), "the legend says what it is");
  check(!near(await colourAt(page, 160, 2), await colourAt(page, 200, 150), 10), "a sky without noise is darker than a penumbra");
  await page.selectOption("#layer", "picture");
}

async function converges(page) {
  const curve = await inPage(page, () => state.curve);
  const last = curve[curve.length - 1];
  check(curve.length > 2 && last.samples === 64 && last.error < curve[0].error / 2, "the error falls with the samples");
  // Pixels of the curve's own colour, and where the last one is.
  const ink = () =>
    inPage(page, () => {
      const sheet = document.getElementById("plot");
      const { data } = sheet.getContext("2d").getImageData(0, 0, sheet.width, sheet.height);
      let [n, right, sum] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 250 || Math.abs(data[i] - 0x7f) + Math.abs(data[i + 1] - 0xb2) + Math.abs(data[i + 2] - 0xe5) > 6) continue;
        [n, right, sum] = [n + 1, Math.max(right, (i / 4) % sheet.width), sum + i];
      }
      return { n, right, sum };
    });
  const overSamples = await ink();
  check(overSamples.n > 200 && overSamples.right > 300, "and the plot draws it");
  await page.click("#over-time");
  check((await ink()).sum !== overSamples.sum && (await page.getAttribute("#over-time", "aria-pressed")) === "true", "over time it is another curve");
  await page.click("#over-samples");
  check((await ink()).sum === overSamples.sum, "and back");
}

async function focuses(page) {
  const surface = await surfaceAt(page, 160, 172);
  const [id, own, before] = await inPage(page, () => [film.id, state.own_view.focus, context.getImageData(0, 0, canvas.width, canvas.height).data.slice()]);
  check(surface.depth < own - 0.5, "the ground in front is not where the camera focuses");
  await page.focus("#stage");
  await page.keyboard.press("f");
  check((await page.getAttribute("#focus", "aria-pressed")) === "true", "F waits for a click");
  await clickPixel(page, 160, 172);
  await until(page, (depth) => Math.abs(state.view.focus - depth) < 1e-6, surface.depth);
  check(true, "a click focuses the camera there");
  await until(page, (id) => film.id !== id, id);
  await inPage(page, () => (movedAt = -Infinity));
  await done(page);
  const changed = await inPage(page, (before) => {
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((x, i) => Math.abs(x - before[i]) > 2).length;
  }, before);
  check(changed > 100, `and the picture is another one (${changed} values)`);
  const [text, said] = [await inPage(page, () => state.text), await page.textContent("#camera")];
  check(text.includes("aperture = 20mm\n  focus = ") && /sharp at/.test(said), "the text of the camera says so");
  await page.keyboard.press("r");
  await until(page, (own) => state.view.focus === own, own);
  await done(page);
}

// What ssh -L does: a port of its own, whose bytes are passed on.
function tunnel(url) {
  const far = new URL(url);
  const server = createServer((near) => {
    const ahead = connect(Number(far.port), far.hostname);
    for (const end of [near, ahead]) end.on("error", () => (near.destroy(), ahead.destroy()));
    near.pipe(ahead).pipe(near);
  });
  return new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
}

async function tunnels(browser, url) {
  const server = await tunnel(url);
  const { port } = server.address();
  const there = (name) => `http://${name}:${port}${new URL(url).pathname}`;
  const page = await open(browser, there("localhost"));
  await until(page, () => film && state.view);
  const from = await inPage(page, () => String(state.view.from));
  await page.focus("#stage");
  await page.keyboard.press("ArrowRight");
  await until(page, (from) => String(state.view.from) !== from, from);
  await page.keyboard.press("r");
  await until(page, () => String(state.view.from) === String(state.own_view.from));
  check(true, "through a tunnel at another port the page shows and steers");
  // A name of somebody else's name server for this machine: it knows the secret, and gets nothing all the same.
  await page.goto(there("evil.example"));
  check((await page.textContent("body")).trim() === "forbidden", "under a foreign name there is nothing");
  const status = await new Promise((done) => {
    const headers = { host: `localhost:${port}`, origin: "http://evil.example" };
    request(there("127.0.0.1") + "stop", { method: "POST", headers }, (answer) => (answer.resume(), done(answer.statusCode))).end("true");
  });
  check(status === 403, "a page of somebody else steers nothing");
  await page.close();
  server.close();
}

async function moves(page) {
  const id = await inPage(page, () => film.id);
  const began = Date.now();
  await page.keyboard.press("ArrowLeft");
  await until(page, (id) => film.id !== id, id);
  console.log(`first picture after a move: ${Date.now() - began} ms`);
  const box = await page.locator("#stage").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= 10; i++) await page.mouse.move(x + 12 * i, y - 3 * i);
  await page.mouse.up();
  await until(page, () => !sending && state.view.from.every((c, i) => Math.abs(c - view.from[i]) < 1e-3));
  await inPage(page, () => (movedAt = -Infinity));
  await done(page);
  const [from, own] = await inPage(page, () => [state.view.from, state.own_view.from]);
  check(Math.hypot(...from.map((c, i) => c - own[i])) > 1, "a drag turns the camera");
  await page.keyboard.press("c");
  await page.waitForSelector("#hint:not([hidden])");
  const text = await inPage(page, () => state.text);
  check(/^camera eye: perspective \{\n {2}from = \(.*\)m\n/.test(text), "the camera is told as text");
  return text;
}

async function edits(page, camera) {
  const file = join(work, "room.rts");
  const [from, epoch] = await inPage(page, () => [String(state.view.from), state.epoch]);
  const before = await mean(page);
  writeFileSync(file, room.replace("material = clay", "material = clai"));
  await page.waitForSelector("#message:not([hidden])", { timeout: LIMIT });
  const said = await page.textContent("#text");
  check(said.includes("no material named `clai`") && said.includes("room.rts:12"), "what is wrong is shown over the picture");
  check((await mean(page)) === before, "which stays");
  writeFileSync(file, room.replace("linear(0.25)", "linear(1.5)"));
  await page.waitForSelector("#message", { state: "hidden", timeout: LIMIT });
  // The message goes when the scene is compiled; the pack is read after that.
  await until(page, (epoch) => state.epoch !== epoch, epoch);
  await done(page);
  check((await mean(page)) > before + 10, "an edit is rendered");
  check((await inPage(page, () => String(state.view.from))) === from, "from the same place");
  // The camera that was copied shows the same picture as the view that it was copied from.
  const seen = await mean(page);
  const pasted = room.replace("linear(0.25)", "linear(1.5)").replace(/^camera eye.*$/m, camera);
  writeFileSync(file, pasted);
  await until(page, (from) => state.own_view && Math.abs(state.own_view.from[0] - Number(from.split(",")[0])) < 1e-3, from);
  await page.keyboard.press("r");
  await until(page, () => String(state.view.from) === String(state.own_view.from));
  await done(page);
  check(Math.abs((await mean(page)) - seen) < 0.5, "the copied camera is the same camera");
}

async function survives(browser, page, url) {
  const samples = await inPage(page, () => film.samples);
  await page.close();
  const again = await open(browser, url);
  await until(again, (samples) => film && film.samples >= samples, samples);
  check(true, "closing the page loses nothing");
  return again;
}

// The picture for the guide.
async function picture(browser, url) {
  const page = await open(browser, url, 960);
  await done(page);
  const [w, h] = await inPage(page, () => state.size);
  await clickPixel(page, Math.round(0.5 * w), Math.round(0.62 * h));
  await until(page, () => marked !== null);
  await page.screenshot({ path: shot });
}

mkdirSync(work, { recursive: true });
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP evil.example 127.0.0.1"],
});
let served = null;
try {
  if (shot) {
    copyFileSync(scene, join(work, basename(scene)));
    served = serve([basename(scene), "--size", process.env.SIZE || "640x360", "--spp", process.env.SPP || "64"]);
    await picture(browser, await served.url);
  } else {
    writeFileSync(join(work, "room.rts"), room);
    await grows(browser);
    served = serve(["room.rts"]);
    const url = await served.url;
    const wrong = await browser.newPage();
    const answer = await wrong.goto(new URL("/0123456789abcdef0123456789abcdef/", url).href);
    check(answer.status() === 403 && (await wrong.textContent("body")).trim() === "forbidden", "a wrong secret gets nothing");
    await wrong.close();
    let page = await open(browser, url);
    await ends(page);
    await looks(page);
    await picks(page);
    await layers(page);
    await errors(page);
    await converges(page);
    await focuses(page);
    await tunnels(browser, url);
    const camera = await moves(page);
    await edits(page, camera);
    page = await survives(browser, page, url);
    await page.screenshot({ path: join(work, "room.png") });
  }
} finally {
  if (served) await stop(served.child);
  await browser.close();
}
