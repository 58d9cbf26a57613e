package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.base.MergePatch;
import io.natator.body.Swimmer;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.RunReader;
import io.natator.cli.Section.Topic;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.config.Preset;
import io.natator.config.Scheme;
import io.natator.process.SceneInfo;
import io.natator.stream.StreamOptions;
import io.natator.stream.StreamProcess;
import io.natator.view.InitialScene;
import io.natator.view.ViewServer;
import io.natator.view.ViewSettings;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.lang.ProcessBuilder.Redirect;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator view}: shows a scene live in the browser, until it is told to end. */
@Command(name = "view", mixinStandardHelpOptions = true,
        description = {"Shows a scene live in the browser, and any run's best gaits.",
                "Ends with Ctrl-C. Only this machine can reach it unless --host is given."},
        footer = {"", "Examples:",
                "  natator view --creature 2",
                "  natator view --run runs/one --run runs/two"})
final class ViewCommand implements Callable<Integer> {

    private static final Logger LOG = LoggerFactory.getLogger(ViewCommand.class);

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneChoice choice;

    @Mixin
    private SceneChanges sceneOptions;

    @Mixin
    private SimulatorOption simulator;

    @Section(Topic.SCENE)
    @Option(names = "--gait", paramLabel = "FILE", description = "A JSON file with a gait, or a run's best.json. "
            + "Default: the best gait of the first run in the scene, else what the thesis published for the creature.")
    private Path gait;

    @Section(Topic.SCENE)
    @Option(names = "--run", paramLabel = "DIR", description = "A run folder to be looked at; may be repeated. "
            + "Without a scene, its own is shown; of a chosen creature, that of its first run.")
    private List<Path> runs = List.of();

    @Section(Topic.SCENE)
    @Option(names = "--policy", paramLabel = "FILE",
            description = "A policy that was learned, which drives the swimmer in "
                    + "its own scene (sim-native/python/README.md).")
    private Path policy;

    @Section(Topic.PAGE)
    @Option(names = "--port", paramLabel = "N", defaultValue = "" + ViewServer.DEFAULT_PORT,
            description = "Where to listen; 0 for any port that is free. Default: ${DEFAULT-VALUE}.")
    private int port;

    @Section(Topic.PAGE)
    @Option(names = "--host", paramLabel = "HOST", defaultValue = ViewSettings.LOOPBACK,
            description = "Name or address to listen at; 0.0.0.0 for all of this machine's. Who can reach it can start "
                    + "simulations. Default: ${DEFAULT-VALUE}.")
    private String host;

    @Section(Topic.PAGE)
    @Option(names = "--no-browser", description = "Only print the address.")
    private boolean noBrowser;

    @Override
    public Integer call() throws InterruptedException {
        if (port < 0 || port > 65535) {
            throw new InvalidInputException("--port is " + port + "; expected a whole number from 0 to 65535");
        }
        Path program = simulator.path();
        if (!runs.isEmpty()) {
            RejectRepeated.checkFolders("--run", runs);
        }
        ViewSettings settings = new ViewSettings(program, host, port,
                policy == null ? start(program) : learned(program),
                ThesisGaits::in, runs, policy);
        CountDownLatch told = new CountDownLatch(1);
        PrintWriter out = spec.commandLine().getOut();
        ShutdownHandler shutdown = new ShutdownHandler(told::countDown, null, () -> {
        });
        try (ViewServer server = new ViewServer(settings)) {
            if (server.isOpenToOthers()) {
                PrintWriter err = spec.commandLine().getErr();
                err.println("warning: --host " + host + ": whoever can reach this address can watch, and start up to "
                        + ViewServer.MAX_SIMULATIONS + " simulations on this machine; nobody is asked who they are");
                err.flush();
            }
            out.println(server.address());
            out.flush();
            if (!noBrowser) {
                open(server.address());
            }
            told.await();
        } finally {
            shutdown.close();
        }
        return ExitCode.OK;
    }

    private InitialScene start(Path program) throws InterruptedException {
        String scene = runs.isEmpty() || choice.isGiven() ? choice.scene(spec) : null;
        return start(scene, shownRun(), program);
    }

