package io.natator.study.thesis;

import io.natator.encoding.Gait;
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
        page.text("Speed along the own heading while a run lasts, units/s, mean ± standard deviation over four starts. The scene's own value is bold. Of runs that "
                + "became unstable the number is given.");
        for (Parameter parameter : Parameter.values()) {
            for (Water water : Water.values()) {
                parameter.in(water).ifPresent(range -> {
                    page.heading(4, parameter.label() + ", " + water.words());
                    page.table(columns(parameter, water), rows(parameter, range, water));
                });
            }
        }
        page.heading(3, "4.2: potentiated activation");
        page.text("u = ((sin + 1)/2)ᵖ·2 − 1 with f = 2, a = 0.8; phase step Δφ = 0.25 from head to tail, and 1 − Δφ.");
        page.table(List.of("creature", "water", "p", "Δφ", "1 − Δφ", "vacuum, Δφ", "vacuum, 1 − Δφ"), potentiation());
        page.heading(3, "4.3: the body of two clusters");
        page.text("One actuator from the first to the last slice across its one joint; the last row has resting muscles.");
        page.table(List.of("f (1/s)", "a", "flex", "flex, vacuum", "open water", "open water, vacuum"), twoClusters());
    }

    private List<String> columns(Parameter parameter, Water water) {
        List<String> columns = new ArrayList<>(List.of(parameter.label()));
        results.studied(water).forEach(subject -> columns.add(ParameterClaims.name(subject)));
        if (parameter.alsoInVacuum(water)) {
            results.studied(water).forEach(subject -> columns.add(ParameterClaims.name(subject) + ", vacuum"));
        }
        return columns;
    }

    private List<List<String>> rows(Parameter parameter, Parameter.Range range, Water water) {
        List<List<String>> rows = new ArrayList<>();
        for (double value : range.values()) {
            String shown = TableFormat.value(value);
            List<String> row = new ArrayList<>(List.of(value == range.standard() ? "**" + shown + "**" : shown));
            for (boolean vacuum : parameter.alsoInVacuum(water) ? List.of(false, true) : List.of(false)) {
                results.studied(water).forEach(subject -> row.add(cell(results.catalogue().study(subject, parameter, value, vacuum))));
            }
            rows.add(row);
        }
        return rows;
    }

    private String cell(Experiment experiment) {
        long unstable = results.measurements().unstable(experiment);
        Sample speed = results.measurements().forward(experiment);
        return unstable == 0 ? TableFormat.speed(speed)
                : (speed.count() == 0 ? "" : TableFormat.speed(speed) + ", ") + unstable + " unstable";
    }

    private List<List<String>> potentiation() {
        List<List<String>> rows = new ArrayList<>();
        for (int creature : List.of(1, 2)) {
            for (Water water : Water.values()) {
                for (double power : ExperimentCatalogue.POWERS) {
                    List<String> row = new ArrayList<>(List.of("" + creature, water.words(), TableFormat.value(power)));
                    for (boolean vacuum : List.of(false, true)) {
                        ExperimentCatalogue.PHASE_STEPS.forEach(step -> row.add(cell(results.catalogue().potentiated(creature, power, step, water, vacuum))));
                    }
                    rows.add(row);
                }
            }
        }
        return rows;
    }

    private List<List<String>> twoClusters() {
        List<List<String>> rows = new ArrayList<>();
        for (Gait gait : ExperimentCatalogue.gaitsOfTwoClusters()) {
            List<String> row = new ArrayList<>(List.of(String.format(Locale.ROOT, "%.1f", gait.frequency()),
                    String.format(Locale.ROOT, "%.1f", gait.amplitude().get(0))));
            for (Water water : Water.values()) {
                row.add(cell(results.catalogue().twoClusters(gait, water, ExperimentCatalogue.WATER)));
                row.add(cell(results.catalogue().twoClusters(gait, water, ExperimentCatalogue.VACUUM)));
            }
            rows.add(row);
        }
        Gait any = ExperimentCatalogue.gaitsOfTwoClusters().get(0);
        rows.add(List.of("rest", "", cell(results.catalogue().twoClusters(any, Water.FLEX, ExperimentCatalogue.RESTING)), "",
                cell(results.catalogue().twoClusters(any, Water.OPEN_WATER, ExperimentCatalogue.RESTING)), ""));
        return rows;
    }
}
