// Bundles page.html, style.css and src/ into one page that needs nothing else.
// Usage: node build.mjs MODULES OUT; MODULES: the node_modules with esbuild and three.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [modules, out] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(modules, 'of-the-page.js'))('esbuild');
const common = { bundle: true, minify: true, write: false, legalComments: 'none', charset: 'utf8', logLevel: 'warning' };
const script = await esbuild.build({
  ...common, entryPoints: [join(here, 'src/main.js')], nodePaths: [modules], format: 'iife', target: 'es2020',
});
const style = await esbuild.build({ ...common, entryPoints: [join(here, 'style.css')] });

// Within a page a script ends at </script>, wherever that stands.
const within = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const licence = (name) => readFileSync(join(modules, name, 'LICENSE'), 'utf8').trim().replaceAll('--', '- -');
const page = readFileSync(join(here, 'page.html'), 'utf8')
  .replace('LICENCE-OF-THREE', () => licence('three'))
  .replace('LICENCE-OF-FZSTD', () => licence('fzstd'))
  .replace('/*STYLE*/', () => style.outputFiles[0].text.trim())
  .replace('/*SCRIPT*/', () => within(script.outputFiles[0].text.trim()));
if (page.split('<!--CLUES-DATA-->').length !== 2) throw new Error('page.html has no one place for the data');
writeFileSync(out, page);
