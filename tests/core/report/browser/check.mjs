// What a browser finds in a report: nothing is loaded or run, pictures are there, nothing is wider
// than the screen, everything can be read, and paper gets whole pages.
// usage: node check.mjs REPORT.html CHROMIUM FOLDER_FOR_PICTURES
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import puppeteer from 'puppeteer-core';

const [reportPath, chromium, folder] = process.argv.slice(2);
const reportUrl = pathToFileURL(reportPath).href;
const kWidths = [400, 800, 1280];  // [px] a phone, a tablet, a desk
const kShown = 6000;               // [px] of the page's top in screenshots
const kContrast = 4.5;             // WCAG 2.1, 1.4.3
const kPages = {A4: [12, 30], Letter: [12, 30]};
const kCharts = 10;

const findings = [];
const expect = (holds, sentence) => holds || findings.push(sentence);

// Runs in the page.
function inspect() {
  const luminance = (color) => {
    const channels = color.slice(0, 3).map((c) => c / 255)
        .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2];
  };
  const parse = (color) => color.match(/[\d.]+/g).map(Number);
  const backgroundOf = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const color = parse(getComputedStyle(at).backgroundColor);
      if (color.length < 4 || color[3] === 1) return color;
    }
    return [255, 255, 255];
  };
  const hasOwnText = (element) =>
      [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
  const contrastOf = (element) => {
    const [a, b] = [getComputedStyle(element).color, null];
    const front = luminance(parse(a));
    const back = luminance(b ?? backgroundOf(element));
    return (Math.max(front, back) + 0.05) / (Math.min(front, back) + 0.05);
  };
  const words = [...document.body.querySelectorAll(':not(svg *)')]
      .filter((element) => hasOwnText(element) && element.getClientRects().length > 0);
  return {
    title: document.title,
    subject: document.querySelector('.subject')?.textContent ?? '',
    scripts: document.scripts.length,
    handlers: [...document.querySelectorAll('*')].filter((element) =>
        [...element.attributes].some((attribute) => attribute.name.startsWith('on'))).length,
    images: [...document.images].map((image) => ({
      alt: image.alt, width: image.naturalWidth, decoded: image.complete && image.naturalWidth > 0,
    })),
    charts: [...document.querySelectorAll('.chart svg:not(svg svg)')].map((svg) => ({
      width: svg.getBoundingClientRect().width, height: svg.getBoundingClientRect().height,
      named: svg.getAttribute('role') === 'img' && !!svg.getAttribute('aria-label'),
    })),
    tables: [...document.querySelectorAll('table')].map((table) => ({
      caption: table.caption?.textContent ?? '',
      unscoped: table.querySelectorAll('th:not([scope])').length,
      headings: table.querySelectorAll('thead th').length,
    })),
    headings: [...document.querySelectorAll('h1, h2, h3')].map((h) => Number(h.tagName[1])),
    deadLinks: [...document.querySelectorAll('a')].map((a) => a.getAttribute('href'))
        .filter((href) => !href.startsWith('#') || !document.getElementById(href.slice(1))),
    duplicateIds: [...document.querySelectorAll('[id]')].map((element) => element.id)
        .filter((id, i, all) => all.indexOf(id) !== i),
    faint: words.map((element) => ({contrast: contrastOf(element), text: element.textContent}))
        .filter(({contrast}) => contrast < 4.5),
    advice: document.querySelectorAll('.advice').length,
    verdicts: [...new Set([...document.querySelectorAll('.verdict')].map((v) => v.textContent))],
  };
}

function checkFacts(facts) {
  expect(facts.title.startsWith('Gait report: <script>'), `title is '${facts.title}'`);
  expect(facts.subject.includes('<img src=x onerror=alert(1)>'), 'the subject is not shown as is');
  expect(facts.scripts === 0, `${facts.scripts} scripts`);
  expect(facts.handlers === 0, `${facts.handlers} event handlers`);
  expect(facts.images.length === 4, `${facts.images.length} pictures in place of 4`);
  for (const image of facts.images) {
    expect(image.decoded && image.alt, `picture '${image.alt}' is ${image.width} px wide`);
  }
  expect(facts.charts.length >= kCharts, `${facts.charts.length} charts`);
  for (const chart of facts.charts) {
    expect(chart.width > 200 && chart.height > 100 && chart.named,
           `a chart of ${chart.width} x ${chart.height} px, named: ${chart.named}`);
  }
  for (const table of facts.tables) {
    expect(table.caption && table.headings > 1 && table.unscoped === 0,
           `table '${table.caption}': ${table.headings} headings, ${table.unscoped} without scope`);
  }
  expect(facts.tables.length >= 10, `${facts.tables.length} tables`);
  facts.headings.forEach((level, i) => expect(
      i === 0 ? level === 1 : level <= facts.headings[i - 1] + 1, `heading ${i} skips a level`));
  expect(facts.deadLinks.length === 0, `links to nowhere: ${facts.deadLinks}`);
  expect(facts.duplicateIds.length === 0, `ids used twice: ${facts.duplicateIds}`);
  for (const {contrast, text} of facts.faint) {
    findings.push(`contrast ${contrast.toFixed(2)} < ${kContrast}: ${text.slice(0, 60)}`);
  }
  expect(facts.verdicts.length > 0, 'no verdict');
}

async function checkWidths(page) {
  for (const width of kWidths) {
    await page.setViewport({width, height: 900});
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide <= width, `the page is ${wide} px wide on a screen of ${width} px`);
    await page.screenshot(
        {path: join(folder, `screen_${width}.png`), clip: {x: 0, y: 0, width, height: kShown}});
  }
}

async function checkPaper(page) {
  // The printable width of A4 with the sheet's margins: what is wider is cut off.
  const width = Math.round((210 - 26) / 25.4 * 96);
  await page.setViewport({width, height: 900});
  await page.emulateMediaType('print');
  const cut = await page.evaluate((limit) => [...document.querySelectorAll('table, img, svg')]
      .filter((element) => element.getBoundingClientRect().right > limit + 1)
      .map((element) => element.caption?.textContent ?? element.tagName), width);
  expect(cut.length === 0, `cut off on paper: ${cut}`);
  for (const [format, [fewest, most]] of Object.entries(kPages)) {
    const pdf = Buffer.from(await page.pdf({format, preferCSSPageSize: false}));
    const pages = pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length;
    expect(pages >= fewest && pages <= most, `${pages} pages of ${format}`);
    console.log(`report_browser: ${pages} pages of ${format}`);
    await writeFile(join(folder, `print_${format}.pdf`), pdf);
  }
}

const profile = await mkdtemp(join(tmpdir(), 'report_browser_'));
const browser = await puppeteer.launch({
  executablePath: chromium,
  headless: true,
  userDataDir: profile,
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
         '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
try {
  const page = await browser.newPage();
  page.on('console', (message) => findings.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => findings.push(`error: ${error}`));
  page.on('dialog', (dialog) => findings.push(`dialog: ${dialog.message()}`) && dialog.dismiss());
  page.on('request', (request) => expect(
      request.url() === reportUrl || request.url().startsWith('data:'),
      `asks for ${request.url().slice(0, 80)}`));
  await page.goto(reportUrl, {waitUntil: 'load'});
  checkFacts(await page.evaluate(inspect));
  await checkWidths(page);
  await checkPaper(page);
} finally {
  await browser.close();
  await rm(profile, {recursive: true, force: true});
}
for (const finding of findings) {
  console.error(`report_browser: ${finding}`);
}
process.exit(findings.length > 0 ? 1 : 0);
