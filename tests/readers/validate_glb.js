// validate_glb.js VALIDATOR FILE.glb: what Khronos' validator (npm: gltf-validator) finds; exit status 1 if it is anything.
const {readFileSync} = require('fs');

const [validator, file] = process.argv.slice(2);
require(validator).validateBytes(new Uint8Array(readFileSync(file))).then(({issues}) => {
  issues.messages.forEach(issue => console.error(`${file}: ${issue.code} at ${issue.pointer}: ${issue.message}`));
  process.exitCode = issues.messages.length > 0 ? 1 : 0;
});
