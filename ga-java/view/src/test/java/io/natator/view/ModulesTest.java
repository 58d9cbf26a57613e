package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.microsoft.playwright.Route;
import io.natator.replay.Replay;
import io.natator.replay.ReplayHtml;
import io.natator.replay.ReplayRecorder;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** What the page's modules compute, each called by itself in a real browser. */
@Timeout(value = 30, unit = TimeUnit.MINUTES)
class ModulesTest extends BrowserTest {

    @TempDir
    private Path folder;
    private String own;
    private static ViewServer server;

    @BeforeAll
    static void start() throws InterruptedException {
        server = ViewFixture.server();
    }

    @AfterAll
    static void stop() {
        server.close();
    }

    @Override
    boolean isOwn(URI address) {
        return address.getScheme().matches("blob|data") || address.toString().contains(own);
    }

    /** Runs a function of JavaScript that is given the module, where nothing else runs. */
    private Object with(String module, String function) {
        own = server.address().getAuthority();
        page.route("**/favicon.ico", route -> route.fulfill(new Route.FulfillOptions().setStatus(204)));
        page.navigate(server.address().resolve("/app/theme.css").toString());
        return page.evaluate("async () => (" + function + ")(await import('/app/" + module + "'))");
    }

    @SuppressWarnings("unchecked")
    private static List<Number> numbers(Object list) {
        return (List<Number>) list;
    }

    @Test
    void aMotionIsNamedAfterAFishOnlyIfItIsLikeOne() {
        Object said = with("livecharts.js", """
                ({likeness}) => [null, 'thunniform'].map(nearest => likeness(
                    {nearest, modes: [{name: 'anguilliform', e: 0.31}, {name: 'thunniform', e: 0.12}]})).join('; ')""");

        assertThat(said).isEqualTo("like none; e 0.12");
    }

    @Test
    void anUnstableSwimTellsTheLawThatItBroke() {
        Object told = with("protocol.js", """
                ({stopText}) => [{reason: 'unstable', time: 1.5, particle: 7, stage: 'frame', law: 'tank'},
                    {reason: 'unstable', time: 0.25, particle: 3, stage: 'springs'}, {reason: 'until'}].map(stopText).join(' ')""");

        assertThat(told).isEqualTo("Became unstable at 1.50 s (broke law tank, particle 7, frame). Reset to go on. "
                + "Became unstable at 0.25 s (particle 3, springs). Reset to go on. Came to its end.");
    }

    /** What steers a gait is a part of it: in files, where gaits are told apart, and of one that is still. */
    @Test
    void aGaitHasAnOffset() {
        Object told = with("gait.js", """
                ({parseGait, isSameGait, isAtRest}) => {
                  const left = {frequency: 1, amplitude: [0, 0], phase: [0, 0], offset: [0.2, 0.2]};
                  const right = {...left, offset: [-0.2, -0.2]};
                  const straight = {frequency: 1, amplitude: [0, 0], phase: [0, 0]};
                  let refused = '';
                  try { parseGait(JSON.stringify({...left, offset: 0.2})); } catch (error) { refused = error.message; }
                  return JSON.stringify([parseGait(JSON.stringify({gait: left})), isSameGait(left, {...left}), isSameGait(left, right),
                    isSameGait(left, straight), isSameGait(straight, {...straight, offset: [0, 0]}), isAtRest({actuators: 2, gait: left}),
                    isAtRest({actuators: 2, gait: straight}), refused]);
                }""");

        assertThat(told).isEqualTo("[{\"frequency\":1,\"amplitude\":[0,0],\"phase\":[0,0],\"offset\":[0.2,0.2]},true,false,false,true,"
                + "false,true,\"offset: expected a list of numbers, one for each actuator, or none\"]");
    }

