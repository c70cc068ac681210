// The viewer in a real headless Chromium, driven as a person would: run.cjs CAIRN SCREENSHOTS
// Exit code 77 (skipped) only where there is no Chromium.
'use strict';
const assert = require('node:assert/strict');
const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const { browserPath, endAll, launch, serve: serveCairn, until } = require('./browser.cjs');

const [cairn, screenshots] = process.argv.slice(2).map((p) => path.resolve(p));
browserPath();

const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'cairn-e2e-'));
fs.mkdirSync(screenshots, { recursive: true });
let failures = 0;

const serve = (...subjects) => serveCairn(cairn, ...subjects);

function run(...words) {
  return execFileSync(cairn, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] });
}

/** Frames of a CSV export: rows of frame → body → numbers. */
function readCsv(file) {
  const [head, ...rows] = fs.readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(head.map((name, i) => [name, Number(row[i])])));
}

async function test(name, work) {
  const begin = Date.now();
  try {
    await work();
    console.log(`ok   ${name} (${Date.now() - begin} ms)`);
  } catch (error) {
    failures++;
    console.log(`FAIL ${name}: ${error.stack}`);
  }
}

const textOf = (page, selector) => page.locator(selector).innerText();
const shot = (page, name) => page.screenshot({ path: path.join(screenshots, `${name}.png`) });

async function open(browser, address, viewport = { width: 1280, height: 720 }) {
  const page = await browser.newPage({ viewport });
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') page.errors.push(message.text()); });
  // The smallest pictures: this is about what happens, on machines that have no graphics card.
  const url = new URL(address);
  url.searchParams.set('quality', 'lowest');
  await page.goto(url.href);
  return page;
}

/** Where a body is on the screen. */
const screenOf = (page, slot) => page.evaluate((i) => {
  const { stage } = window.cairn.app;
  const { position } = stage.panels[0].frame;
  const Vector = stage.controls.target.constructor;
  return stage.project(new Vector(position[3 * i], position[3 * i + 1], position[3 * i + 2]));
}, slot);
const stepsDone = (page, steps) => until(page, `window.cairn.live.state?.steps === ${steps} && window.cairn.live.state.hash !== null
  && window.cairn.app.stage.panels[0].frame?.step === ${steps}`);

