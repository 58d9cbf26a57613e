/** The scale of the water's colours: two pictures of water have one, over both. */

/** The ends of the scale of each view. */
export class SharedRange {
  #onChange;
  #ranges = [];

  /** `onChange(range)` is called with the ends over all views that have water. */
  constructor(onChange) {
    this.#onChange = onChange;
  }

  /** One view's own have changed. */
  changed(which, range, views) {
    this.#ranges[which] = range;
    const all = views.map((view, i) => view.isVacuum ? undefined : this.#ranges[i]).filter(one => one !== undefined);
    const both = [Math.min(...all.map(one => one[0])), Math.max(...all.map(one => one[1]))];
    views.forEach(view => view.stage.shareRange(all.length > 1 ? both : null));
    if (all.length > 0) {
      this.#onChange(both);
    }
  }

  /** Only the first view is left. */
  keepFirst(first) {
    this.#ranges.length = 1;
    first.stage.shareRange(null);
    if (this.#ranges[0] !== undefined) {
      this.#onChange(this.#ranges[0]);
    }
  }
}