    @Test
    void aFrameIsReadByteForByte() {
        Object read = with("protocol.js", """
                ({decodeFrame, sceneNumber}) => {
                  const scene = {particles: 2, actuators: 1, fields: ['position', 'velocity', 'density']};
                  const buffer = new ArrayBuffer(72 + 4 + 4 * 14);
                  const view = new DataView(buffer);
                  [3, 250, 7, 3].forEach((value, i) => view.setUint32(4 * i, value, true));
                  [1.25, 0.008, -0.5].forEach((value, i) => view.setFloat64(16 + 8 * i, value, true));
                  for (let i = 0; i < 7; i++) view.setFloat32(40 + 4 * i, 10 + i, true);
                  for (let i = 0; i < 15; i++) view.setFloat32(72 + 4 * i, 100 + i, true);
                  const frame = decodeFrame(buffer, scene);
                  let refused = '';
                  try { decodeFrame(buffer.slice(4), scene); } catch (error) { refused = error.message; }
                  return JSON.stringify([sceneNumber(buffer), frame.frame, frame.dropped, frame.running, frame.touching,
                    frame.time, frame.wallTime, frame.distance, [...frame.velocity], frame.momentum, frame.angularMomentum,
                    frame.densityMean, frame.densityMax, [...frame.activation], [...frame.position], [...frame.velocities],
                    [...frame.density], refused]);
                }""");

        assertThat(read).isEqualTo("[3,250,7,true,true,1.25,0.008,-0.5,[10,11,12],13,14,15,16,[100],"
                + "[101,102,103,104,105,106],[107,108,109,110,111,112],[113,114],\"frame has 128 bytes; expected 132\"]");
    }

    /** A tank without ends along x is shown around the body, and not where it is cut off; its walls along z are. */
    @Test
    void aPeriodicTankGoesAlongWithItsBody() {
        Object shown = with("scene.js", """
                ({boundsAround, tankBounds, tankLines}) => {
                  const scene = {planes: [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, -1, 1]], periodic: {x: [0, 2]}, body: [0], solidRestDistance: 0.5};
                  const start = tankBounds(scene, [0.5, 0.5, 0.5, 1.5, 0.25, 0.25]);
                  const later = boundsAround(start, scene, [4.5, 0.5, 0.5, 5.5, 0.25, 0.25]);
                  const walled = tankBounds({...scene, planes: [...scene.planes, [1, 0, 0, 0], [-1, 0, 0, 2]], periodic: {}}, [0.5, 0.5, 0.5]);
                  return JSON.stringify([start.min, start.max, later.min, later.max, tankLines(later).edges, tankLines(walled).edges.length / 6,
                    tankBounds({...scene, body: []}, [0.5, 0.5, 0.5]).min]);
                }""");

        assertThat(shown).isEqualTo("[[-0.5,0,0],[1.5,1,1],[3.5,0,0],[5.5,1,1],"
                + "[3.5,0,1,5.5,0,1,3.5,1,1,5.5,1,1,5.5,0,0,3.5,0,0,5.5,1,0,3.5,1,0],12,[0,0,0]]");
    }

    @Test
    void axesEndOnRoundNumbers() {
        Object axes = with("scaling.js", """
                ({axis, axisText, niceStep}) => JSON.stringify([axis(0, 0.93, 3), axis(-0.2, 7, 4), axis(2, 2), niceStep(0.0021),
                  axisText(0.25, 0.05), axisText(1e-12, 0.5), axisText(40, 20)])""");

        assertThat(axes).isEqualTo("[{\"low\":0,\"high\":1,\"step\":0.5,\"marks\":[0,0.5,1]},"
                + "{\"low\":-2,\"high\":8,\"step\":2,\"marks\":[-2,0,2,4,6,8]},"
                + "{\"low\":2,\"high\":2.5,\"step\":0.5,\"marks\":[2,2.5]},0.005,\"0.25\",\"0.0\",\"40\"]");
    }

    /** Equal steps of value are equal steps of colour as people see it, but where a scale turns to the next of its stops. */
    @Test
    void coloursAreEven() {
        List<Number> uneven = numbers(with("colours.js", """
                ({SCALES}) => Object.values(SCALES).map(scale => {
                  const steps = scale.slice(1).map((colour, i) => Math.hypot(...colour.map((value, k) => value - scale[i][k])));
                  return steps.filter(step => step < 0.97 * Math.max(...steps)).length;
                })"""));

        assertThat(uneven).hasSize(2).allSatisfy(count -> assertThat(count.intValue()).isLessThanOrEqualTo(3));
        assertThat(with("colours.js", "({SCALES}) => SCALES.sequential.every((one, i, all) => i === 0 || one[0] > all[i - 1][0])"))
                .as("lighter and lighter").isEqualTo(true);
    }

