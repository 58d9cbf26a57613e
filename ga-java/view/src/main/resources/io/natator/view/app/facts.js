/** What is known of a run's winner. */

/** Facts (by what they are about) as [name, text] pairs, in their order. */
export function namedFacts(facts) {
  return Object.entries(facts).map(([about, text]) => [about[0].toUpperCase() + about.slice(1), text]);
}
