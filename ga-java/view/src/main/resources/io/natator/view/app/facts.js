/** What is known of a run's winner. */

const NAMES = {
  verdict: 'Verdict', controls: 'Controls', speed: 'Speed', distance: 'Distance', 'half step': 'Half step',
  selected: 'Selected', cost: 'Cost', flow: 'Flow',
};

/** Facts (by what they are about) as [name, text] pairs, in their order. */
export function namedFacts(facts) {
  return Object.entries(facts).map(([about, text]) => [NAMES[about] ?? about, text]);
}