    /** The scene that a policy was learned in. */
    private InitialScene learned(Path program) throws InterruptedException {
        if (gait != null || choice.isGiven()) {
            throw new InvalidInputException(
                    "--policy has its own scene and gait; expected no --scene, --creature or --gait");
        }
        JsonNode environment = Json.read(policy, JsonNode.class, "--policy").path("environment");
        if (!environment.path("scene").isTextual()) {
            throw new InvalidInputException(
                    "--policy: " + policy + ": must have an environment with the scene that it was learned in");
        }
        InitialScene start = new InitialScene(environment.path("scene").asText(), InitialScene.patch(
                MergePatch.both(environment.get("overrides"), sceneOptions.overrides()), sceneOptions.scheme()), null);
        check(start, program);
        return start;
    }

    /** The first run of the scene or creature that was chosen, or the first one if none was; null without any. */
    private Path shownRun() {
        for (Path folder : runs) {
            if (choice.admits(SceneOptions.scene("scene of " + folder, RunReader.settings(folder).problem().scene()))) {
                return folder;
            }
        }
        return null;
    }

    /**
     * A run's best gait in its scene; without a run, or beside runs of other scenes, the scene that was chosen.
     *
     * @param scene that was chosen; null if the runs tell it
     * @param run   of it, or null
     */
    private InitialScene start(String scene, Path run, Path program) throws InterruptedException {
        Swimmer given = gait == null ? null : GaitFile.read(gait);
        if (run != null) {
            return start(RunReader.settings(run), given, RunReader.best(run), program);
        }
        choice.checkCreature(Preset.THESIS, program);
        Swimmer swimmer = given != null ? given : new Swimmer(ThesisGaits.in(scene), null);
        ObjectNode overrides = InitialScene.patch(MergePatch.both(swimmer.body(), sceneOptions.overrides()),
                sceneOptions.scheme());
        SceneInfo info = SceneInfo.of(scene, overrides, program);
        boolean fits = swimmer.gait() != null && swimmer.gait().amplitude().size() == info.actuators();
        InitialScene start = new InitialScene(scene, overrides, fits || given != null ? swimmer.gait() : null);
        if (given != null) {
            check(start, program);
        }
        return start;
    }

    /** Before the page opens, where it would only be told that the simulator refuses it. */
    private void check(InitialScene start, Path program) throws InterruptedException {
        try {
            StreamProcess.check(program,
                    StreamOptions
                            .live(start.scene(), start.overrides(),
                                    start.gait() == null ? null : Json.tree(start.gait()), true)
                            .withPolicy(policy));
        } catch (IOException e) {
            throw new UncheckedIOException("scene " + start.scene() + " cannot be shown: " + e.getMessage(), e);
        }
    }

    /** Opens an address in the user's browser, where there is a screen and a browser; else the user has to. */
    private static void open(URI address) {
        boolean mac = System.getProperty("os.name").startsWith("Mac");
        if (mac || System.getenv("DISPLAY") != null || System.getenv("WAYLAND_DISPLAY") != null) {
            try {
                new ProcessBuilder(mac ? "open" : "xdg-open", address.toString())
                        .redirectOutput(Redirect.DISCARD).redirectError(Redirect.DISCARD).start();
            } catch (IOException e) {
                LOG.debug("no browser opened", e);
            }
        }
    }

    private InitialScene start(EvolutionSettings run, Swimmer given, BestGait best, Path program)
            throws InterruptedException {
        Scheme scheme = sceneOptions.scheme() != null ? sceneOptions.scheme() : run.problem().scheme();
        Swimmer swimmer = given != null ? given : best != null ? best.swimmer() : new Swimmer(null, null);
        ObjectNode overrides = InitialScene.patch(
                MergePatch.both(MergePatch.both(run.problem().overrides(), swimmer.body()), sceneOptions.overrides()),
                scheme);
        InitialScene start = new InitialScene(run.problem().scene(), overrides, swimmer.gait());
        if (given != null) {
            check(start, program);
        } else if (sceneOptions.overrides() != null) {
            SceneInfo.of(run.problem().scene(), overrides, program);
        }
        return start;
    }
}
