// The page's colours as people with normal vision, protanopia, deuteranopia and tritanopia see them: palette.cjs SOURCES
// Vision is simulated by the matrices of Machado, Oliveira and Fernandes (2009, doi:10.1109/TVCG.2009.113), severity 1.0,
// in linear RGB; distances are those of CIELAB (1976, D65), in which 2.3 is just noticeable.
'use strict';
const assert = require('node:assert/strict');
const path = require('node:path');

/** of any two colours that mean different things */
const leastDistance = 19;
/** of a colour from what it is drawn on */
const leastFromBack = 14;
/** of neighbours among the seven colours of the scale for quantities */
const leastStep = 9;

const visions = {
  normal: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900],
};

const toXyz = [0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920, 0.9503041];
const white = [0.95047, 1, 1.08883];

const times = (m, v) => [0, 3, 6].map((row) => m[row] * v[0] + m[row + 1] * v[1] + m[row + 2] * v[2]);

function linear(hex) {
  return [1, 3, 5].map((at) => {
    const part = parseInt(hex.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
}

/** L*, a*, b* of a colour as somebody sees it. */
function seen(hex, vision) {
  const rgb = times(visions[vision], linear(hex)).map((part) => Math.min(1, Math.max(0, part)));
  const [x, y, z] = times(toXyz, rgb).map((part, k) => {
    const t = part / white[k];
    return t > 216 / 24389 ? Math.cbrt(t) : ((24389 / 27) * t + 16) / 116;
  });
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function distance(a, b, vision) {
  const [p, q] = [seen(a, vision), seen(b, vision)];
  return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/** Compares pairs of colours in every vision. */
function hold(name, pairs, limit) {
  let least = Infinity;
  for (const vision of Object.keys(visions)) {
    for (const [a, b] of pairs) {
      const between = distance(a, b, vision);
      least = Math.min(least, between);
      assert.ok(between >= limit, `${name}: ${a} and ${b} are ${between.toFixed(1)} apart with ${vision}, ${limit} is the least`);
    }
  }
  console.log(`${name}: ${least.toFixed(1)}`);
}

const pairsOf = (colours) => colours.flatMap((a, i) => colours.slice(0, i).map((b) => [a, b]));
const neighboursOf = (colours) => colours.slice(1).map((colour, i) => [colours[i], colour]);
const across = (colours, backs) => colours.flatMap((a) => backs.map((b) => [a, b]));

function loadPalette(sources) {
  const { outputFiles } = require('esbuild').buildSync({
    entryPoints: [path.join(sources, 'view', 'palette.ts')], bundle: true, format: 'cjs', platform: 'node', write: false,
    nodePaths: [process.env.NODE_PATH],
  });
  const loaded = { exports: {} };
  new Function('module', 'exports', outputFiles[0].text)(loaded, loaded.exports);
  return loaded.exports;
}

const p = loadPalette(path.resolve(process.argv[2]));

// A measure that cannot tell a known bad pair from a good one would pass everything.
assert.ok(distance('#c0504d', '#7f8a2e', 'normal') > 60 && distance('#c0504d', '#7f8a2e', 'deuteranopia') < leastDistance);

hold('batches, levels and shock stages', pairsOf([...p.qualitativeHex, p.noneHex, p.fixedHex]), leastDistance);
hold('asleep, awake and fixed', pairsOf([p.awakeHex, p.asleepHex, p.fixedHex]), leastDistance);
hold('painted materials', pairsOf(p.paintHex), leastDistance);
hold('stages of the time step', pairsOf(p.stageHex), leastDistance);
hold('lines of a chart', pairsOf(p.seriesHex), leastDistance);
hold('overlays', pairsOf(Object.values(p.overlayHex)), leastDistance);
const chartBacks = ['#ffffff', '#1b1f24'];
hold('charts on light and dark', across([...p.seriesHex, ...p.stageHex], chartBacks), leastFromBack);
const grounds = ['#e3e6e9', '#565d66', '#14171b'];
hold('overlays on the ground, light and dark', across(Object.values(p.overlayHex), grounds), leastFromBack);
hold('neighbours in speed and overlap', neighboursOf(p.sequentialHex), leastStep);
for (const vision of Object.keys(visions)) {
  const lightness = p.sequentialHex.map((colour) => seen(colour, vision)[0]);
  assert.ok(lightness.every((l, i) => i === 0 || l > lightness[i - 1] + 3), `speed and overlap do not grow lighter with ${vision}: ${lightness}`);
}
