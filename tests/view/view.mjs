// `rtr view` in Chromium: node tests/view/view.mjs RTR WORK [SCENE SHOT.png]
//
// Looks at `room.rts` as a user does, and fails at the first thing that is not as it should be. With SCENE and SHOT.png
// it only makes the picture for docs/guide.md. Playwright is found through NODE_PATH.

import { spawn } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const [rtr, work, scene, shot] = process.argv.slice(2);
const room = readFileSync(join(dirname(fileURLToPath(import.meta.url)), "room.rts"), "utf8");
const LIMIT = 60_000; // for one wait, on a busy machine

function check(is, what) {
  if (!is) throw new Error(what);
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

async function open(browser, url) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
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

async function grows(page) {
  await until(page, () => film && film.samples > 0);
  const first = await inPage(page, () => film.samples);
  await until(page, (first) => film.samples > first && film.width === 320, first);
  check((await mean(page)) > 10, "a picture appears, and its samples rise");
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
  const from = await inPage(page, () => String(state.view.from));
  const before = await mean(page);
  writeFileSync(file, room.replace("material = clay", "material = clai"));
  await page.waitForSelector("#message:not([hidden])", { timeout: LIMIT });
  const said = await page.textContent("#text");
  check(said.includes("no material named `clai`") && said.includes("room.rts:12"), "what is wrong is shown over the picture");
  check((await mean(page)) === before, "which stays");
  writeFileSync(file, room.replace("linear(0.25)", "linear(1.5)"));
  await page.waitForSelector("#message", { state: "hidden", timeout: LIMIT });
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
  const page = await open(browser, url);
  await done(page);
  const [w, h] = await inPage(page, () => state.size);
  await clickPixel(page, Math.round(0.5 * w), Math.round(0.62 * h));
  await until(page, () => marked !== null);
  await page.screenshot({ path: shot });
}

mkdirSync(work, { recursive: true });
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu"],
});
let served = null;
try {
  if (shot) {
    copyFileSync(scene, join(work, basename(scene)));
    served = serve([basename(scene), "--size", process.env.SIZE || "640x360", "--spp", process.env.SPP || "64"]);
    await picture(browser, await served.url);
  } else {
    writeFileSync(join(work, "room.rts"), room);
    served = serve(["room.rts"]);
    const url = await served.url;
    const wrong = await browser.newPage();
    const answer = await wrong.goto(new URL("/0123456789abcdef0123456789abcdef/", url).href);
    check(answer.status() === 403 && (await wrong.textContent("body")).trim() === "forbidden", "a wrong secret gets nothing");
    await wrong.close();
    let page = await open(browser, url);
    await grows(page);
    await looks(page);
    await picks(page);
    const camera = await moves(page);
    await edits(page, camera);
    page = await survives(browser, page, url);
    await page.screenshot({ path: join(work, "room.png") });
  }
} finally {
  served?.child.removeAllListeners("exit");
  served?.child.kill("SIGINT");
  await browser.close();
}
