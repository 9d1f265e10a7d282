// results/index.html in a real browser: no console error, no request that fails or leaves the folder, every image shows once it is
// scrolled to, nothing overflows, all text can be read; at 400 and 1400 px, light and dark, folded parts opened, from the file
// itself without a network, and once from a server.
// usage: node page.js INDEX.html [SCREENSHOT-FOLDER]      CHROMIUM: the browser, by default /usr/bin/chromium

import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, dirname, extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const WIDTHS = [400, 1400];
const SCHEMES = ["light", "dark"];
const SMALLEST_TEXT = 11; // px
const LEAST_CONTRAST = 4.5; // WCAG 2 AA
const PATIENCE = 20_000; // ms, for one image
const TYPES = { ".html": "text/html", ".png": "image/png", ".svg": "image/svg+xml", ".json": "application/json" };

// What is wrong with the page as it stands, as sentences. Runs in the browser.
const look = async ({ smallestText, leastContrast, patience }) => {
  const faults = [];
  const name = (e) => `<${e.tagName.toLowerCase()}> ${(e.textContent || e.getAttribute("alt") || "").trim().slice(0, 60)}`;
  for (const details of document.querySelectorAll("details")) details.open = true;

  const images = [...document.images];
  if (images.length === 0) faults.push("the page has no image");
  for (const image of images) {
    // Lazy ones are left lazy: whoever scrolls to one must see it.
    image.scrollIntoView({ block: "center", behavior: "instant" });
    const late = new Promise((_, reject) => setTimeout(reject, patience));
    await Promise.race([image.decode(), late]).catch(() => {});
    const { width, height } = image.getBoundingClientRect();
    const src = image.getAttribute("src");
    if (!image.complete || image.naturalWidth === 0) faults.push(`image does not show: ${src}`);
    else if (width < 40) faults.push(`image is shown too small: ${src}`);
    else if (Math.abs(width * image.naturalHeight - height * image.naturalWidth) > 2 * image.naturalWidth) faults.push(`image is shown distorted: ${src}`);
    else if (!image.alt) faults.push(`image without alternative text: ${src}`);
  }
  window.scrollTo({ top: 0, behavior: "instant" });

  const width = document.documentElement.clientWidth;
  if (document.scrollingElement.scrollWidth > width) {
    faults.push(`the page is ${document.scrollingElement.scrollWidth} px wide in a window of ${width}`);
  }
  const scrolls = (e) => e && (["auto", "scroll"].includes(getComputedStyle(e).overflowX) || scrolls(e.parentElement));
  for (const e of document.body.querySelectorAll("*")) {
    const box = e.getBoundingClientRect();
    if (box.width > 0 && (box.right > width + 1 || box.left < -1) && !scrolls(e.parentElement)) faults.push(`sticks out: ${name(e)}`);
  }

  const channels = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (c) => {
    const [r, g, b] = c.slice(0, 3).map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground = (e) => {
    for (; e; e = e.parentElement) {
      const c = channels(getComputedStyle(e).backgroundColor);
      if (c.length < 4 || c[3] > 0) return c;
    }
    return [255, 255, 255];
  };
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const seen = new Set();
  while (walker.nextNode()) {
    const e = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || seen.has(e) || e.getClientRects().length === 0) continue;
    seen.add(e);
    const style = getComputedStyle(e);
    if (parseFloat(style.fontSize) < smallestText) faults.push(`text of ${style.fontSize}: ${name(e)}`);
    const [high, low] = [luminance(channels(style.color)), luminance(ground(e))].sort((a, b) => b - a);
    const contrast = (high + 0.05) / (low + 0.05);
    if (contrast < leastContrast) faults.push(`contrast ${contrast.toFixed(2)}: ${name(e)}`);
  }
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    if (!document.getElementById(decodeURIComponent(link.hash.slice(1)))) faults.push(`link to nowhere: ${link.hash}`);
  }
  return faults;
};

// What is wrong with `url` in a window of that width: sentences. Whatever it asks for must lie below `folder`.
async function visit(browser, url, folder, { width, colorScheme, offline, screenshots }) {
  const faults = [];
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme, offline });
  const page = await context.newPage();
  const inside = (asked) => asked.startsWith("data:") || asked.startsWith(folder);
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && faults.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => faults.push(`script: ${error.message}`));
  page.on("requestfailed", (request) => faults.push(`request failed: ${request.url()}`));
  page.on("request", (request) => inside(request.url()) || faults.push(`leaves the folder: ${request.url()}`));
  page.on("response", (response) => response.status() >= 400 && faults.push(`status ${response.status()}: ${response.url()}`));
  const picture = (name, options) => page.screenshot({ path: join(screenshots, `${width}-${colorScheme}${name}.png`), ...options });
  await page.goto(url);
  if (screenshots) await picture("", { fullPage: true });
  faults.push(...(await page.evaluate(look, { smallestText: SMALLEST_TEXT, leastContrast: LEAST_CONTRAST, patience: PATIENCE })));
  const images = await page.evaluate(() => document.images.length);
  // Links into the folder lead somewhere.
  for (const href of await page.evaluate(() => [...document.querySelectorAll("a[href]")].map((a) => a.href))) {
    if (!href.startsWith("file:")) continue;
    const path = new URL(href.split("#")[0]);
    if (!statSync(path, { throwIfNoEntry: false })) faults.push(`link to nowhere: ${href}`);
  }
  if (screenshots) await picture("-open", { fullPage: true });
  await context.close();
  return { faults, images };
}

