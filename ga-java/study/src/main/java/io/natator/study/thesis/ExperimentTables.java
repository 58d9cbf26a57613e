package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.report.ReportDocument;
import io.natator.study.Sample;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** The experiments of the thesis' chapter 4: parameters (4.1), potentiation (4.2), the body of two clusters (4.3). */
final class ExperimentTables {

    private final StudyResults results;

    ExperimentTables(StudyResults results) {
        this.results = results;
    }

    void add(ReportDocument page) {
        page.heading(3, "4.1: what each parameter does");
        page.text("Speed of the published gaits of creature 1 and of creature 2 with phase step 0.862 (which is how it "
                + "swims), all else as in the thesis, whose own value is bold; cost is seconds of one core for a simulated "
                + "second of creature 1 (" + String.join("; ", results.timings().machines())
                + "). Of runs that became unstable the number is given.");
        for (Parameter parameter : Parameter.values()) {
            page.heading(4, parameter.label());
            page.table(parameterColumns(parameter), parameterRows(parameter));
        }
        page.heading(3, "4.2: potentiated activation");
        page.text("u = ((sin + 1)/2)ᵖ·2 − 1 with f = 2, a = 0.8; phase step Δφ = 0.25 from head to tail, and 1 − Δφ. Speeds "
                + "in fluid, and in vacuum, where nothing should move.");
        page.table(List.of("creature", "p", "flex: fluid, Δφ", "flex: fluid, 1 − Δφ", "flex: vacuum, Δφ",
                "flex: vacuum, 1 − Δφ", "conserving: fluid, Δφ", "conserving: fluid, 1 − Δφ", "conserving: vacuum, Δφ",
                "conserving: vacuum, 1 − Δφ"), potentiation());
        page.heading(3, "4.3: the body of two clusters");
        page.text("One actuator from the first to the last slice across its one joint.");
        page.table(List.of("f (1/s)", "a", "flex: fluid", "flex: vacuum", "conserving: fluid", "conserving: vacuum"),
                twoClusters());
    }

    private static List<String> parameterColumns(Parameter parameter) {
        List<String> columns = new ArrayList<>(List.of(parameter.label()));
        for (String medium : parameter.alsoInVacuum() ? List.of("fluid", "vacuum") : List.of("fluid")) {
            for (String gait : ExperimentCatalogue.STUDIED_GAITS) {
                for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                    columns.add("creature " + gait.charAt(0) + ", " + TableFormat.name(scheme)
                            + (medium.equals("fluid") ? "" : ", vacuum"));
                }
            }
        }
        columns.addAll(List.of("cost, flex", "cost, conserving"));
        return columns;
    }

    private List<List<String>> parameterRows(Parameter parameter) {
        List<List<String>> rows = new ArrayList<>();
        for (double value : parameter.settings()) {
            String shown = TableFormat.value(value);
            List<String> row = new ArrayList<>(List.of(value == parameter.standard() ? "**" + shown + "**" : shown));
            for (boolean vacuum : parameter.alsoInVacuum() ? List.of(false, true) : List.of(false)) {
                for (String gait : ExperimentCatalogue.STUDIED_GAITS) {
                    ExperimentCatalogue.SCHEMES.forEach(scheme -> row.add(cell(of(parameter, value, gait, scheme,
                            vacuum))));
                }
            }
            ExperimentCatalogue.SCHEMES.forEach(scheme -> row.add(TableFormat.number(results.timings()
                    .of(of(parameter, value, ExperimentCatalogue.STUDIED_GAITS.get(0), scheme, false)))));
            rows.add(row);
        }
        return rows;
    }

    /** The experiment of a parameter's value. */
    private Experiment of(Parameter parameter, double value, String gait, Scheme scheme, boolean vacuum) {
        return of(results, parameter, value, gait, scheme, vacuum);
    }

    static Experiment of(StudyResults results, Parameter parameter, double value, String gait, Scheme scheme,
            boolean vacuum) {
        String setting = (vacuum ? ExperimentCatalogue.VACUUM + " " : "") + parameter.label() + "=" + value;
        return results.catalogue().study(parameter, gait, scheme).stream()
                .filter(one -> one.setting().equals(setting)).findFirst().orElseThrow();
    }

    private String cell(Experiment experiment) {
        long unstable = results.measurements().unstable(experiment);
        Sample speed = results.measurements().speed(experiment);
        return unstable == 0 ? TableFormat.speed(speed)
                : (speed.count() == 0 ? "" : TableFormat.speed(speed) + ", ") + unstable + " unstable";
    }

    private List<List<String>> potentiation() {
        List<List<String>> rows = new ArrayList<>();
        for (int creature : List.of(1, 2)) {
            for (double power : ExperimentCatalogue.POWERS) {
                List<String> row = new ArrayList<>(List.of("" + creature, TableFormat.value(power)));
                for (Scheme scheme : ExperimentCatalogue.SCHEMES) {
                    for (String medium : List.of(ExperimentCatalogue.FLUID, ExperimentCatalogue.VACUUM)) {
                        for (double step : ExperimentCatalogue.PHASE_STEPS) {
                            row.add(cell(potentiated(results, creature, power, step, scheme, medium)));
                        }
                    }
                }
                rows.add(row);
            }
        }
        return rows;
    }

    static Experiment potentiated(StudyResults results, int creature, double power, double step, Scheme scheme,
            String medium) {
        String subject = ExperimentCatalogue.potentiated(creature, power, step);
        return results.catalogue().potentiated(creature, scheme).stream()
                .filter(one -> one.subject().equals(subject) && one.setting().equals(medium)).findFirst().orElseThrow();
    }

    private List<List<String>> twoClusters() {
        List<List<String>> rows = new ArrayList<>();
        List<Experiment> flex = results.catalogue().twoClusters(Scheme.FLEX);
        List<Experiment> conserving = results.catalogue().twoClusters(Scheme.CONSERVING);
        for (int i = 0; i < flex.size(); i += 2) {
            rows.add(List.of(String.format(Locale.ROOT, "%.1f", flex.get(i).gait().frequency()),
                    String.format(Locale.ROOT, "%.1f", flex.get(i).gait().amplitude().get(0)), cell(flex.get(i)),
                    cell(flex.get(i + 1)), cell(conserving.get(i)), cell(conserving.get(i + 1))));
        }
        return rows;
    }
}
