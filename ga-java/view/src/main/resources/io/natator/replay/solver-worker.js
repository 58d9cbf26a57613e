/* global natatorLive, WorkerGlobalScope */

/**
 * Runs the simulator (sim-native/cli/live.cpp) for who holds the other end of a port. First comes the module (ArrayBuffer),
 * answered by 'ready'; then commands as text. Frames go back as ArrayBuffer, water so with its head, all else as text
 * {type, body}: as the server of natator view has them. Stands behind the script that emscripten makes, in a worker or in the page itself.
 */
function serveSolver(port) {
  let solver = null;
  let timer = 0;
  const soon = new MessageChannel();  // without the 4 ms of a timer
  soon.port1.onmessage = () => advance();

  function advance() {
    clearTimeout(timer);
    const wait = solver.ccall('natator_advance', 'number', [], []);
    if (wait >= 1) {
      timer = setTimeout(advance, wait);
    } else if (wait >= 0) {
      soon.port2.postMessage(null);
    }
  }

  function carryOut(command) {
    solver.ccall('natator_command', null, ['string'], [JSON.stringify(command)]);
  }

  /** What starts a process of natator view is here a scene that begins paused. */
  function start({scene, overrides, gait, id, options}) {
    carryOut({do: 'scene', scene, ...(overrides === null ? {} : {overrides}), ...(gait === null ? {} : {gait}), id});
    if (!options?.paused) {
      carryOut({do: 'run'});
    }
  }

  function give(bytes) {
    const type = String.fromCharCode(...bytes.subarray(0, 4));
    if (type === 'FRAM' || type === 'WATR') {
      const {buffer} = bytes.slice(type === 'FRAM' ? 8 : 0);
      port.postMessage(buffer, [buffer]);
    } else {
      port.postMessage(JSON.stringify({type, body: JSON.parse(new TextDecoder().decode(bytes.subarray(8)))}));
    }
  }

  async function receive(data) {
    if (data instanceof ArrayBuffer) {
      solver = await natatorLive({wasmBinary: data, thisProgram: '/bin/natator-live', message: give});
      port.postMessage('ready');
      return;
    }
    const command = JSON.parse(data);
    if (command.do === 'start') {
      start(command);
    } else {
      carryOut(command);
    }
    advance();
  }

  port.onmessage = ({data}) => receive(data).catch(error => port.postMessage({error: `the simulator ended: ${error.message}`}));
}

if (typeof WorkerGlobalScope !== 'undefined') {
  serveSolver(self);
}
