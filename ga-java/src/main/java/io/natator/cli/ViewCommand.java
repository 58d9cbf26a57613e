package io.natator.cli;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.simulator.SceneInfo;
import io.natator.study.thesis.ThesisData;
import io.natator.view.Start;
import io.natator.view.ViewServer;
import io.natator.view.ViewSettings;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator view}: shows a scene live in the browser, until it is told to end. */
@Command(name = "view", mixinStandardHelpOptions = true,
        description = {"Shows a scene live in the browser, and any run's best gaits.",
            "Ends with Ctrl-C. Only this machine can reach it unless --host is given."})
final class ViewCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneChoice choice;

    @Mixin
    private SimulatorOption simulator;

    @Option(names = "--scheme", paramLabel = "SCHEME",
            description = "How to solve: flex or conserving. Default: the scene's.")
    private Scheme scheme;

    @Option(names = "--gait", paramLabel = "FILE", description = "A JSON file with a gait, or a run's best.json. "
            + "Default: the run's best gait, else what the thesis published for the creature.")
    private Path gait;

    @Option(names = "--run", paramLabel = "DIR", description = "A run folder to be looked at; may be repeated. "
            + "Without a scene, its scene is shown.")
    private List<Path> runs = List.of();

    @Option(names = "--port", paramLabel = "N", defaultValue = "" + ViewServer.DEFAULT_PORT,
            description = "Where to listen; 0 for any port that is free. Default: ${DEFAULT-VALUE}.")
    private int port;

    @Option(names = "--host", paramLabel = "HOST", defaultValue = ViewSettings.LOOPBACK,
            description = "Name or address to listen at; 0.0.0.0 for all of this machine's. Who can reach it can start "
                    + "simulations. Default: ${DEFAULT-VALUE}.")
    private String host;

    @Option(names = "--no-browser", description = "Only print the address.")
    private boolean noBrowser;

    @Override
    public Integer call() throws InterruptedException {
        if (port < 0 || port > 65535) {
            throw new InvalidInputException("--port is " + port + "; expected a whole number from 0 to 65535");
        }
        Path program = simulator.path();
        ViewSettings settings = new ViewSettings(program, host, port, start(program), runs);
        CountDownLatch told = new CountDownLatch(1);
        PrintWriter out = spec.commandLine().getOut();
        BackgroundCheck check = null;
        Stopper stopper = new Stopper(told::countDown, null, () -> { });
        try (ViewServer server = new ViewServer(settings)) {
            out.println(server.address());
            out.flush();
            if (!noBrowser) {
                Browser.open(server.address());
            }
            check = showsStoredGait() ? new BackgroundCheck(runs.get(0), program, spec.commandLine().getErr()) : null;
            told.await();
        } finally {
            if (check != null) {
                check.close();
            }
            stopper.close();
        }
        return ExitCode.OK;
    }

    /** Whether a run's best gait swims as it did when it was found. */
    private boolean showsStoredGait() {
        return !runs.isEmpty() && !choice.isGiven() && gait == null && scheme == null;
    }

    private Start start(Path program) throws InterruptedException {
        Gait given = gait == null ? null : GaitFile.read(gait);
        if (runs.isEmpty() || choice.isGiven()) {
            String scene = choice.scene(spec);
            ObjectNode overrides = Start.patch(null, scheme);
            SceneInfo.of(scene, overrides, program);
            return new Start(scene, overrides, given != null ? given : ThesisData.load().gaitIn(scene));
        }
        EvolutionSettings run = StoredRun.settings(runs.get(0));
        BestGait best = StoredRun.best(runs.get(0));
        return new Start(run.scene(), Start.patch(run.overrides(), scheme != null ? scheme : run.scheme()),
                given != null || best == null ? given : best.gait());
    }
}
