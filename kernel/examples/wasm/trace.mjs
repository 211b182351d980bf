// Writes a packet of rays into the module's memory, and prints what they hit.
import { readFileSync } from "node:fs";

const module = new WebAssembly.Module(readFileSync(process.argv[2]));
if (WebAssembly.Module.imports(module).length > 0) throw new Error("the module imports something");
const { memory, rays, hits, trace } = new WebAssembly.Instance(module).exports;

// A row of rays from the origin, through both spheres.
const directions = Array.from({ length: 16 }, (_, ray) => [(ray - 7.5) / 20, 0, -1]);
new Float32Array(memory.buffer, rays(), 16 * 6).set(directions.flatMap((direction) => [0, 0, 0, ...direction]));
trace();
const t = new Float32Array(memory.buffer, hits(), 32);
const sphere = new Uint32Array(memory.buffer, hits(), 32);
for (let ray = 0; ray < 16; ray++) {
  const place = Number.isFinite(t[2 * ray]) ? `hits sphere ${sphere[2 * ray + 1]} at t = ${t[2 * ray]}` : "hits nothing";
  console.log(`ray ${ray} ${place}`);
}