    /** The front cluster is moved up by 3; the rear one turned by a right angle about z, and moved by 5 along x. */
    @Test
    void aSkinFollowsTheRigidMotionOfItsClusters() {
        List<Number> places = numbers(with("skin.js", """
                ({SkinMotion}) => {
                  const rest = [[1, 0, 0], [2, 0, 0], [1, 1, 0], [1, 0, 1], [-1, 0, 0], [-2, 0, 0], [-1, 1, 0], [-1, 0, 1]];
                  const motion = new SkinMotion({body: [8, 1, 2, 3, 4, 5, 6, 7], clusters: [[8, 1, 2, 3], [4, 5, 6, 7]], skin: {
                    triangles: [[0, 1, 2]], vertices: [[2, 0, 0], [0, 0.5, 0], [-2, 0, 1]], cluster: [0, 0, 1], share: [1, 0.25, 1], rest}});
                  const position = new Float32Array(27);
                  rest.forEach(([x, y, z], i) => position.set(i < 4 ? [x, y + 3, z] : [5 - y, x, z], 3 * (i || 8)));
                  motion.update({position});
                  return [...motion.places].map(place => Math.round(1e4 * place) / 1e4 + 0);
                }"""));

        assertThat(places.stream().map(Number::doubleValue)).containsExactly(2.0, 3.0, 0.0, 3.375, 0.875, 0.0, 5.0, -2.0, 1.0);
    }

    /** A block of 6 × 6 × 6 particles, 1 apart: closed, as seen from outside, and about a block of 6³. */
    @Test
    void aSurfaceIsClosedAroundItsParticles() {
        List<Number> surface = numbers(with("body-surface.js", """
                ({surfaceAround}) => {
                  const places = Array.from({length: 216}, (_, i) => [i % 6, Math.floor(i / 6) % 6, Math.floor(i / 36)]);
                  const {vertices, triangles} = surfaceAround(places, 1);
                  const edges = new Map();
                  let volume = 0;
                  for (let i = 0; i < triangles.length; i += 3) {
                    const [a, b, c] = [0, 1, 2].map(k => vertices.subarray(3 * triangles[i + k], 3 * triangles[i + k] + 3));
                    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                        + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
                    for (let k = 0; k < 3; k++) {
                      const [from, to] = [triangles[i + k], triangles[i + (k + 1) % 3]];
                      edges.set(`${from} ${to}`, (edges.get(`${from} ${to}`) ?? 0) + 1);
                      edges.set(`${to} ${from}`, (edges.get(`${to} ${from}`) ?? 0) - 1);
                    }
                  }
                  return [volume, [...edges.values()].filter(count => count !== 0).length, triangles.length];
                }"""));

        assertThat(surface.get(0).doubleValue()).as("volume").isBetween(180.0, 240.0);
        assertThat(surface.get(1).intValue()).as("edges without a second triangle").isZero();
        assertThat(surface.get(2).intValue()).isGreaterThan(1000);
    }

    /** The body of the test turns by a right angle about z and moves: so does each vertex of its skin. */
    @Test
    void aSkinWithoutAMeshFollowsItsParticles() {
        Object off = with("body-skin.js", """
                ({BodySkin}) => {
                  const at = (i, turned) => {
                    const [x, y, z] = [0.1 * (i % 9), 0.1 * (Math.floor(i / 9) % 3), 0.1 * Math.floor(i / 27)];
                    return turned ? [5 - y, x, z] : [x, y, z];
                  };
                  const frame = turned => ({position: Float32Array.from(Array.from({length: 81}, (_, i) => at(i, turned)).flat())});
                  const all = Array.from({length: 81}, (_, i) => i);
                  const scene = {particles: 81, fluid: [81, 0], body: all, slices: Array.from({length: 9}, (_, s) =>
                      all.filter(i => i % 9 === s)), bodyLength: 0.8, solidRestDistance: 0.2,
                      clusters: [all.filter(i => i % 9 < 5), all.filter(i => i % 9 >= 4)]};
                  const skin = new BodySkin(scene, frame(false).position);
                  const before = Float32Array.from(skin.places);
                  skin.update(frame(true));
                  let off = 0;
                  for (let i = 0; i < before.length; i += 3) {
                    off = Math.max(off, Math.hypot(skin.places[i] - (5 - before[i + 1]), skin.places[i + 1] - before[i],
                        skin.places[i + 2] - before[i + 2]));
                  }
                  return [before.length, off];
                }""");

        assertThat(numbers(off).get(0).intValue()).isGreaterThan(300);
        assertThat(numbers(off).get(1).doubleValue()).as("farthest off, length").isLessThan(1e-4);
    }

