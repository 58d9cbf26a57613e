package io.natator.study.optimizer;

import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.Json;
import io.natator.config.Numbers;
import io.natator.file.GeneratedPage;
import io.natator.plot.Drawing;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;

/** The finished runs as a page, a table and pictures. */
final class OptimizerReport {

    private static final String PAGE = """
            # Optimizers side by side

            %s Made with

            ```
            %s
            ```

            which continues a study that was stopped. %d of %d runs are finished; each has a run folder,
            `SCENE/OPTIMIZER/seed-S`, or with `--compact` a line in `SCENE.jsonl`: settings, best gait, figures of every
            generation, and where its best fitness rose. `comparison.csv` holds the tables with all their digits.

            Best fitness so far, the distance swum in scene units, after a tenth, a quarter, half and all of the
            evaluations: median [lower quartile, upper quartile] over the seeds; mean ± standard deviation at the end.
            All optimizers take exactly the same number of evaluations. *In vacuum* is the median of what the best
            gaits do in vacuum for the whole duration: what advances there is no swimming.

            These numbers are what gaits were chosen by, so luck is in them. Optimizers are compared by what follows them: what the
            gaits do from fresh starts, which had no part in choosing them. A difference is told where Mann and Whitney's rank
            test, corrected by Holm for all pairs, has p < 0.05 and the bootstrap interval of the difference does not hold 0.
            `fresh.csv` and `tests.csv` hold these tables with all their digits.
            """;
    private static final int DECIMALS = 4;
    private static final List<Double> SHARES = EqualBudget.SHARES;

    private OptimizerReport() {
    }

    static Path write(List<OptimizerRun> finished, int all, String command, Path directory,
            Map<String, FreshResults> again) {
        StringBuilder page = new StringBuilder(PAGE.formatted(GeneratedPage.MARK, command, finished.size(), all));
        StringBuilder csv = new StringBuilder(
                "scene,optimizer,population,runs,evaluations,lower_quartile,median,upper_quartile,mean,sd,least,greatest\n");
        StringBuilder medians = new StringBuilder(FreshTables.MEDIANS);
        StringBuilder tests = new StringBuilder(FreshTables.TESTS);
        try {
            for (String scene : finished.stream().map(OptimizerRun::scene).distinct().sorted().toList()) {
                List<OptimizerRun> runs = finished.stream().filter(run -> run.scene().equals(scene)).toList();
                add(scene, runs, page, csv, directory);
                FreshTables fresh = new FreshTables(scene, runs, again.get(scene));
                page.append(fresh.page());
                medians.append(fresh.medianLines());
                tests.append(fresh.testLines());
            }
            Files.createDirectories(directory);
            Files.writeString(directory.resolve("comparison.csv"), csv);
            Files.writeString(directory.resolve("fresh.csv"), medians);
            Files.writeString(directory.resolve("tests.csv"), tests);
            return Files.writeString(directory.resolve(GeneratedPage.NAME), page);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write the results: " + e.getMessage(), e);
        }
    }

    private static void add(String scene, List<OptimizerRun> runs, StringBuilder page, StringBuilder csv,
            Path directory) throws IOException {
        List<CurveBand> bands = new ArrayList<>();
        page.append("\n## ").append(scene).append("\n\n").append(columns(runs.get(0).settings().evaluations()));
        for (OptimizerVariant variant : OptimizerVariant.values()) {
            List<OptimizerRun> own = runs.stream().filter(run -> run.variant() == variant).toList();
            if (!own.isEmpty()) {
                CurveBand band = new CurveBand(variant.label(), own.stream().map(run -> run.summary().curve()).toList());
                bands.add(band);
                int population = own.get(0).settings().population();
                page.append(row(band, population, own));
                SHARES.forEach(share -> csv.append(line(scene, band, population, at(band, share))));
            }
        }
        page.append("\n![best distance against evaluations](").append(scene).append(".png)\n\n")
                .append(settings(runs.get(0).settings()));
        // A Java without fonts still has the tables.
        Drawing.orWarn("curves of " + scene,
                () -> CurveChart.draw(scene + ": median and quartiles of the runs", bands, directory.resolve(scene)));
    }

    private static int at(CurveBand band, double share) {
        return EqualBudget.evaluations(share, band.evaluations());
    }

    private static String columns(long evaluations) {
        String places = SHARES.stream().map(share -> "after " + EqualBudget.evaluations(share, evaluations))
                .collect(Collectors.joining(" | "));
        return "| optimizer | population | runs | " + places + " | mean ± sd | in vacuum |\n| --- | ---: | ---: |"
                + " ---: |".repeat(SHARES.size() + 2) + "\n";
    }

    private static String row(CurveBand band, int population, List<OptimizerRun> runs) {
        String cells = SHARES.stream().map(share -> at(band, share))
                .map(place -> shown(band.quantile(place, 0.5)) + " [" + shown(band.quantile(place, 0.25)) + ", "
                        + shown(band.quantile(place, 0.75)) + "]")
                .collect(Collectors.joining(" | "));
        int last = band.evaluations();
        double mean = band.mean(last);
        String found = band.curves().size() > 1 ? Numbers.withError(mean, band.standardDeviation(last), DECIMALS) : shown(mean);
        return "| " + band.label() + " | " + population + " | " + band.curves().size() + " | " + cells + " | "
                + found + " | " + inVacuum(runs) + " |\n";
    }

    private static String inVacuum(List<OptimizerRun> runs) {
        List<double[]> known = runs.stream().map(run -> run.summary().vacuumDistance()).filter(Double::isFinite)
                .map(distance -> new double[] {distance}).toList();
        return known.isEmpty() ? "–" : shown(new CurveBand("", known).quantile(1, 0.5));
    }

    private static String line(String scene, CurveBand band, int population, int place) {
        return Arrays.stream(new double[] {band.quantile(place, 0.25), band.quantile(place, 0.5),
            band.quantile(place, 0.75), band.mean(place), band.standardDeviation(place), band.quantile(place, 0),
            band.quantile(place, 1)})
                .mapToObj(value -> Double.isFinite(value) ? "" + value : "")
                .collect(Collectors.joining(",", scene + "," + band.label() + "," + population + ","
                        + band.curves().size() + "," + place + ",", "\n"));
    }

    /** What all runs of a scene have in common. */
    private static String settings(EvolutionSettings settings) {
        return "Scene `" + settings.scene() + "`, encoding " + Json.name(settings.encoding())
                + ", backend " + settings.backend().argument()
                + (settings.starts() == 1 ? "" : ", " + settings.starts() + " starts, judged by "
                        + Json.name(settings.judge()))
                + (settings.fitness() == FitnessKind.NET ? ", net fitness" : "")
                + (settings.scheme() == null ? "" : ", scheme " + Json.name(settings.scheme()))
                + (settings.duration() == null ? "" : ", " + settings.duration() + " s")
                + (settings.overrides() == null ? "" : ", overrides `" + settings.overrides() + "`") + ".\n";
    }

    private static String shown(double value) {
        return Numbers.fixed(value, DECIMALS);
    }
}
