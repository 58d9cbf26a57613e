/** One socket, which is one simulator: commands up, scenes and frames down, again after a loss. */

import {decodeWater, isWater} from './protocol.js';

/** Frames that may be under way or waiting to be drawn. */
const CREDIT = 3;
const FIRST_RETRY_MS = 400;
const LAST_RETRY_MS = 8000;

/**
 * Calls `handlers`: status(state, text) with state connecting, open or lost; scene(SCEN), stop(STOP),
 * water(WATR), lost(LOST), saved(SAVED) if a scene's file was saved, refused(text) if what was to be shown cannot be.
 */
export class Connection {
  #openSocket;
  #handlers;
  #start;
  #socket = null;
  #waiting = new Map();
  /** Sends what was asked for while the connection was being opened. */
  #whenOpen = [];
  #nextId = 1;
  #granted = 0;
  #frames = [];
  /** @type {Scene|null} */
  #scene = null;
  #retryMs = FIRST_RETRY_MS;
  #timer = 0;
  #closed = false;

  /**
   * `start` gives the first command of each connection: what to show, as it was last set.
   *
   * @param {() => WebSocket} openSocket opens another socket
   */
  constructor(openSocket, start, handlers) {
    this.#openSocket = openSocket;
    this.#start = start;
    this.#handlers = handlers;
    this.#open();
  }

  /** Whether commands can be sent now. */
  get isOpen() {
    return this.#socket !== null && this.#socket.readyState === WebSocket.OPEN;
  }

  /**
   * Sends a command, after the start if the connection is only being opened.
   *
   * @returns {Promise<string|null>} the error that the simulator answers with, or null
   */
  send(command) {
    if (this.#socket?.readyState === WebSocket.CONNECTING) {
      return new Promise(resolve => this.#whenOpen.push(() => this.send(command).then(resolve)));
    }
    if (!this.isOpen) {
      return Promise.resolve('not connected');
    }
    const id = this.#nextId++;
    this.#socket.send(JSON.stringify({...command, id}));
    return new Promise(resolve => this.#waiting.set(id, resolve));
  }

  /** The oldest frame that has not been taken, or null. Taking it makes room for another. */
  takeFrame() {
    const frame = this.#frames.shift() ?? null;
    if (frame !== null) {
      this.#grant();
    }
    return frame;
  }

  /** Closes for good. */
  close() {
    this.#closed = true;
    clearTimeout(this.#timer);
    this.#socket?.close();
  }

  #open() {
    this.#handlers.status('connecting', 'connecting');
    const socket = this.#openSocket();
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.#opened();
    socket.onmessage = event => this.#received(event.data);
    socket.onclose = event => this.#lost(event.reason);
    this.#socket = socket;
  }

  #opened() {
    this.#retryMs = FIRST_RETRY_MS;
    this.begin();
    this.#sendWaiting();
    this.#handlers.status('open', 'connected');
  }

  /** Asks for what `start` gives; to be called again if that was refused. */
  begin() {
    this.#forgetFrames();
    const id = this.#nextId++;
    this.#waiting.set(id, error => error !== null && this.#handlers.refused(error));
    this.#socket.send(JSON.stringify({...this.#start(), id}));
    this.#grant();
  }

  #received(data) {
    if (typeof data !== 'string' && isWater(data)) {
      this.#handlers.water(decodeWater(data));
      return;
    }
    if (typeof data !== 'string') {
      this.#granted--;
      this.#frames.push(data);
      return;
    }
    const message = JSON.parse(data);
    switch (message.type) {
      case 'SCEN':
        this.#scened(message.body);
        break;
      case 'ANSW':
        this.#answered(message.body);
        break;
      case 'STOP':
        this.#handlers.stop(message.body);
        break;
      case 'LOST':
        this.#forgetFrames();
        this.#answerAll('the simulator was lost');
        this.#grant();
        this.#handlers.lost(message.body);
        break;
      case 'SAVED':
        this.#handlers.saved(message.body);
        break;
      default:
        console.warn('unknown message', message.type);
    }
  }

  /** One that goes on tells only what has changed; the frames before it are of the same particles. */
  #scened(body) {
    if (body.restarted) {
      this.#frames.length = 0;
      this.#grant();
    }
    this.#scene = body.restarted ? body : {...this.#scene, ...body};
    this.#handlers.scene(this.#scene);
  }

  #answered(answer) {
    const resolve = this.#waiting.get(answer.id);
    if (resolve !== undefined) {
      this.#waiting.delete(answer.id);
      resolve(answer.error ?? null);
    } else if (answer.error !== undefined) {
      console.warn(answer.error);
    }
  }

  #answerAll(error) {
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    waiting.forEach(resolve => resolve(error));
  }

  #sendWaiting() {
    this.#whenOpen.splice(0).forEach(send => send());
  }

  #lost(reason) {
    this.#forgetFrames();
    this.#sendWaiting();
    this.#answerAll('the connection was lost');
    if (this.#closed) {
      return;
    }
    const seconds = (this.#retryMs / 1000).toFixed(1);
    this.#handlers.status('lost', `${reason || 'no connection'}; again in ${seconds} s`);
    this.#timer = setTimeout(() => this.#open(), this.#retryMs);
    this.#retryMs = Math.min(2 * this.#retryMs, LAST_RETRY_MS);
  }

  #forgetFrames() {
    this.#frames.length = 0;
    this.#granted = 0;
  }

  #grant() {
    const room = CREDIT - this.#granted - this.#frames.length;
    if (room > 0 && this.isOpen) {
      this.#granted += room;
      this.#socket.send(`{"do":"credit","frames":${room}}`);
    }
  }
}
