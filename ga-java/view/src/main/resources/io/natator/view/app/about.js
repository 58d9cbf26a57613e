/** What is seen on the page, in a few words, for who sees it first. */

import {byId, make} from './element.js';

const LIVE = ['What you see', 'A soft creature and the water around it, computed while you watch. Nothing is '
    + 'animated by hand: muscles in the body get shorter and longer to a rhythm, its gait, and all else follows. The gait was '
    + 'evolved, or is set with the sliders.'];
const REPLAYED = ['What you see', 'A soft creature and the water around it, as they were computed. Nothing is animated by hand: '
    + 'muscles in the body get shorter and longer to a rhythm, its gait, and all else followed when it was simulated. This file '
    + 'holds that swim and plays it again; it needs no network and no program.'];
const PARTS = [
  ['The water', 'Each particle stands for a small cube of water. “Surface” lays a smooth surface around them, with light that '
    + 'is bent, taken up and mirrored: a picture, not a measurement; it is bluer than so little water would be. “Spheres” '
    + 'shows the particles themselves. Colours and their units are in the legend.'],
  ['The wake', 'Vorticity is how the water turns, velocity how fast it goes and where to, pressure what it has beyond the mean at its height: '
    + 'on a plane through the body, which can be moved. Vortices are surfaces around the hundredth of the water that turns most '
    + 'against how it is strained (Q-criterion); next to bodies none are told. All are interpolated from cells.'],
  ['The body', 'Its skin is the mesh that it was made of, or a smooth surface around its particles. Blue is where muscles '
    + 'shorten, orange where they lengthen; with muscles off the colours are its clusters, from the head to the tail. '
    + 'Lines show where the spine and the head have been.'],
  ['Vacuum', 'The same body and gait without water, gravity and walls. Nothing pushes back there, so a real swimmer cannot '
    + 'get anywhere. What still moves forwards does so by an error of the method, not by swimming.'],
  ['Schemes', '“conserving” keeps momentum to rounding and is meant for swimming as physics. “flex” moves particles as NVIDIA '
    + 'Flex does, to repeat work made with it; momentum is not kept there, and bodies move even in vacuum. “lattice” has the '
    + 'bodies of “conserving” in water on a lattice, which has no surface: its vortices are drawn.'],
];
const CHARTS = [
  ['The charts', 'Only those that the scene has something for. Speed is given in body lengths per second, over a beat.'],
  ['The charts', 'Distance is how far the middle of the body has come, speed is given in body lengths per second, over a beat. '
    + 'Momentum is the share that does not cancel out: 0 where a body pushes the water back as much as it goes forwards.'],
];

/**
 * A panel that a button (id `about-open`) opens; gives the function that opens it.
 *
 * @param {boolean} isLive whether what is seen is computed now, or was recorded
 */
export function about(isLive) {
  const parts = [isLive ? LIVE : REPLAYED, ...PARTS, CHARTS[isLive ? 0 : 1]];
  const close = make('button', {className: 'primary', textContent: 'Close'});
  const title = make('h2', {id: 'about-title', textContent: 'About this'});
  const dialog = make('dialog', {id: 'about', 'aria-labelledby': 'about-title', 'data-testid': 'about'}, title,
      ...parts.flatMap(([name, text]) => [make('h3', {textContent: name}), make('p', {textContent: text})]),
      make('form', {method: 'dialog'}, close));
  document.body.append(dialog);
  const open = () => dialog.showModal();
  byId('about-open').addEventListener('click', open);
  return open;
}