    /** A block of water 12 wide and 6 high between walls: what is inside has no shape, what is above is flat. */
    @Test
    void waterIsFlatAtItsSurfaceAndRoundAtItsWalls() {
        Object shapes = with("water-shape.js", """
                async ({WaterShapes}) => {
                  const {SHAPE_NUMBERS} = await import('/app/water-numbers.js');
                  const count = 12 * 6 * 12 + 1;
                  const position = new Float32Array(3 * count);
                  for (let i = 0; i + 1 < count; i++) {
                    position.set([0.05 + 0.1 * (i % 12), 0.05 + 0.1 * (Math.floor(i / 12) % 6), 0.05 + 0.1 * Math.floor(i / 72)], 3 * i);
                  }
                  position.set([0.6, 2, 0.6], 3 * (count - 1));
                  const shapes = new WaterShapes();
                  shapes.setScene({fluidRestDistance: 0.1, definition: {solver: {gravity: [0, -10, 0]}}});
                  shapes.update(position, null, 0, Uint32Array.from({length: count}, (_, i) => i), count, new Float32Array(count),
                      {min: [0, 0, 0], max: [1.2, 1e9, 1.2]});
                  const found = [];
                  for (let i = 0; i < shapes.count; i++) {
                    found.push(Array.from(shapes.numbers.subarray(SHAPE_NUMBERS * i, SHAPE_NUMBERS * (i + 1))));
                  }
                  const near = (x, y, z) => found.find(one => Math.hypot(one[0] - x, one[1] - y, one[2] - z) < 0.06);
                  const [top, inside, side, alone] = [near(0.55, 0.53, 0.55), near(0.55, 0.25, 0.55), near(0.05, 0.25, 0.55),
                      near(0.6, 2, 0.6)];
                  return JSON.stringify([top[5] < 0.5 * top[4], Math.abs(top[4] / top[6] - 1) < 0.05, inside === undefined,
                    side[4] === side[5], alone[4] < 0.25 * side[4]]);
                }""");

        assertThat(shapes).as("flat on top, alike along both walls, nothing inside, a ball at the wall, small alone")
                .isEqualTo("[true,true,true,true,true]");
    }

    /** Balls of a surface whose heights vary by chance, at a wall; the rough line is that of the balls where the wall cuts them. */
    @Test
    void waterEndsAtAWallInASmoothLine() {
        Object told = with("waterline.js", """
                ({Waterline}) => {
                  const spacing = 0.1;
                  const size = 12;
                  const walls = {min: [0, 0, 0], max: [1, 1e9, 4]};
                  const shapes = [];
                  for (let i = 0, seed = 1; i < 40; i++) {
                    seed = seed * 16807 % 2147483647;
                    const height = 0.5 + 0.02 * Math.sin(i / 6) + 0.03 * seed / 2147483647;
                    shapes.push([0.05, height, 0.05 + 0.1 * i, 0, 0.009, 0.004, 0.009, 0, 0, 0, 0, 1]);
                  }
                  const splash = [0.02, 0.9, 2, 0, 0.001, 0.001, 0.001, 0, 0, 0, 0, 0];
                  const count = shapes.push(splash);
                  const numbers = new Float32Array(size * (count + Waterline.most(walls, spacing)));
                  numbers.set(shapes.flat());
                  const topAt = (z, first, end) => {
                    let top = 0;
                    for (let at = size * first; at < size * end; at += size) {
                      const share = 1 - numbers[at] ** 2 / numbers[at + 4] - (z - numbers[at + 2]) ** 2 / numbers[at + 6];
                      top = Math.max(top, share > 0 ? numbers[at + 1] + Math.sqrt(numbers[at + 5] * share) : 0);
                    }
                    return top;
                  };
                  const roughness = (first, end) => {
                    let sum = 0;
                    for (let z = 0.4; z < 3.6; z += 0.05) {
                      sum += Math.abs(topAt(z - 0.05, first, end) - 2 * topAt(z, first, end) + topAt(z + 0.05, first, end));
                    }
                    return sum;
                  };
                  const before = roughness(0, count - 1);
                  const all = new Waterline().add(numbers, count, walls, spacing);
                  const after = roughness(count, all);
                  let highest = 0;
                  let farthest = 0;
                  for (let z = 0.4; z < 3.6; z += 0.05) {
                    highest = Math.max(highest, topAt(z, count, all));
                    farthest = Math.max(farthest, topAt(z, 0, count - 1) - topAt(z, count, all));
                  }
                  const endless = new Waterline().add(numbers, count, {min: [-1e9, 0, -1e9], max: [1e9, 1e9, 1e9]}, spacing);
                  return JSON.stringify([after < 0.2 * before, highest < 0.64, farthest < 0.02, endless === count, all <= numbers.length / size]);
                }""");

        assertThat(told).as("smooth, not as high as a splash, nowhere far below; none without walls; no more than promised")
                .isEqualTo("[true,true,true,true,true]");
    }

