/** A simulator inside the page, in place of a socket to one: in a worker, or where there can be none in the page's own thread. */

/** Runs a script in the page itself, a frame of the simulation at a time. */
async function portInPage(script) {
  await new Promise((resolve, reject) => {
    const element = document.createElement('script');
    element.onload = resolve;
    element.onerror = () => reject(new Error('the simulator cannot be loaded'));
    element.src = script;
    document.head.append(element);
  });
  const {port1, port2} = new MessageChannel();
  serveSolver(port2);
  return port1;
}

/** As much of a WebSocket as `Connection` uses. */
export class SolverSocket {
  #port = null;
  readyState = WebSocket.CONNECTING;
  onopen = () => {};
  onmessage = _event => {};
  onclose = _event => {};

  /**
   * @param {string} script address of the simulator's script: what emscripten makes, and solver-worker.js behind it
   * @param {ArrayBuffer} module WebAssembly
   * @param {boolean} isInPage whether it is to run without a worker
   */
  constructor(script, module, isInPage) {
    if (isInPage) {
      this.#openInPage(script, module);
      return;
    }
    try {
      const worker = new Worker(script);
      worker.onerror = event => {
        event.preventDefault();
        worker.terminate();
        this.#failed(event.message, script, module);
      };
      this.#use(worker, module);
    } catch (error) {
      this.#failed(error.message, script, module);
    }
  }

  /** A worker that never answered is not allowed here; another has come to an end. */
  #failed(reason, script, module) {
    if (this.readyState === WebSocket.CONNECTING) {
      this.#openInPage(script, module);
    } else {
      this.readyState = WebSocket.CLOSED;
      this.onclose({reason: reason || 'the simulator ended'});
    }
  }

  #openInPage(script, module) {
    portInPage(script).then(port => this.#use(port, module), error => {
      this.readyState = WebSocket.CLOSED;
      this.onclose({reason: error.message});
    });
  }

  #use(port, module) {
    this.#port = port;
    port.onmessage = ({data}) => {
      if (data === 'ready') {
        this.readyState = WebSocket.OPEN;
        this.onopen();
      } else {
        this.onmessage({data});
      }
    };
    port.postMessage(module);
  }

  send(text) {
    this.#port.postMessage(text);
  }

  close() {
    this.readyState = WebSocket.CLOSED;
    this.#port?.terminate?.();
    this.onclose({reason: ''});
  }
}
