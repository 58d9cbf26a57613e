/** The graphics card as WebGPU knows it, asked for once and shared by all pictures. */

/** After its loss a card needs a while before anything can be drawn with it. */
const RECOVERY_MS = 1000;

const listeners = new Set();
let device = null;
let isAsked = false;
let isSoftware = false;

async function ask() {
  const adapter = await navigator.gpu?.requestAdapter({powerPreference: 'high-performance'}) ?? null;
  if (adapter === null) {
    return;
  }
  const found = await adapter.requestDevice();
  isSoftware = adapter.info.isFallbackAdapter === true;
  const lose = why => {
    if (device === found) {
      console.warn(`without WebGPU: ${why}`);
      device = null;
      found.destroy();
      setTimeout(() => listeners.forEach(one => one()), RECOVERY_MS);
    }
  };
  found.lost.then(({message}) => lose(message));
  found.addEventListener('uncapturederror', ({error}) => lose(error.message));
  device = found;
  listeners.forEach(one => one());
}

/**
 * The device, or null: where there is none, where it was lost, and as long as it is not known. Listeners hear when that
 * changes.
 *
 * @param {boolean} isChosen whether one that is a program without a card will do
 */
export function gpuDevice(isChosen) {
  if (!isAsked) {
    isAsked = true;
    ask().catch(error => console.warn(`without WebGPU: ${error.message}`));
  }
  return isSoftware && !isChosen ? null : device;
}

/** Calls `listener()` when `gpuDevice` has another answer, until what this returns is called. */
export function onGpuChange(listener) {
  listeners.add(listener);
  return () => listeners.delete(listener);
}
