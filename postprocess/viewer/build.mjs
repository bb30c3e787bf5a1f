// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the viewer into bundle/, which is committed: who uses Talus needs no npm.   npm ci && npm run build [folder]
import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";

const folder = process.argv[2] ?? "bundle";
mkdirSync(folder, { recursive: true });
await build({
  entryPoints: { viewer: "main.js" },
  outdir: folder,
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2022"],
  charset: "utf8",
  legalComments: "none", // LICENSES.txt has them whole
});

// What stands in an element of HTML must not end it.
const script = `${folder}/viewer.js`;
writeFileSync(script, readFileSync(script, "utf8").replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--"));

const notices = ["three", "uplot"].map((name) => {
  const { version } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
  return `${name} ${version}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim()}\n`;
});
writeFileSync(`${folder}/LICENSES.txt`, `The viewer of Talus is under the GPL-3.0-or-later. Its bundle holds:\n\n${notices.join("\n\n")}`);