async function live(browser) {
  const { address, child } = await serve('stacks5', '--paused', '--threads', '1');
  const page = await open(browser, address);
  await until(page, 'window.cairn.live?.frames > 0 && window.cairn.app.stage.panels[0].frame !== null');

  await test('the page opens with all bodies of the scene', async () => {
    await until(page, 'document.querySelector("#run-bodies")?.textContent === "277"');
    await shot(page, 'live-open');
  });

  await test('eight steps by the keyboard give the state of the library', async () => {
    await page.keyboard.press(',');
    await stepsDone(page, 8);
    const report = JSON.parse(run('run', 'stacks5', '--duration', String(1 / 30), '--threads', '1', '--json'));
    assert.equal(await textOf(page, '#run-hash'), report.state_hash);
    assert.equal(await textOf(page, '#run-steps'), '8');
  });

  await test('it plays in real time or says how far it is behind, and pauses', async () => {
    await page.click('#play');
    await until(page, 'window.cairn.live.state.playing && window.cairn.live.state.steps > 20');
    await until(page, 'window.cairn.live.samples.length > 2');
    assert.match(await textOf(page, '#status'), /real time/);
    await page.keyboard.press(' ');
    await until(page, '!window.cairn.live.state.playing');
  });

  await test('reset begins anew', async () => {
    await page.keyboard.press('r');
    await until(page, 'window.cairn.live.state.steps === 0');
  });

  await test('a thrown ball joins the world and flies', async () => {
    await page.click('#throw');
    await until(page, 'window.cairn.live.roster.bodies.size === 278');
    await until(page, 'window.cairn.app.stage.panels[0].frame?.epoch === window.cairn.live.roster.epoch');
    const place = () => page.evaluate(() => {
      const slot = [...window.cairn.live.roster.bodies.keys()].at(-1);
      return [...window.cairn.app.stage.panels[0].frame.position.slice(3 * slot, 3 * slot + 3)];
    });
    const before = await place();
    await page.evaluate(() => window.cairn.live.step(8));
    await stepsDone(page, 8);
    const after = await place();
    const way = Math.hypot(...after.map((x, k) => x - before[k]));
    assert.ok(Math.abs(way - 12 / 30) < 0.03, `at 12 m/s the ball went ${way} m in 1/30 s`);
    await shot(page, 'live-throw');
  });

  await test('a click selects a body and shows the library’s numbers', async () => {
    await page.keyboard.press('r');
    await until(page, 'window.cairn.live.state.steps === 0 && window.cairn.live.roster.bodies.size === 277');
    await page.evaluate(() => window.cairn.live.select(100));
    await until(page, 'document.querySelector("#body-state [data-key=mass]")?.textContent === "800 g"');
    assert.match(await textOf(page, '#body-state [data-key=shape]'), /10 × 10 × 10 cm/);
    assert.match(await textOf(page, '#body-contacts'), /contact/);
    await shot(page, 'live-select');
    await page.keyboard.press('Escape');
  });

  await test('a body dragged with the mouse follows it', async () => {
    await page.selectOption('#scene', 'tower:10');
    await until(page, 'window.cairn.live.state.scene.startsWith("tower") && window.cairn.app.stage.panels[0].frame?.epoch === window.cairn.live.roster.epoch');
    const slot = await page.evaluate(() => [...window.cairn.live.roster.bodies.keys()].at(-1));
    const begin = await screenOf(page, slot);
    const height = () => page.evaluate((i) => window.cairn.app.stage.panels[0].frame.position[3 * i + 2], slot);
    const from = await height();
    await page.evaluate(() => window.cairn.live.command({ do: 'play' }));
    await page.mouse.move(begin.x, begin.y);
    await page.mouse.down();
    await page.mouse.move(begin.x, begin.y - 40, { steps: 4 });
    await page.mouse.move(begin.x, begin.y - 90, { steps: 4 });
    await until(page, ([i, z]) => window.cairn.app.stage.panels[0].frame.position[3 * i + 2] > z, [slot, from + 0.03]);
    await shot(page, 'live-drag');
    await page.evaluate(() => window.cairn.live.command({ do: 'pause' }));
  });

  await page.mouse.up();
  await test('the dial changes the settings of the library', async () => {
    await page.click('#tab-settings');
    await page.click('#preset-accuracy');
    await until(page, 'window.cairn.live.state.settings.steps_per_second === 960 && window.cairn.live.state.dial === 1');
    assert.equal(await page.inputValue('#field-steps_per_second'), '960');
    await page.fill('#field-damping', '7');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.toast.error');
    assert.match(await textOf(page, '.toast.error'), /damping/);
    await shot(page, 'live-settings');
  });

  await test('layers bring their data', async () => {
    await page.click('#tab-view');
    for (const id of ['#layer-points', '#layer-normals', '#layer-bounds', '#layer-moves', '#colour-batch']) await page.click(id);
    await page.evaluate(() => window.cairn.live.step(4));
    await until(page, '(() => { const f = window.cairn.app.stage.panels[0].frame; return f?.contacts?.count > 0 && f.batch && f.bounds && f.moves; })()');
    await shot(page, 'live-layers');
    await page.click('#layer-rays');
    await until(page, 'window.cairn.app.stage.panels[0].frame?.rays?.length > 9');
    const [from, camera] = await page.evaluate(() => [[...window.cairn.app.stage.panels[0].frame.rays.slice(0, 3)],
      window.cairn.app.stage.camera.position.toArray()]);
    from.forEach((x, i) => assert.ok(Math.abs(x - camera[i]) < 1e-3, `${from} is not ${camera}`));
    await page.evaluate(() => window.cairn.app.stage.camera.position.add({ x: 1, y: 1, z: 2 }));
    await page.evaluate(() => { window.cairn.app.stage.controls.update(); window.cairn.app.stage.touch(); });
    await page.waitForTimeout(500);
    await shot(page, 'live-rays');
    await page.click('#layer-rays');
    await until(page, 'window.cairn.app.stage.panels[0].frame && !window.cairn.app.stage.panels[0].frame.rays');
    await page.click('#tab-charts');
    await page.waitForTimeout(500);
    await shot(page, 'live-charts');
  });

  await test('a scene file can be opened, a broken one is explained', async () => {
    const scene = { name: 'two balls', duration: 1, gravity: [0, 0, -10], materials: { oak: { density: 800 } },
      bodies: [0, 1].map((i) => ({ shape: { type: 'sphere', radius: 0.1 }, material: 'oak', position: [i, 0, 1] })) };
    await page.setInputFiles('#upload', { name: 'two.json', mimeType: 'application/json', buffer: Buffer.from(JSON.stringify(scene)) });
    await until(page, 'window.cairn.live.roster.bodies.size === 2');
    await page.setInputFiles('#upload', { name: 'bad.json', mimeType: 'application/json', buffer: Buffer.from('{"name": 7}') });
    await until(page, () => [...document.querySelectorAll('.toast.error')].some((t) => t.textContent.includes('bad.json')));
  });

  await test('every shape can be added, and joints are shown', async () => {
    await page.click('#tab-bodies');
    for (const shape of ['box', 'sphere', 'capsule', 'cylinder']) await page.click(`#add-${shape}`);
    await until(page, 'window.cairn.live.roster.bodies.size === 6');
    const shapes = await page.evaluate(() => [...window.cairn.live.roster.bodies.values()].slice(2).map((body) => body.shape.type));
    assert.deepEqual(shapes, ['box', 'sphere', 'capsule', 'cylinder']);
    await page.selectOption('#scene', 'cradle_swing:5:2');
    await until(page, 'window.cairn.live.state.scene.startsWith("cradle") && window.cairn.app.stage.panels[0].frame?.joints?.count === 5');
    await shot(page, 'live-joints');
  });

  await test('help, dark and a phone’s width', async () => {
    await page.keyboard.press('h');
    await page.waitForSelector('#help[open]');
    await shot(page, 'help');
    await page.keyboard.press('Escape');
    await page.keyboard.press('d');
    await page.setViewportSize({ width: 390, height: 800 });
    await page.waitForTimeout(400);
    await shot(page, 'phone');
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `the page is ${wide} pixels wide`);
  });

  await test('nothing went wrong on the page, and Ctrl-C ends the server', async () => {
    assert.deepEqual(page.errors, []);
    child.removeAllListeners('exit');
    const exit = new Promise((resolve) => child.once('exit', (code) => resolve(code)));
    child.kill('SIGINT');
    assert.equal(await exit, 0);
  });
  await page.close();
}

