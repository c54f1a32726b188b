// Prints what Khronos' validator finds in GLB files, a line of JSON each: errors, warnings, and the first error.
//   node validate.mjs GLTF_VALIDATOR_MODULE FILE...
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const [module, ...files] = process.argv.slice(2);
const validator = createRequire(import.meta.url)(module);
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 0 });
  const first = report.issues.messages.find((message) => message.severity === 0);
  console.log(JSON.stringify({
    errors: report.issues.numErrors,
    warnings: report.issues.numWarnings,
    first: first ? `${first.pointer}: ${first.message}` : '',
  }));
}
