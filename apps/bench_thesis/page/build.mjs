// Bundles a page into one HTML file: node build.mjs [--source DIR] [--modules DIR] [--out FILE] [--bytes FILE]
//   --source   the folder of main.ts, style.css and page.html (default: src beside this file)
//   --modules  where the dependencies are installed (default: node_modules beside this file)
//   --out      the page (default: dist/index.html)
//   --bytes    the page as a comma-separated list of numbers, for a C++ array
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const options = {
  source: join(here, 'src'),
  modules: join(here, 'node_modules'),
  out: join(here, 'dist', 'index.html'),
  bytes: '',
};
for (let i = 2; i < process.argv.length; i += 2) {
  const name = process.argv[i].replace(/^--/, '');
  if (!(name in options) || process.argv[i + 1] === undefined) throw new Error(`unknown option ${process.argv[i]}`);
  options[name] = resolve(process.argv[i + 1]);
}

// The bundler is installed where the other dependencies are, which need not be above this file.
const { build } = createRequire(pathToFileURL(join(options.modules, '..', 'package.json')))('esbuild');

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(options.source, entry)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'inline',
    nodePaths: [options.modules],
    write: false,
    logLevel: 'warning',
  });
  return result.outputFiles[0].text;
}

function write(file, content) {
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, content);
}

const script = (await bundle('main.ts')).replaceAll('</script', '<\\/script');
const style = (await bundle('style.css')).replaceAll('</style', '<\\/style');
// Functions as replacements, because "$" in the bundle must stay as it is.
const page = readFileSync(join(options.source, 'page.html'), 'utf8')
  .replace('/* style */', () => style)
  .replace('/* script */', () => script);
write(options.out, page);
if (options.bytes) {
  write(options.bytes, Array.from(Buffer.from(page)).join(',').replace(/((?:\d+,){32})/g, '$1\n') + '\n');
}
console.log(`${options.out}: ${page.length} characters`);
