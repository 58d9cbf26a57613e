package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.checkpoint.BestGait;
import io.natator.checkpoint.StoredRun;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.VacuumRequests;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

/** All experiments of the study: what is measured, for the tables of chapter 3 and the experiments of chapter 4. */
final class ExperimentCatalogue {

    static final String SPEED = "speed";
    static final String POTENTIATION = "potentiation";
    static final String TWO_CLUSTERS = "two-clusters";
    static final String FLUID = "fluid";
    static final String INVERSE_MASS = "fluid-inverse-mass";
    static final String VACUUM = "vacuum";
    /** What swims in the parameter study: the published gaits of creatures 1 and 2, as they swim best. */
    static final List<String> STUDIED_GAITS = List.of("1", "2-step-0.862");
    static final List<Double> POWERS = List.of(0.5, 1.0, 2.0, 4.0);
    /** Phase difference of the potentiated gaits, and that of the same gait backwards. */
    static final List<Double> PHASE_STEPS = List.of(0.25, 0.75);
    static final List<Scheme> SCHEMES = List.of(Scheme.FLEX, Scheme.CONSERVING);
    static final double THESIS_SECONDS = 4;
    private static final double POTENTIATED_FREQUENCY = 2;
    private static final double POTENTIATED_AMPLITUDE = 0.8;

    private final ThesisData data;
    private final List<EvolvedRun> evolved;
    private final Double duration;
    private final Path directory;
    private final Map<Path, BestGait> best = new HashMap<>();

    /**
     * The experiments on the published gaits and those that were evolved.
     *
     * @param evolved   finished evolutions
     * @param duration  simulated seconds, or null for the scene's own
     * @param directory of the study
     */
    ExperimentCatalogue(ThesisData data, List<EvolvedRun> evolved, Double duration, Path directory) {
        this.data = data;
        this.evolved = evolved;
        this.duration = duration;
        this.directory = directory;
    }

    List<Experiment> all() {
        List<Experiment> all = new ArrayList<>();
        data.gaits().forEach(gait -> SCHEMES.forEach(scheme -> all.addAll(speeds(gait, scheme))));
        evolved.forEach(run -> {
            all.addAll(speeds(run));
            all.add(crossed(run));
        });
        for (int creature : List.of(1, 2)) {
            SCHEMES.forEach(scheme -> all.addAll(potentiated(creature, scheme)));
        }
        for (Parameter parameter : Parameter.values()) {
            STUDIED_GAITS.forEach(gait -> SCHEMES.forEach(scheme -> all.addAll(study(parameter, gait, scheme))));
        }
        SCHEMES.forEach(scheme -> all.addAll(twoClusters(scheme)));
        return all;
    }

    /** A published gait in fluid of both mass gradients and in vacuum. It runs on for its time, as measured with Flex. */
    List<Experiment> speeds(ThesisData.PublishedGait gait, Scheme scheme) {
        String subject = "thesis/" + gait.name();
        return speeds(subject, ThesisData.scene(gait.creature()), gait.gait(), scheme, false);
    }

    /** The best gait of a run, likewise; it ends where it touches a plane, as it did when it evolved. */
    List<Experiment> speeds(EvolvedRun run) {
        return speeds(subject(run), ThesisData.scene(run.creature()), best(run).gait(),
                run.scheme(), true);
    }

    /** The best gait of a run in the other scheme, in fluid. */
    Experiment crossed(EvolvedRun run) {
        Scheme other = run.scheme() == Scheme.FLEX ? Scheme.CONSERVING : Scheme.FLEX;
        return new Experiment(SPEED, subject(run), FLUID,
                request(ThesisData.scene(run.creature()), best(run).gait(), other, stopping(true)));
    }

    /** Its run folder, from that of the study. */
    String subject(EvolvedRun run) {
        return directory.relativize(run.plan().directory()).toString().replace('\\', '/');
    }

    /** What is recorded with all its particles: the gaits in fluid, the published ones also in that of inverse masses. */
    List<Experiment> recorded() {
        List<Experiment> all = new ArrayList<>();
        data.gaits().forEach(gait -> SCHEMES.forEach(scheme -> all.add(speeds(gait, scheme).get(0))));
        data.gaits().forEach(gait -> all.add(speeds(gait, Scheme.FLEX).get(1)));
        evolved.forEach(run -> all.add(speeds(run).get(0)));
        return all;
    }

