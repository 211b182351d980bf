// Runs a module that imports nothing, and prints the text that it leaves.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { run, text, length, memory } = instance.exports;
const succeeded = run();
process.stdout.write(Buffer.from(memory.buffer, text(), length()));
process.exitCode = succeeded ? 0 : 1;
