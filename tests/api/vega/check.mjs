// Validates, compiles and draws the specifications that figure_specs wrote, and holds what is drawn
// against the bare data. usage: node check.mjs FOLDER; writes FOLDER/NAME.vega.svg.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import Ajv from "ajv";
import { XMLValidator } from "fast-xml-parser";
import * as vega from "vega";
import * as vegaLite from "vega-lite";

const schemaFile = createRequire(import.meta.url).resolve("vega-lite/build/vega-lite-schema.json");
const ajv = new Ajv({ strict: false, logger: false });
ajv.addFormat("color-hex", /^#([0-9a-f]{3}|[0-9a-f]{6})$/i);
const validate = ajv.compile(JSON.parse(readFileSync(schemaFile, "utf8")));

/** What the tools of vega complain about counts as a fault. */
function makeLogger(faults) {
  const logger = {
    level: () => logger,
    error: (...words) => (faults.push(words.join(" ")), logger),
    warn: (...words) => (faults.push(words.join(" ")), logger),
    info: () => logger,
    debug: () => logger,
  };
  return logger;
}

function count(text, pattern) {
  return (text.match(pattern) ?? []).length;
}

/** Series of a kind that have a number to draw. */
function countSeries(data, mark) {
  const isDrawn = (series) => series.mark === mark && series.y.some((y) => y !== null);
  return data.panels.flatMap((panel) => panel.series).filter(isDrawn).length;
}

function countBars(data) {
  const bars = data.panels.flatMap((panel) => panel.series).filter((s) => s.mark === "bars");
  return bars.flatMap((series) => series.y).filter((y) => y !== null).length;
}

function axisTitle(axis) {
  return axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;
}

function escapeXml(text) {
  return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
}

function checkTexts(data, svg, faults, picture) {
  for (const panel of data.panels) {
    for (const axis of [panel.x, panel.y]) {
      // Categories say what they are.
      if (!axis.label && axis === panel.x && panel.series.some((s) => s.mark === "bars")) continue;
      if (!axis.label) faults.push(`panel ${panel.name} has an axis without label`);
      if (!svg.includes(`>${escapeXml(axisTitle(axis))}<`)) {
        faults.push(`${picture} has no axis title '${axisTitle(axis)}'`);
      }
    }
  }
  for (const word of ["NaN", "undefined", "Infinity"]) {
    if (svg.includes(word)) faults.push(`${picture} contains ${word}`);
  }
}

function expectEqual(what, found, expected, faults) {
  if (found !== expected) faults.push(`${what}: ${found} drawn, ${expected} expected`);
}

function checkVegaPicture(data, svg, faults) {
  checkTexts(data, svg, faults, "vega's picture");
  const guides = data.panels.flatMap((panel) => panel.guides).length;
  const groups = count(svg, /class="mark-group role-scope concat_\d+_group"/g);
  expectEqual("panels", groups, data.panels.length, faults);
  const lines = count(svg, /aria-roledescription="line mark"[^>]* d="M[^"]/g);
  expectEqual("lines", lines, countSeries(data, "line"), faults);
  const areas = count(svg, /aria-roledescription="area mark"[^>]* d="M[^"]/g);
  expectEqual("bands", areas, countSeries(data, "band"), faults);
  expectEqual("bars", count(svg, /aria-roledescription="bar"/g), countBars(data), faults);
  const rules = count(svg, /aria-roledescription="rule mark"/g);
  expectEqual("guides", rules, guides, faults);
}

function checkOwnPicture(data, svg, faults) {
  const outcome = XMLValidator.validate(svg);
  if (outcome !== true) faults.push(`our picture is not XML: ${outcome.err.msg}`);
  checkTexts(data, svg, faults, "our picture");
  expectEqual("our windows", count(svg, /overflow="hidden"/g), data.panels.length, faults);
}

async function checkFigure(folder, name) {
  const faults = [];
  const read = (ending) => readFileSync(join(folder, name + ending), "utf8");
  const text = read(".vl.json");
  const data = JSON.parse(read(".data.json"));
  const spec = JSON.parse(text);
  if (!validate(spec)) faults.push(`schema: ${ajv.errorsText(validate.errors.slice(0, 3))}`);
  const logger = makeLogger(faults);
  const compiled = vegaLite.compile(spec, { logger }).spec;
  const view = new vega.View(vega.parse(compiled), { renderer: "none", logger });
  const svg = await view.toSVG();
  view.finalize();
  writeFileSync(join(folder, `${name}.vega.svg`), svg);
  checkVegaPicture(data, svg, faults);
  checkOwnPicture(data, read(".svg"), faults);
  if (data.panels.length === 0) faults.push("there is no panel");
  return { name, bytes: Buffer.byteLength(text), faults };
}

const folder = process.argv[2];
const names = readdirSync(folder)
  .filter((file) => file.endsWith(".vl.json"))
  .map((file) => file.slice(0, -".vl.json".length));
let failed = names.length === 0;
for (const name of names.sort()) {
  const { bytes, faults } = await checkFigure(folder, name);
  console.log(`${faults.length ? "FAIL" : "ok  "} ${name}: ${bytes} bytes`);
  for (const fault of new Set(faults)) console.log(`     ${fault}`);
  failed ||= faults.length > 0;
}
process.exit(failed ? 1 : 0);