    @Test
    void theNearestComesFirst() {
        Object order = with("sort.js", """
                ({NearestFirst}) => {
                  const position = new Float32Array([9, 9, 9,  0, 0, 5,  0, 0, 1,  0, 0, 3,  0, 0, -2]);
                  const sorted = new NearestFirst();
                  const left = sorted.sort(position, 1, 4, {x: 0, y: 0, z: 0}, {x: 0, y: 0, z: 1}, 0);
                  return [...sorted.order.subarray(0, left)].join();
                }""");

        assertThat(order).as("counted from the second; the last lies behind").isEqualTo("1,2,0");
    }

    @Test
    void detailIsGivenUpOnlyWhereThatHelps() {
        Object shares = with("quality.js", """
                ({Quality}) => {
                  const after = (quality, rate, seconds, cost, from) => {
                    for (let i = 0; i < rate * seconds; i++) quality.drawn(from + i / rate, cost);
                    return quality.share;
                  };
                  const slow = new Quality();
                  const paused = new Quality();
                  after(paused, 60, 0.5, 9, 0);
                  paused.rest();
                  return [after(new Quality(), 60, 9, 9, 0), after(new Quality(), 30, 5, 2, 0), after(slow, 30, 2.1, 20, 0),
                    after(slow, 60, 9, 9, 2.1), after(new Quality(), 0.25, 9, 4000, 0), after(paused, 60, 0.5, 9, 60)];
                }""");

        List<Number> all = numbers(shares);
        assertThat(all.get(0).doubleValue()).as("fast enough").isEqualTo(1);
        assertThat(all.get(1).doubleValue()).as("slow, but not by drawing").isEqualTo(1);
        assertThat(all.get(2).doubleValue()).as("slow by drawing").isLessThan(1);
        assertThat(all.get(3).doubleValue()).as("fast again").isGreaterThan(all.get(2).doubleValue());
        assertThat(all.get(4).doubleValue()).as("seconds a picture").isLessThan(1);
        assertThat(all.get(5).doubleValue()).as("after a minute without pictures").isEqualTo(1);
    }

    @Test
    void speedIsTakenOverABeat() {
        List<Number> speeds = numbers(with("history.js", """
                ({History}) => {
                  const history = new History();
                  const add = (time, distance) => history.add({time, distance, velocity: [3, 0, 0], momentum: 0,
                    angularMomentum: 0, densityMean: 0.01, densityMax: 0.02}, 1.5, 2);
                  for (let i = 0; i <= 60; i++) add(i / 60, 0.6 * (i / 60) + 0.1 * Math.sin(4 * Math.PI * i / 60));
                  const speeds = [history.last('beatSpeed'), history.last('speed'), history.last('densityMean'), history.length];
                  add(0, 0);
                  return [...speeds, history.length];
                }"""));

        assertThat(speeds.get(0).doubleValue()).isCloseTo(0.4, within(1e-9));
        assertThat(speeds.get(1).doubleValue()).isEqualTo(2);
        assertThat(speeds.get(2).doubleValue()).isEqualTo(1);
        assertThat(speeds.subList(3, 5)).extracting(Number::intValue).containsExactly(61, 1);
    }

    /** From the simulator through the packed file into the browser. */
    @Test
    void aReplayShowsThePlacesThatWereSimulated() throws InterruptedException {
        Replay swim = new ReplayRecorder(ViewFixture.SIMULATOR)
                .record("swim", StreamOptions.recording("thesis/creature-1", null, null, 0.25));
        Path file = folder.resolve("swim.html");
        ReplayHtml.Written written = new ReplayHtml("swim", List.of(swim), true).write(file, 10_000_000);
        own = file.toString();
        page.navigate(file.toUri().toString());
        await("window.natator && natator.time() > 0");
        page.getByTestId("play").click();

        for (int frame : new int[] {0, 7, 15}) {
            StreamFrame recorded = swim.frames().get(frame);
            page.evaluate("""
                    time => {
                      const scrub = document.getElementById('scrub');
                      scrub.value = time;
                      scrub.dispatchEvent(new Event('input'));
                    }""", recorded.time());
            await("Math.abs(natator.time() - " + recorded.time() + ") < 1e-6");

            List<Number> shown = numbers(page.evaluate("() => natator.position()"));

            assertThat(shown).hasSize(3 * swim.scene().particles());
            for (int i = 0; i < shown.size(); i++) {
                assertThat(shown.get(i).doubleValue()).isCloseTo(recorded.position()[i], within(1.05 * written.largestError()));
            }
        }
    }
}
