/** Makes elements of the page. */

/**
 * The element with this id.
 *
 * @template {string} Id
 * @param {Id} id
 * @returns {Id extends keyof PageElements ? PageElements[Id] : HTMLElement}
 */
export function byId(id) {
  return /** @type {any} */ (document.getElementById(id));  // what page.d.ts says of it
}

/** A new element with these properties and children; names with a dash are set as attributes. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes('-')) {
      element.setAttribute(name, value);
    } else {
      element[name] = value;
    }
  }
  element.append(...children);
  return element;
}

/** Fills a select with [value, text] pairs. */
export function fillSelect(select, options) {
  select.replaceChildren(...options.map(([value, text]) => make('option', {value, textContent: text})));
}

/** A group of radio buttons that looks like one; `choices` are [value, text, title]. */
export function fillSegments(group, name, choices, onChoice) {
  group.replaceChildren(...choices.map(([value, text, title]) => {
    const input = make('input', {type: 'radio', name, value, 'data-testid': `${name}-${value}`});
    input.addEventListener('change', () => onChoice(value));
    return make('label', {title: title ?? ''}, input, text);
  }));
}

/** Marks one choice of such a group. */
export function choose(group, value) {
  for (const input of group.querySelectorAll('input')) {
    input.checked = input.value === String(value);
  }
}
