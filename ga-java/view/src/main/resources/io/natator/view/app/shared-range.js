/** The scale of the water's colours: two pictures of water have one, over both. */

/** The ends of the scale of each view. */
export class SharedRange {
  #onChange;
  #share;
  #has;
  #ranges = [];

  /**
   * @param {(range: number[]) => void} onChange is called with the ends over all views that have what is coloured
   * @param {(view: object, range: number[]|null) => void} share gives a view the ends over both, or null for its own
   * @param {(view: object) => boolean} has whether a view has what is coloured
   */
  constructor(onChange, share, has) {
    this.#onChange = onChange;
    this.#share = share;
    this.#has = has;
  }

  /** One view's own have changed. */
  changed(which, range, views) {
    this.#ranges[which] = range;
    const all = views.map((view, i) => this.#has(view) ? this.#ranges[i] : undefined).filter(one => one !== undefined);
    const both = [Math.min(...all.map(one => one[0])), Math.max(...all.map(one => one[1]))];
    views.forEach(view => this.#share(view, all.length > 1 ? both : null));
    if (all.length > 0) {
      this.#onChange(both);
    }
  }

  /** Only the first view is left. */
  keepFirst(first) {
    this.#ranges.length = 1;
    this.#share(first, null);
    if (this.#ranges[0] !== undefined) {
      this.#onChange(this.#ranges[0]);
    }
  }
}
