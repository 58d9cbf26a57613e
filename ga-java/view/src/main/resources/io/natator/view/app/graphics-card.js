/** Whether there is a graphics card that WebGL can draw with. */

/** Names of what draws without a graphics card. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

let known = null;

/** Whether WebGL is there and a graphics card behind it. */
export function hasGraphicsCard() {
  known ??= findGraphicsCard();
  return known;
}

function findGraphicsCard() {
  const context = document.createElement('canvas').getContext('webgl2');
  if (context === null) {
    return false;
  }
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = info === null ? '' : context.getParameter(info.UNMASKED_RENDERER_WEBGL);
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return !SOFTWARE.test(name);
}
