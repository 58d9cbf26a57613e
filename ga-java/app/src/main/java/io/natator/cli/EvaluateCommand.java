package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.base.MergePatch;
import io.natator.base.Numbers;
import io.natator.body.Swimmer;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.encoding.DenseEncoding;
import io.natator.encoding.Gait;
import io.natator.process.Evaluator;
import io.natator.process.SceneInfo;
import io.natator.process.TimeLimit;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator evaluate}: simulates one gait and prints the result as one line of JSON. */
@Command(name = "evaluate", description = "Simulates one gait and prints the result as JSON.",
        mixinStandardHelpOptions = true,
        customSynopsis = "natator evaluate --scene NAME|FILE --gait FILE|GENE... [OPTIONS]",
        footer = {"", "Examples:",
                "  natator evaluate --scene pool/eel --gait runs/eel/best.json --duration 2",
                "  natator evaluate --scene thesis/creature-1 --gait 1.861 0.973 0.69 0.648",
                "", "Exit status: 0 done, 1 unstable or failed, 2 bad usage or input."})
final class EvaluateCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Mixin
    private ExecutionOptions executionOptions;

    @Section(Topic.SCENE)
    @Option(names = "--scene", required = true, paramLabel = "NAME|FILE",
            description = "For example thesis/creature-1.")
    private String scene;

    @Section(Topic.SCENE)
    @Option(names = "--gait", required = true, arity = "1..*", paramLabel = "FILE|GENE",
            description = "A JSON file with a gait (or a run's best.json, with its body), or genes: frequency, amplitudes, phases but "
                    + "the first (dense); or frequency, first and last amplitude, phase difference (sparse).")
    private List<String> gait;

    @Override
    public Integer call() throws InterruptedException {
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        String sceneName = SceneOptions.scene("--scene", scene);
        Swimmer swimmer = swimmer(sceneName, execution.simulator());
        SimulationRequest request = new SimulationRequest(0, sceneName, swimmer.gait(), sceneOptions.duration(),
                sceneOptions.scheme(), MergePatch.both(swimmer.body(), sceneOptions.overrides()));
        SceneInfo info = SceneInfo.of(sceneName, request.overrides(), execution.simulator());
        if (execution.timeout() == null) {
            execution = execution.withTimeout(TimeLimit.of(info, sceneOptions.duration()));
        }
        SimulationResult result;
        try (Evaluator evaluator = Evaluator.open(execution)) {
            result = evaluator.evaluate(request);
        }
        spec.commandLine().getOut().println(Json.line(result));
        if (result.status() == SimulationResult.Status.OK) {
            return ExitCode.OK;
        }
        OneLineErrors.print(spec.commandLine(), why(result));
        return ExitCode.SOFTWARE;
    }

    private static String why(SimulationResult result) {
        if (result.status() != SimulationResult.Status.UNSTABLE) {
            return "the simulation failed: " + result.error();
        }
        SimulationResult.Instability where = result.unstable();
        return "the simulation became " + result.whyUnstable()
                + (where == null || where.stage() == null ? "" : ", in stage " + where.stage());
    }

    private Swimmer swimmer(String sceneName, Path simulator) throws InterruptedException {
        if (gait.size() == 1 && (gait.get(0).endsWith(".json") || Files.exists(Path.of(gait.get(0))))) {
            return GaitFile.read(Path.of(gait.get(0)));
        }
        return new Swimmer(gait(SceneInfo.of(sceneName, sceneOptions.overrides(), simulator).actuators()), null);
    }

    private Gait gait(int actuators) {
        if (actuators == 0) {
            throw new InvalidInputException(
                    "--scene is " + scene + ", where nothing can move by itself: it has no actuators");
        }
        List<Double> genes = numbers();
        // Of two actuators both encodings are the same.
        boolean dense = genes.size() == new DenseEncoding(actuators).genes().size() || genes.size() != 4;
        try {
            return (dense ? EncodingKind.DENSE : EncodingKind.SPARSE).forActuators(actuators).decode(genes);
        } catch (IllegalArgumentException e) {
            throw new InvalidInputException("--gait: " + e.getMessage(), e);
        }
    }

    private List<Double> numbers() {
        List<Double> genes = new ArrayList<>();
        for (String gene : gait) {
            try {
                genes.add(Numbers.parse(gene));
            } catch (NumberFormatException e) {
                throw new InvalidInputException("--gait: gene " + (genes.size() + 1) + " is '" + gene
                        + "'; expected a number", e);
            }
        }
        return genes;
    }
}
