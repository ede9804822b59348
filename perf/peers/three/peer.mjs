// The three.js peer: starts headless Chromium on Mesa's driver and passes orders (one JSON object a line on standard
// input) to the page and its answers back to standard output. Usage: node peer.mjs FOLDER_WITH_NODE_MODULES CHROMIUM
import { spawn, execFileSync } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const [modules, chromium] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const profile = mkdtempSync(join(tmpdir(), 'halfframe_peers_'));

const orders = [];   // not yet taken by the page
let waiting = null;  // the page's open request for an order

function handOut() {
  if (!waiting || orders.length === 0) return;
  waiting.setHeader('content-type', 'application/json');
  waiting.end(orders.shift());
  waiting = null;
}

function answer(text) {
  const value = JSON.parse(text);
  if (value.version) value.version += `, ${browserVersion}`;
  process.stdout.write(`${JSON.stringify(value)}\n`);
}

async function body(request) {
  const chunks = [];
  for await (const chunk of request) chunks.push(chunk);
  return Buffer.concat(chunks);
}

const types = { html: 'text/html', js: 'text/javascript', json: 'application/json' };

/** /three/... is the package, /file/... or /file?path=... any file of this machine, everything else this folder. */
function fileOf(url) {
  if (url.pathname === '/file') return url.searchParams.get('path');
  if (url.pathname.startsWith('/file/')) return decodeURIComponent(url.pathname.slice('/file'.length));
  if (url.pathname.startsWith('/three/')) return join(modules, 'node_modules', url.pathname);
  return join(here, url.pathname);
}

const server = createServer(async (request, response) => {
  const url = new URL(request.url, 'http://localhost');
  try {
    if (url.pathname === '/order') {
      waiting = response;
      handOut();
    } else if (url.pathname === '/answer') {
      answer(await body(request));
      response.end();
    } else if (url.pathname === '/picture') {
      writeFileSync(url.searchParams.get('path'), await body(request));
      response.end();
    } else {
      const file = fileOf(url);
      const type = types[file.split('.').pop()] ?? 'application/octet-stream';
      const bytes = readFileSync(file);
      response.setHeader('content-type', type);
      response.end(bytes);
    }
  } catch (error) {
    response.statusCode = 404;
    response.end(String(error));
  }
});

const browserVersion = execFileSync(chromium, ['--version', '--no-sandbox']).toString().trim().split(' built')[0];
server.listen(0, '127.0.0.1', () => {
  const flags = [
    '--headless', '--no-sandbox', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--disable-quic', '--disable-extensions', '--mute-audio', `--user-data-dir=${profile}`,
    // Mesa through EGL without a display; by itself headless Chromium would bring its own software driver, SwiftShader.
    '--use-gl=angle', '--use-angle=gl-egl', '--ignore-gpu-blocklist', '--disable-software-rasterizer',
    // Nothing is throttled because nobody looks.
    '--disable-background-timer-throttling', '--disable-renderer-backgrounding',
    '--disable-backgrounding-occluded-windows', '--disable-gpu-watchdog',
  ];
  const browser = spawn(chromium, [...flags, `http://127.0.0.1:${server.address().port}/page.html`],
                        { stdio: ['ignore', 'ignore', 'ignore'] });
  const stop = () => {
    browser.removeAllListeners('exit');
    browser.on('exit', () => {
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
      process.exit(0);
    });
    browser.kill('SIGTERM');
  };
  browser.on('exit', (code) => {
    process.stdout.write(`${JSON.stringify({ error: `Chromium ended with ${code}` })}\n`);
    process.exit(1);
  });
  const lines = createInterface({ input: process.stdin });
  lines.on('line', (line) => {
    orders.push(line);
    handOut();
  });
  lines.on('close', stop);
  process.on('SIGTERM', stop);
});
