/** What was set, kept in the address of the page: a reload, a bookmark or a link brings it back. */

const PAUSE_MS = 400;
let timer = 0;

/** What the address says; an empty object without anything. */
export function remembered() {
  try {
    return JSON.parse(decodeURIComponent(location.hash.slice(1)) || '{}');
  } catch {
    return {};
  }
}

/** Puts what `state()` gives into the address, soon. */
export function rememberSoon(state) {
  clearTimeout(timer);
  timer = setTimeout(() => history.replaceState(null, '', `#${encodeURIComponent(JSON.stringify(state()))}`), PAUSE_MS);
}
