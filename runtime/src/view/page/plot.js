// The error of the picture against its samples or its time, both axes logarithmic. Used by view.js.
"use strict";

let plot = { curve: [], over: "samples" };

function plotOver(over) {
  plot.over = over;
  for (const [id, name] of [["over-samples", "samples"], ["over-time", "seconds"]]) {
    document.getElementById(id).setAttribute("aria-pressed", name === over);
  }
  drawPlot(plot.curve);
}

// Whole powers of ten around numbers, at least one decade.
function decades(numbers) {
  const logs = numbers.map(Math.log10);
  const [from, to] = [Math.floor(Math.min(...logs) + 1e-9), Math.ceil(Math.max(...logs) - 1e-9)];
  return [from, Math.max(to, from + 1)];
}

const power = (n) => (n >= 0 ? String(10 ** n) : (10 ** n).toFixed(-n));
const asPercent = (n) => `${n >= -2 ? 10 ** (n + 2) : (10 ** (n + 2)).toFixed(-n - 2)} %`;

function drawPlot(curve) {
  plot.curve = curve;
  const sheet = document.getElementById("plot");
  const pen = sheet.getContext("2d");
  const style = getComputedStyle(document.documentElement);
  const ink = (name) => style.getPropertyValue(name);
  const [left, right, top, bottom] = [92, sheet.width - 14, 14, sheet.height - 40];
  pen.clearRect(0, 0, sheet.width, sheet.height);
  pen.font = "22px system-ui, sans-serif";
  const points = curve.map((point) => [point[plot.over], point.error]).filter(([x, y]) => x > 0 && y > 0);
  if (points.length === 0) {
    pen.fillStyle = ink("--quiet");
    pen.textAlign = "center";
    pen.fillText("a point after four samples", sheet.width / 2, sheet.height / 2);
    return;
  }
  const [across, up] = [decades(points.map(([x]) => x)), decades(points.map(([, y]) => y))];
  const at = ([x, y]) => [
    left + ((right - left) * (Math.log10(x) - across[0])) / (across[1] - across[0]),
    bottom - ((bottom - top) * (Math.log10(y) - up[0])) / (up[1] - up[0]),
  ];
  const line = (ends, colour, width, dashes) => {
    pen.beginPath();
    ends.map(at).forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    [pen.strokeStyle, pen.lineWidth] = [colour, width];
    pen.setLineDash(dashes);
    pen.stroke();
  };
  pen.fillStyle = ink("--quiet");
  for (let n = across[0]; n <= across[1]; n++) {
    line([[10 ** n, 10 ** up[0]], [10 ** n, 10 ** up[1]]], ink("--line"), 1, []);
    pen.textAlign = n === across[1] ? "right" : "center";
    pen.fillText(n === across[1] ? `${power(n)} ${plot.over === "samples" ? "spp" : "s"}` : power(n), Math.min(at([10 ** n, 1])[0], sheet.width - 4), sheet.height - 10);
  }
  for (let n = up[0]; n <= up[1]; n++) {
    line([[10 ** across[0], 10 ** n], [10 ** across[1], 10 ** n]], ink("--line"), 1, []);
    pen.textAlign = "right";
    pen.fillText(asPercent(n), left - 8, Math.max(at([1, 10 ** n])[1] + 8, 22));
  }
  // As independent samples make it fall: a quarter of the error for sixteen times the samples.
  const [x, y] = points[0];
  const far = Math.min(10 ** across[1], x * (y / 10 ** up[0]) ** 2);
  line([[x, y], [far, y * Math.sqrt(x / far)]], ink("--quiet"), 2, [6, 6]);
  line(points, ink("--accent"), 4, []);
  pen.fillStyle = ink("--accent");
  const [px, py] = at(points[points.length - 1]);
  pen.beginPath();
  pen.arc(px, py, 6, 0, 2 * Math.PI);
  pen.fill();
}