async function check(browser, file, { widths = WIDTHS, schemes = SCHEMES, screenshots } = {}) {
  const faults = [];
  let images = 0;
  const note = (where, seen) => {
    faults.push(...seen.faults.map((fault) => `${where}: ${fault}`));
    images = seen.images;
  };
  const url = pathToFileURL(resolve(file)).href;
  const folder = pathToFileURL(dirname(resolve(file))).href + "/";
  for (const width of widths) {
    for (const colorScheme of schemes) {
      note(`${width} px, ${colorScheme}`, await visit(browser, url, folder, { width, colorScheme, offline: true, screenshots }));
    }
  }
  const server = createServer((request, response) => {
    try {
      const path = join(dirname(resolve(file)), decodeURIComponent(new URL(request.url, "http://localhost").pathname));
      const bytes = readFileSync(path);
      response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  const site = `http://127.0.0.1:${server.address().port}/`;
  note("from a server", await visit(browser, site + basename(file), site, { width: widths[0], colorScheme: "light", offline: false }));
  server.close();
  return { faults: [...new Set(faults)], images };
}

// Pages with one fault each, and what must be said of it: a check that passes these has no eyes.
const good = '<img alt="dot" width="50" height="50" src="data:image/svg+xml,<svg xmlns=%22http://www.w3.org/2000/svg%22 width=%2250%22 height=%2250%22/>">';
const BROKEN = [
  [good, null],
  [`${good}<img alt="none" width="50" height="50" src="nowhere.png">`, "image does not show"],
  [`${good}<details><img alt="none" width="50" height="50" loading="lazy" src="nowhere.png"></details>`, "image does not show"],
  [`${good}<div style="height: 30000px"></div><img alt="none" width="50" height="50" loading="lazy" src="nowhere.png">`, "image does not show"],
  [`${good}<div style="height: 30000px"></div>${good.replace("<img", '<img loading="lazy"')}`, null],
  [good.replace('width="50"', 'width="200"'), "distorted"],
  [good.replace('alt="dot"', ""), "alternative text"],
  ['<img alt="text" width="50" height="50" src="text.png">', "image does not show"],
  [`${good}<div style="width: 2000px">wide</div>`, "px wide in a window"],
  [`${good}<div style="overflow-x: auto"><div style="width: 2000px">wide</div></div>`, null],
  [`${good}<script>console.error("broken")</script>`, "console: broken"],
  [`${good}<script>null.x</script>`, "script:"],
  [`${good}<p style="font-size: 8px">small</p>`, "text of 8px"],
  [`${good}<p style="color: #999; background: #fff">faint</p>`, "contrast"],
  [`${good}<script src="https://example.org/x.js"></script>`, "leaves the folder"],
  [`${good}<a href="#nowhere">link</a>`, "link to nowhere"],
  [`${good}<a href="nowhere.svg">link</a>`, "link to nowhere"],
  [`${good}<script>fetch("nowhere.json").catch(() => {})</script>`, "from a server: status 404"],
  [`${good}<div style="overflow-x: hidden"><div style="width: 2000px">cut off</div></div>`, "sticks out"],
  ["<p>nothing</p>", "no image"],
];

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  args: [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
  ],
});
let failed = 0;
try {
  const folder = mkdtempSync(join(tmpdir(), "riemap-page-"));
  try {
    writeFileSync(join(folder, "text.png"), "no picture");
    for (const [body, wanted] of BROKEN) {
      const file = join(folder, "index.html");
      writeFileSync(file, `<!doctype html><html lang="en"><meta charset="utf-8"><title>test</title><link rel="icon" href="data:,"><body>${body}`);
      const { faults } = await check(browser, file, { widths: [400], schemes: ["light"] });
      const right = wanted === null ? faults.length === 0 : faults.some((fault) => fault.includes(wanted));
      if (!right) {
        failed += 1;
        console.log(`FAIL the check says ${JSON.stringify(faults)} of ${body}, expected ${wanted}`);
      }
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
  console.log(`${failed ? "FAIL" : "ok  "} page check on ${BROKEN.length} made pages`);

  const [file, screenshots] = process.argv.slice(2);
  if (screenshots) mkdirSync(screenshots, { recursive: true });
  const { faults, images } = await check(browser, file, { screenshots });
  faults.slice(0, 40).forEach((fault) => console.log(`FAIL ${fault}`));
  console.log(`${faults.length ? "FAIL" : "ok  "} ${file}: ${images} images, ${faults.length} faults`);
  failed += faults.length;
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
