/** Controls of who swims and in what: scene, scheme, vacuum, gait and the solver's settings. */

import {byId, fillSelect} from './element.js';
import {GaitControls, isAtRest, parseGait, randomGait, waveGait} from './gait.js';
import {errorOf} from './live.js';
import {download, fileName, gaitText, sceneText} from './save.js';
import {SolverControls, withoutSettings} from './solver.js';

/** Those of the chosen view. */
export class SwimControls {
  #page;
  #setup;
  #gait;
  #solver;
  #vacuumBusy = false;

  /**
   * @param {import('./main.js').Page} page with the chosen `view` and `showControls`
   * @param {object} setup what the server can do: schemes, scenes, gaits
   */
  constructor(page, setup) {
    this.#page = page;
    this.#setup = setup;
    this.#gait = new GaitControls(gait => this.#view.setGait(gait));
    this.#solver = new SolverControls((key, patch) => this.#view.setOverrides(key, patch));
    fillSelect(byId('scheme'), setup.schemes.map(scheme => [scheme, scheme]));
    this.#listen();
  }

  get #view() {
    return this.#page.view;
  }

  /** Shows what is set for the chosen view, once it has a scene. */
  show() {
    const {scene, isVacuum} = this.#view;
    const names = this.#setup.scenes.includes(scene.scene) ? this.#setup.scenes : [scene.scene, ...this.#setup.scenes];
    if (byId('scene').options.length !== names.length) {
      fillSelect(byId('scene'), names.map(name => [name, name]));
    }
    byId('scene').value = scene.scene;
    byId('scheme').value = scene.scheme;
    if (!this.#vacuumBusy) {
      byId('vacuum').checked = isVacuum;
    }
    this.#gait.show(scene);
    this.#solver.show(scene);
    byId('gait-save').disabled = scene.gait === null;
    byId('gait-random').disabled = scene.actuators === 0;
    byId('gait-load').disabled = scene.actuators === 0;
  }

  toggleVacuum() {
    return this.#changeVacuum(!this.#view.isVacuum);
  }

  #listen() {
    const click = (id, action) => byId(id).addEventListener('click', action);
    const change = (id, action) => byId(id).addEventListener('change', action);
    change('scene', () => this.#changeScene(byId('scene').value));
    change('scheme', () => this.#changeScheme(byId('scheme').value));
    change('vacuum', () => this.#changeVacuum(byId('vacuum').checked));
    click('scene-save', () => download(fileName(this.#view.scene, 'scene'), sceneText(this.#view.scene)));
    click('gait-save', () => download(fileName(this.#view.scene, 'gait'), gaitText(this.#view.scene)));
    click('gait-load', () => byId('gait-file').click());
    click('gait-random', async () => {
      byId('gait-error').textContent = errorOf(await this.#view.setGait(randomGait(this.#view.scene.actuators))) ?? '';
    });
    click('solver-default', async () => {
      const {scene, overrides, gait} = this.#view.scene;
      byId('solver-error').textContent = await this.#view.setScene(scene, withoutSettings(overrides), gait) ?? '';
    });
    change('gait-file', () => {
      const input = byId('gait-file');
      if (input.files.length > 0) {
        this.#loadGait(input.files[0]);
        input.value = '';
      }
    });
  }

  async #changeScene(name) {
    const scheme = this.#view.scene?.overrides?.scheme;
    const overrides = scheme === undefined ? null : {scheme};
    const error = await this.#view.setScene(name, overrides, null);
    byId('scene-error').textContent = error ?? '';
    if (error === null && isAtRest(this.#view.scene)) {
      this.#view.setGait(this.#setup.gaits?.[name] ?? waveGait(this.#view.scene.actuators));
    }
  }

  async #changeVacuum(isVacuum) {
    this.#vacuumBusy = true;
    const error = await this.#view.setVacuum(isVacuum);
    this.#vacuumBusy = false;
    byId('scene-error').textContent = error ?? '';
    this.#page.showControls();
  }

  async #changeScheme(scheme) {
    byId('scene-error').textContent = errorOf(await this.#view.setOverrides('scheme', {scheme})) ?? '';
    this.#page.showControls();
  }

  async #loadGait(file) {
    try {
      byId('gait-error').textContent = errorOf(await this.#view.setGait(parseGait(await file.text()))) ?? '';
    } catch (error) {
      byId('gait-error').textContent = `${file.name}: ${error.message}`;
    }
  }
}
