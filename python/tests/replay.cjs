// Recordings as notebooks show them, in a real headless Chromium without a network: replay.cjs PYTHON SCREENSHOTS
// Exit code 77 (skipped) only where there is no Chromium.
'use strict';
const assert = require('node:assert/strict');
const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const { browserPath, launch, until } = require('../../tests/view/e2e/browser.cjs');

const [python, screenshots] = process.argv.slice(2);
browserPath();

const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'cairn-replay-'));
fs.mkdirSync(screenshots, { recursive: true });

// What two cells of a notebook would show: a run, and a recording alone.
const program = `
import cairn
result = cairn.run("stacks5", duration=0.5, record="stacks5.h5")
print("<h2>A run</h2>", result._repr_html_(), "<h2>A recording</h2>", result.recording._repr_html_())
`;

async function main() {
  const cells = execFileSync(python, ['-c', program], { cwd: scratch, encoding: 'utf8', maxBuffer: 2 ** 28 });
  const file = path.join(scratch, 'notebook.html');
  fs.writeFileSync(file, `<!DOCTYPE html><meta charset="utf-8"><title>Notebook</title>
    <style>:root { color-scheme: light dark } body { font-family: sans-serif; margin: 1em }</style>${cells}`);
  const browser = await launch();
  try {
    for (const [theme, width] of [['light', 1100], ['dark', 420]]) {
      const context = await browser.newContext({ viewport: { width, height: 1150 }, colorScheme: theme, offline: true });
      const page = await context.newPage();
      const trouble = [];
      page.on('pageerror', (error) => trouble.push(error.message));
      page.on('console', (message) => { if (message.type() === 'error') trouble.push(message.text()); });
      page.on('request', (request) => { if (/^(http|ws)/.test(request.url())) trouble.push(request.url()); });
      await page.goto(`file://${file}`);
      const replays = page.frames().filter((frame) => frame !== page.mainFrame());
      assert.equal(replays.length, 2);
      for (const replay of replays) {
        await until(replay, 'Boolean(window.cairn?.app?.stage.panels[0]?.frame)');
        const frame = await replay.evaluate(() => {
          const { frame } = window.cairn.app.stage.panels[0];
          return { slots: frame.position.length / 3, finite: Array.from(frame.position).every(Number.isFinite) };
        });
        assert.deepEqual(frame, { slots: 277, finite: true });
      }
      await page.screenshot({ path: path.join(screenshots, `notebook-${theme}.png`) });
      assert.deepEqual(trouble, []);
      await context.close();
    }
  } finally {
    await browser.close();
  }
  console.log('ok   a run and a recording show themselves');
}

main().then(() => fs.rmSync(scratch, { recursive: true }), (error) => {
  console.log(`FAIL ${error.stack}`);
  process.exitCode = 1;
});