async function recordings(browser) {
  const first = path.join(scratch, 'performance.h5');
  const second = path.join(scratch, 'accuracy.h5');
  const csv = path.join(scratch, 'performance.csv');
  const html = path.join(scratch, 'performance.html');
  run('run', 'tower:5', '--duration', '1', '--threads', '1', '--record', first, '--quiet');
  run('run', 'tower:5', '--duration', '1', '--threads', '1', '--preset', 'accuracy', '--record', second, '--quiet');
  run('export', first, '--csv', csv);
  const rows = readCsv(csv);
  const shows = async (page, frame, body) => {
    const row = rows.find((r) => r.frame === frame && r.body === body);
    await page.evaluate((time) => { window.cairn.replay.setPlaying(false); window.cairn.replay.seek(time); window.cairn.replay.select(3); }, row.time);
    const position = (await page.locator('#body-state [data-key=position]').textContent()).replace(' m', '').split(', ').map(Number);
    [row.x, row.y, row.z].forEach((value, k) => assert.ok(Math.abs(value - position[k]) < 1.1e-4, `${position} is not ${row.x}, ${row.y}, ${row.z}`));
  };

  await test('two recordings play side by side in step', async () => {
    const { address, child } = await serve(first, second);
    const page = await open(browser, address);
    await until(page, 'window.cairn.replay?.clips.length === 2');
    await until(page, 'window.cairn.replay.time > 0.1');
    await page.keyboard.press(' ');
    await shows(page, 20, 3);
    const times = await page.evaluate(() => window.cairn.app.stage.panels.map((panel) => panel.frame.time));
    assert.equal(times[0], times[1]);
    await page.waitForTimeout(400);
    await shot(page, 'replay-two');
    assert.deepEqual(page.errors, []);
    child.removeAllListeners('exit');
    child.kill('SIGINT');
    await page.close();
  });

  await test('an exported page plays offline with the numbers of the recording', async () => {
    run('export', first, '--html', html);
    const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(`file://${html}?quality=lowest`);
    await until(page, 'window.cairn.replay?.clips.length === 1');
    await shows(page, 30, 3);
    await page.locator('#scrub').fill('0.5');
    await until(page, 'Math.abs(window.cairn.replay.time - 0.5) < 1e-6');
    await page.waitForTimeout(400);
    await shot(page, 'export-html');
    assert.deepEqual(errors, []);
    await context.close();
  });

  await test('a picture without a display', async () => {
    const png = path.join(screenshots, 'export.png');
    run('export', first, '--png', png, '--size', '320', '180', '--time', '0.5');
    const bytes = fs.readFileSync(png);
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    assert.equal(bytes.readUInt32BE(16), 320);
    assert.equal(bytes.readUInt32BE(20), 180);
  });

  await test('a film without a display', async () => {
    let ffmpeg = true;
    try { execFileSync('ffmpeg', ['-version'], { stdio: 'ignore' }); } catch { ffmpeg = false; }
    if (!ffmpeg) {
      console.log('skipped: there is no ffmpeg; install the package ffmpeg to make films');
      return;
    }
    const mp4 = path.join(screenshots, 'export.mp4');
    run('export', first, '--mp4', mp4, '--size', '160', '90', '--speed', '2');
    assert.equal(fs.readFileSync(mp4).subarray(4, 8).toString(), 'ftyp');
  });
}

(async () => {
  const browser = await launch();
  try {
    await live(browser);
    await recordings(browser);
  } finally {
    await browser.close();
    endAll();
    fs.rmSync(scratch, { recursive: true, force: true });
  }
  console.log(`${failures} failures; pictures are in ${screenshots}`);
  process.exit(failures === 0 ? 0 : 1);
})().catch((error) => {
  console.error(error);
  endAll();
  process.exit(1);
});
