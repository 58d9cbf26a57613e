/** Elements of the page that are more than any element, by their id: index.html and replay.html. */
interface PageElements {
  'front-other': HTMLSelectElement;
  'gait-file': HTMLInputElement;
  'gait-load': HTMLButtonElement;
  'gait-random': HTMLButtonElement;
  'gait-save': HTMLButtonElement;
  'help': HTMLDialogElement;
  'rate': HTMLSelectElement;
  'run-choice': HTMLSelectElement;
  'run-compare': HTMLButtonElement;
  'run-watch': HTMLButtonElement;
  'scene': HTMLSelectElement;
  'scheme': HTMLSelectElement;
  'scrub': HTMLInputElement;
  'speed': HTMLSelectElement;
  'swim': HTMLSelectElement;
  'theme': HTMLSelectElement;
  'vacuum': HTMLInputElement;
}

interface Window {
  /** Figures of what is shown, to be read by tests. */
  natator: object;
}
