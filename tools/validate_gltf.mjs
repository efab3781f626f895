// Prints what Khronos' glTF validator finds in each file; exit 1 when there is an error or a warning.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const folder = process.env.GLTF_VALIDATOR ?? process.cwd();
let validator;
try {
  validator = createRequire(join(folder, 'package.json'))('gltf-validator');
} catch {
  console.error(`validate_gltf: no gltf-validator in ${folder}\n` +
    'Install it in a folder of your choice (development only), and name that folder:\n' +
    '  npm install --prefix ~/gltf-validator gltf-validator@2.0.0-dev.3.10\n' +
    '  GLTF_VALIDATOR=~/gltf-validator tools/validate_gltf FILE.glb...');
  process.exit(2);
}

let bad = 0;
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  for (const { severity, code, pointer, message } of messages)
    console.log(`  ${['error', 'warning', 'info', 'hint'][severity]} ${code} ${pointer ?? ''}: ${message}`);
  if (numErrors + numWarnings > 0) bad += 1;
}
process.exit(bad > 0 ? 1 : 0);