    /** What is timed: the parameter study of the first gait, in fluid. */
    List<Experiment> timed() {
        List<Experiment> all = new ArrayList<>();
        for (Parameter parameter : Parameter.values()) {
            SCHEMES.forEach(scheme -> study(parameter, STUDIED_GAITS.get(0), scheme).stream()
                    .filter(one -> !one.setting().startsWith(VACUUM)).forEach(all::add));
        }
        return all;
    }

    /** What won an evolution. */
    BestGait best(EvolvedRun run) {
        return best.computeIfAbsent(run.plan().directory(), StoredRun::best);
    }

    private List<Experiment> speeds(String subject, String scene, Gait gait, Scheme scheme, boolean touchEnds) {
        ObjectNode inverse = stopping(touchEnds);
        inverse.putObject("fluid").putObject("mass").put("gradient", "inverse-mass-linear");
        SimulationRequest fluid = request(scene, gait, scheme, stopping(touchEnds));
        return List.of(new Experiment(SPEED, subject, FLUID, fluid),
                new Experiment(SPEED, subject, INVERSE_MASS, request(scene, gait, scheme, inverse)),
                new Experiment(SPEED, subject, VACUUM, VacuumRequests.of(fluid, duration)));
    }

    /** Thesis 4.2: forwards and with phase difference 1 − Δφ, in fluid and in vacuum. */
    List<Experiment> potentiated(int creature, Scheme scheme) {
        List<Experiment> all = new ArrayList<>();
        int actuators = creature == 1 ? 2 : 8;
        for (double power : POWERS) {
            for (double step : PHASE_STEPS) {
                Gait gait = new Gait(POTENTIATED_FREQUENCY,
                        IntStream.range(0, actuators).mapToObj(i -> POTENTIATED_AMPLITUDE).toList(),
                        IntStream.range(0, actuators).mapToObj(i -> i * step % 1).toList(), power);
                String subject = potentiated(creature, power, step);
                SimulationRequest fluid = request(ThesisData.scene(creature), gait, scheme, stopping(false));
                all.add(new Experiment(POTENTIATION, subject, FLUID, fluid));
                all.add(new Experiment(POTENTIATION, subject, VACUUM, VacuumRequests.of(fluid, duration)));
            }
        }
        return all;
    }

    static String potentiated(int creature, double power, double step) {
        return "creature-" + creature + "/p=" + power + "/step=" + step;
    }

    /** A published gait with other values of a parameter. */
    List<Experiment> study(Parameter parameter, String gaitName, Scheme scheme) {
        ThesisData.PublishedGait gait = data.gait(gaitName);
        List<Experiment> all = new ArrayList<>();
        for (double value : parameter.settings()) {
            ObjectNode overrides = stopping(false);
            if (value != parameter.standard()) {
                overrides.setAll(parameter.overrides(value));
            }
            SimulationRequest fluid = request(ThesisData.scene(gait.creature()), gait.gait(), scheme, overrides);
            String setting = parameter.label() + "=" + value;
            all.add(new Experiment(parameter.label(), "thesis/" + gaitName, setting, fluid));
            if (parameter.alsoInVacuum()) {
                all.add(new Experiment(parameter.label(), "thesis/" + gaitName, VACUUM + " " + setting,
                        VacuumRequests.of(fluid, duration)));
            }
        }
        return all;
    }

    /** Thesis 4.3: the body of two clusters, over frequencies and amplitudes. */
    List<Experiment> twoClusters(Scheme scheme) {
        List<Experiment> all = new ArrayList<>();
        for (double frequency : List.of(0.5, 1.0, 1.5, 2.0)) {
            for (double amplitude : List.of(0.5, 1.0)) {
                Gait gait = new Gait(frequency, List.of(amplitude), List.of(0.0));
                SimulationRequest fluid = request("thesis/two-clusters", gait, scheme, stopping(false));
                String subject = "f=" + frequency + "/a=" + amplitude;
                all.add(new Experiment(TWO_CLUSTERS, subject, FLUID, fluid));
                all.add(new Experiment(TWO_CLUSTERS, subject, VACUUM, VacuumRequests.of(fluid, duration)));
            }
        }
        return all;
    }

    private SimulationRequest request(String scene, Gait gait, Scheme scheme, ObjectNode overrides) {
        return new SimulationRequest(0, scene, gait, duration, scheme, overrides);
    }

    private static ObjectNode stopping(boolean touchEnds) {
        ObjectNode overrides = JsonNodeFactory.instance.objectNode();
        overrides.putObject("stopping").put("planeContact", touchEnds).put("noProgressAfter", 0);
        return overrides;
    }
}
