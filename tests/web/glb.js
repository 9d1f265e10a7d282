// Every kind of .glb that `riemap map` writes, against the Khronos validator: no error, no warning.
// usage: node glb.js RIEMAP

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import validator from "gltf-validator";

const riemap = process.argv[2];
const maps = {
  quad: ["graph:cos+cos?n=33"],
  triangle: ["sphere?n=24&mesh=delaunay", "--boundary", "free"],
  digital: ["digital-cap?R=12"],
  cut: ["digital-torus?R=8&r=3.2", "--cut", "--boundary", "free"],
  periodic: ["digital-torus?R=8&r=3.2", "--boundary", "periodic"],
  removed: ["torus?R=2&r=0.8&n=16&mesh=triangle", "--remove-face", "3", "--cut"],
  large: ["plane?n=400"],
};

const folder = mkdtempSync(join(tmpdir(), "riemap-glb-"));
let failed = 0;
try {
  for (const [name, options] of Object.entries(maps)) {
    const path = join(folder, `${name}.glb`);
    // Warnings about the maps are not what this is about.
    execFileSync(riemap, ["map", ...options, "--quiet", "-o", path], { stdio: ["ignore", "inherit", "ignore"] });
    const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(path)));
    const good = issues.numErrors === 0 && issues.numWarnings === 0 && info.hasTextures && info.totalTriangleCount > 0;
    console.log(`${good ? "ok  " : "FAIL"} glb ${name}: ${info.totalVertexCount} vertices, ${info.totalTriangleCount} triangles`);
    if (!good) {
      failed += 1;
      console.log(JSON.stringify(issues.messages.slice(0, 10), null, 2));
    }
  }
} finally {
  rmSync(folder, { recursive: true });
}
console.log(`${Object.keys(maps).length - failed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
