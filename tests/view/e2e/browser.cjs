// A headless Chromium without a graphics card, and cairn view to look at.
'use strict';
const { spawn } = require('node:child_process');
const fs = require('node:fs');

const patience = 60000;
const children = [];

/** Where Chromium is; ends with exit code 77 (skipped) if it is nowhere. */
function browserPath() {
  const found = process.env.CAIRN_CHROMIUM
    ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((p) => fs.existsSync(p));
  if (found) return found;
  console.log('skipped: there is no Chromium; install the package chromium to run the viewer in a browser');
  return process.exit(77);
}

function launch() {
  const executablePath = browserPath();
  return require('playwright-core').chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--disable-dev-shm-usage'],
  });
}

/** Starts cairn view and gives its address. */
function serve(cairn, ...words) {
  const child = spawn(cairn, ['view', ...words, '--no-open', '--port', '0'], { stdio: ['ignore', 'pipe', 'ignore'] });
  children.push(child);
  return new Promise((resolve, reject) => {
    child.stdout.on('data', (data) => resolve({ address: String(data).trim(), child }));
    child.on('exit', (code) => reject(new Error(`cairn view ended with ${code}`)));
  });
}

function endAll() {
  for (const child of children) {
    child.removeAllListeners('exit');
    if (child.exitCode === null) child.kill('SIGKILL');
  }
}

/** Waits until an expression or function on the page is true; by asking, since the page's policy forbids it to evaluate. */
async function until(page, expression, argument) {
  for (const end = Date.now() + patience; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 40))) {
    if (await page.evaluate(expression, argument)) return;
  }
  throw new Error(`this did not become true: ${expression}`);
}

module.exports = { browserPath, endAll, launch, serve, until };
