/** What keys do on the page of `natator view`. */

import {CAMERAS} from './cameras.js';
import {byId} from './element.js';
import {listen} from './keys.js';

/**
 * Listens to all of them.
 *
 * @param {import('./main.js').Page} page with `setCamera`, `toggleCompare`, `savePicture` and `toggleFilm`
 * @param {object} parts of it: transport, controls, look, runs, theme, presentation; openAbout
 */
export function listenToShortcuts(page, {transport, controls, look, runs, theme, presentation, openAbout}) {
  listen([
    [' ', 'run or pause', () => transport.toggleRun()],
    ['.', 'one frame', () => transport.step()],
    ['r', 'back to the start', () => transport.reset()],
    [['+', '-'], 'faster, slower', key => transport.moveRate(key === '+' ? 1 : -1)],
    [['1', '2', '3', '4'], 'camera: follow, side, top, free', key => page.setCamera(CAMERAS[Number(key) - 1])],
    ['v', 'vacuum, water', () => controls.toggleVacuum()],
    ['w', 'water: spheres, surface, vorticity, velocity, pressure, vortices, none', () => look.next('water')],
    ['n', 'plane through the water: level, along, across', () => look.next('plane')],
    ['c', 'colour: speed, density, mass, nothing', () => look.next('colour')],
    ['k', 'body: skin, particles', () => look.next('body')],
    ['x', 'cut the water open at the body', () => look.toggle('cut')],
    ['m', 'muscles', () => look.toggle('muscles')],
    ['t', 'trace of the spine', () => look.toggle('trace')],
    ['y', 'dye from the tail', () => look.toggle('dye')],
    ['u', 'pressure on the body', () => look.toggle('pressure')],
    ['o', 'forces on the body', () => look.toggle('forces')],
    ['b', 'two swimmers side by side', () => page.toggleCompare()],
    [['[', ']'], 'generation before, after', key => runs.move(key === ']' ? 1 : -1)],
    ['d', 'light, dark', () => theme.toggle()],
    ['p', 'presentation: the picture alone', () => presentation.toggle()],
    ['i', 'save the picture', () => page.savePicture()],
    ['f', 'film: record, save', () => page.toggleFilm()],
    ['a', 'about this', () => openAbout()],
    ['?', 'this list', () => byId('help').showModal()],
  ]);
}
