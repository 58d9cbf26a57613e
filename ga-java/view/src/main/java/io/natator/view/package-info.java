/**
 * {@code natator view}: a scene that swims in the browser. Serves the page, what it asks for, and running simulators.
 *
 * <table>
 * <caption>What is served</caption>
 * <tr><td>{@code /}, {@code /app/NAME}<td>the page and its modules
 * <tr><td>{@code /three/NAME}, {@code /three/addons/NAME}<td>three.js, from its WebJar
 * <tr><td>{@code /api/setup}<td>{@code SetupResponse}
 * <tr><td>{@code /api/runs/ID}<td>{@code RunResponse}
 * <tr><td>{@code /stream}<td>a WebSocket, which is one simulator
 * </table>
 *
 * <p>Up the socket go the commands of {@code sim-native/protocol/stream.md}, each a text; first, to start the simulator,
 * {@code {"do":"start","scene":…,"overrides":…,"gait":…,"options":{"paused":false}}}. Down come {@code FRAM} bodies as
 * binary messages, and texts {@code {"type":…,"body":…}}: {@code SCEN}, {@code ANSW} and {@code STOP} as the simulator
 * sends them, and {@code LOST} with {@code reason} and {@code restarted} when the simulator has died. If it was restarted, it is on the
 * same scene again, from the start and without credit; else {@code start} is to come again.
 */
package io.natator.view;
