/** What was set, as files. */

/**
 * A gait as the text of a file for `--gait`.
 *
 * @param {Scene} scene
 */
export function gaitText(scene) {
  return text(scene.gait);
}

/**
 * A scene as the text of a file for `--scene`: what it builds on, and what differs.
 *
 * @param {Scene} scene
 */
export function sceneText(scene) {
  const own = scene.overrides ?? {};
  return text({base: scene.scene, ...own, ...(own.scheme === undefined ? {scheme: scene.scheme} : {})});
}

/** Lets the browser save a text. */
export function download(name, content) {
  saveBlob(name, new Blob([content], {type: 'application/json'}));
}

/** Lets the browser save a file. */
export function saveBlob(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** A name for a file of this scene. */
export function fileName(scene, kind, ending = 'json') {
  return `${scene.scene.split('/').at(-1).replace(/\.json$/, '')}-${kind}.${ending}`;
}

function text(value) {
  return `${JSON.stringify(value, null, 2)}\n`;
}
