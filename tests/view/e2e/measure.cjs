// How fast the viewer is without a graphics card: measure.cjs CAIRN [SCENE...]
// Nothing is asserted: the figures depend on what else the machine does.
'use strict';
const path = require('node:path');
const { endAll, launch, serve, until } = require('./browser.cjs');

const cairn = path.resolve(process.argv[2]);
const scenes = process.argv.length > 3 ? process.argv.slice(3) : ['stacks5', 'cage2816'];
const trials = 9;

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/** Pictures drawn in so many milliseconds while the scene plays. */
const countPictures = (page, duration) => page.evaluate((ms) => new Promise((resolve) => {
  const { stage } = window.cairn.app;
  const begin = performance.now();
  const first = stage.pictures;
  const tick = () => {
    const passed = performance.now() - begin;
    if (passed < ms) requestAnimationFrame(tick);
    else resolve({ perSecond: (1000 * (stage.pictures - first)) / passed, quality: stage.currentQuality, realTime: window.cairn.live.state.realTime });
  };
  requestAnimationFrame(tick);
}), duration);

/** Pictures and milliseconds from a pressed key to the picture that holds the thrown ball. */
const answerTo = (page) => page.evaluate(() => new Promise((resolve) => {
  const { app, live } = window.cairn;
  const bodies = live.roster.bodies.size;
  const begin = performance.now();
  const first = app.stage.pictures;
  window.dispatchEvent(new KeyboardEvent('keydown', { key: 't' }));
  const tick = () => {
    const [panel] = app.stage.panels;
    const drawn = live.roster.bodies.size > bodies && panel.frame?.epoch === live.roster.epoch;
    if (drawn) resolve({ pictures: app.stage.pictures - first, ms: performance.now() - begin });
    else requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}));

async function measure(browser, scene) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  const begin = Date.now();
  const { address, child } = await serve(cairn, scene);
  await page.goto(address);
  await until(page, 'window.cairn?.app?.stage?.pictures > 0 && window.cairn.app.stage.panels[0].frame !== null');
  const firstPicture = Date.now() - begin;
  await countPictures(page, 6000); // the quality finds its place
  const { perSecond, quality, realTime } = await countPictures(page, 5000);
  const answers = [];
  for (let i = 0; i < trials; i++) answers.push(await answerTo(page));
  console.log(`${scene}: first picture ${firstPicture} ms after the command; ${perSecond.toFixed(1)} pictures/s in quality '${quality}', `
    + `${realTime.toFixed(2)}x real time; a thrown ball is there after ${median(answers.map((a) => a.pictures))} pictures, `
    + `${median(answers.map((a) => a.ms)).toFixed(0)} ms (medians of ${trials})`);
  child.removeAllListeners('exit');
  child.kill('SIGINT');
  await page.close();
}

(async () => {
  const browser = await launch();
  try {
    for (const scene of scenes) await measure(browser, scene);
  } finally {
    await browser.close();
    endAll();
  }
})();
