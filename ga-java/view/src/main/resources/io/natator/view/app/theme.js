/** Light, dark, or as the system has it. */

const DARK = matchMedia('(prefers-color-scheme: dark)');

/** Sets `data-theme` of the page, and says when it changed. */
export class Theme {
  #choice = 'auto';
  #onChange;

  /** `onChange(colours)` gets the colours for `Stage.setTheme`. */
  constructor(choice, onChange) {
    this.#onChange = onChange;
    DARK.addEventListener('change', () => this.choose(this.#choice));
    this.choose(choice);
  }

  get choice() {
    return this.#choice;
  }

  /** auto, light or dark. */
  choose(choice) {
    this.#choice = choice;
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
    this.#onChange(this.colours);
  }

  get isDark() {
    return this.#choice === 'dark' || this.#choice === 'auto' && DARK.matches;
  }

  /** From light to dark and back. */
  toggle() {
    this.choose(this.isDark ? 'light' : 'dark');
  }

  get colours() {
    const style = getComputedStyle(document.documentElement);
    return Object.fromEntries(['background', 'sky', 'floor', 'marks', 'edges', 'ink', 'dye', 'deep', 'zenith', 'horizon']
        .map(name => [name, style.getPropertyValue(`--stage-${name}`).trim()]));
  }
}
