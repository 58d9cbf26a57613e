package io.natator.study;

import io.natator.checkpoint.Environment;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Limits;
import io.natator.file.GeneratedPage;
import io.natator.file.OutputFolder;
import io.natator.simulator.Evaluator;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

/**
 * The comparison with NVIDIA Flex from the list of variants to the written results.
 *
 * @param variantsFile list of variants, see {@code results/flex-comparison/variants.json}
 * @param directory    where the results go: {@code evaluations.jsonl environment.json comparison.csv README.md} and
 *                     the pictures
 * @param runs         per variant and interval, at least 1
 */
public record FlexStudy(Path variantsFile, Path directory, int runs) {

    /**
     * Carries out what is missing and writes the results anew.
     *
     * @param only name of the one variant to evaluate, or null for all
     * @return the page with the results
     * @throws InvalidInputException if the list of variants, the folder or {@code only} is wrong
     * @throws InterruptedException  if the calling thread is interrupted; what is finished is kept
     */
    public Path run(ExecutionSettings execution, String only) throws InterruptedException {
        List<Variant> variants = VariantFile.read(variantsFile);
        if (only != null && variants.stream().noneMatch(variant -> variant.name().equals(only))) {
            throw new InvalidInputException("--only is " + only + "; expected one of "
                    + variants.stream().map(Variant::name).toList());
        }
        Limits.checkCount("--runs", runs, Limits.REPETITIONS);
        GeneratedPage.check(directory);
        OutputFolder.make(directory);
        Environment environment = Environment.present(execution, null, null);
        List<Comparison> comparisons;
        try (Evaluator evaluator = Evaluator.open(execution)) {
            comparisons = new FlexComparison(variants, runs, directory.resolve("evaluations.jsonl"),
                    environment.simulatorSha256()).run(evaluator, only);
        }
        try {
            Files.writeString(directory.resolve("environment.json"), Json.document(environment));
            return write(comparisons);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write the results: " + e.getMessage(), e);
        }
    }

    private Path write(List<Comparison> comparisons) throws IOException {
        Files.writeString(directory.resolve("comparison.csv"), ComparisonTable.csv(comparisons));
        draw("in fluid", comparisons.stream().filter(one -> one.variant().inFluid()).toList(), "comparison-fluid");
        draw("in vacuum", comparisons.stream().filter(one -> !one.variant().inFluid()).toList(), "comparison-vacuum");
        Path page = directory.resolve(GeneratedPage.NAME);
        return Files.writeString(page, ComparisonReport.markdown(comparisons, command(), variantsFile.toString()));
    }

    private void draw(String title, List<Comparison> comparisons, String name) throws IOException {
        if (!comparisons.isEmpty()) {
            ComparisonChart.draw("Speed " + title, comparisons, directory, name);
        }
    }

    private String command() {
        return "java -jar ga-java/target/natator.jar compare-flex --variants " + variantsFile + " --output-dir "
                + directory + " --runs " + runs;
    }
}
