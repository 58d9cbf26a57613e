package io.natator.study.thesis;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.VacuumRequests;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;

/** What the study measures: requests for the tables of chapter 3 and the experiments of chapter 4, and how many runs of each. */
final class ExperimentCatalogue {

    static final String POTENTIATION = "potentiation";
    static final String TWO_CLUSTERS = "two-clusters";
    static final String SINKING = "sinking";
    static final String WATER = "water";
    static final String VACUUM = "vacuum";
    static final String RESTING = "resting";
    static final List<Double> POWERS = List.of(0.5, 1.0, 2.0, 4.0);
    /** Phase difference of the potentiated gaits, and that of the same gait backwards. */
    static final List<Double> PHASE_STEPS = List.of(0.25, 0.75);
    /** The published gait that swims, with which parameters are studied beside those that evolved. */
    static final String STUDIED = "2-step-0.862";
    private static final double POTENTIATED_FREQUENCY = 2;
    private static final double POTENTIATED_AMPLITUDE = 0.8;
    private static final int FIRST_START = 1;
    /** Finalists are chosen by other starts than the winner is measured from. */
    private static final int FIRST_START_OF_FINALISTS = 1001;
    private static final int FEW = 4;

    private final ThesisData data;
    private final Double duration;
    private final int starts;
    private final int few;

    /**
     * The experiments of a study.
     *
     * @param duration simulated seconds, or null for the scene's own
     * @param starts   of a gait in its water; of other experiments at most {@value #FEW}
     */
    ExperimentCatalogue(ThesisData data, Double duration, int starts) {
        this.data = data;
        this.duration = duration;
        this.starts = starts;
        this.few = Math.min(starts, FEW);
    }

    /** Published gaits in a water. */
    List<Subject> published(Water water) {
        return data.gaits().stream().map(gait -> Subject.of(gait, water)).toList();
    }

    /** A subject under a condition. */
    Experiment of(Subject subject, Condition condition) {
        boolean isCentral = condition == Condition.WATER || condition == Condition.HALF_STEP;
        return new Experiment("swimming", subject.name(), condition.label(), condition.of(subject, duration), FIRST_START,
                isCentral ? starts : few);
    }

    /** A subject under all conditions of its water. */
    List<Experiment> all(Subject subject) {
        return Condition.in(subject.water()).stream().map(condition -> of(subject, condition)).toList();
    }

    /** The gaits among which the winner of an evolution is chosen, in the order of {@link Finalists}. */
    List<Experiment> finalists(EvolvedRun run, Path directory) {
        List<Finalists.Finalist> finalists = Finalists.of(run.plan().directory()).gaits();
        return IntStream.range(0, finalists.size()).mapToObj(i -> new Experiment("finalists",
                nameOf(run, directory) + "/" + (i + 1), WATER,
                Condition.WATER.of(subject(run, finalists.get(i).gait(), directory), duration), FIRST_START_OF_FINALISTS, few)).toList();
    }

    /** What an evolution has found. */
    static Subject subject(EvolvedRun run, Gait gait, Path directory) {
        return new Subject(nameOf(run, directory), "evolved", run.creature(), run.water(), gait, run.seed());
    }

    /** Its run folder, from that of the study. */
    private static String nameOf(EvolvedRun run, Path directory) {
        return directory.relativize(run.plan().directory()).toString().replace('\\', '/');
    }

    /** Thesis 4.1: a gait with another value of a parameter. */
    Experiment study(Subject subject, Parameter parameter, double value, boolean inVacuum) {
        SimulationRequest request = Condition.WATER.of(subject, duration);
        if (value != parameter.in(subject.water()).orElseThrow().standard()) {
            request = request.withChange(parameter.overrides(value));
        }
        String setting = parameter.label() + "=" + value;
        return new Experiment(parameter.label(), subject.name(), inVacuum ? VACUUM + " " + setting : setting,
                inVacuum ? VacuumRequests.of(request, duration) : request, FIRST_START, few);
    }

    /** All values of all parameters. */
    List<Experiment> studies(Subject subject) {
        List<Experiment> all = new ArrayList<>();
        for (Parameter parameter : Parameter.values()) {
            parameter.in(subject.water()).ifPresent(range -> range.values().forEach(value -> {
                all.add(study(subject, parameter, value, false));
                if (parameter.alsoInVacuum(subject.water())) {
                    all.add(study(subject, parameter, value, true));
                }
            }));
        }
        return all;
    }

    /** Thesis 4.2: a gait whose activation is raised to a power. */
    Experiment potentiated(int creature, double power, double step, Water water, boolean inVacuum) {
        int actuators = creature == 1 ? 2 : 8;
        Gait gait = new Gait(POTENTIATED_FREQUENCY, IntStream.range(0, actuators).mapToObj(i -> POTENTIATED_AMPLITUDE).toList(),
                IntStream.range(0, actuators).mapToObj(i -> i * step % 1).toList(), power);
        SimulationRequest request = request(water.scene(creature), gait, water, Condition.stopping(false));
        return new Experiment(POTENTIATION, "creature-" + creature + "/p=" + power + "/step=" + step, inVacuum ? VACUUM : WATER,
                inVacuum ? VacuumRequests.of(request, duration) : request, FIRST_START, few);
    }

    private List<Experiment> potentiated(Water water) {
        List<Experiment> all = new ArrayList<>();
        for (int creature : List.of(1, 2)) {
            for (double power : POWERS) {
                for (double step : PHASE_STEPS) {
                    all.add(potentiated(creature, power, step, water, false));
                    all.add(potentiated(creature, power, step, water, true));
                }
            }
        }
        return all;
    }

    /** Thesis 4.3: gaits of the body of two clusters. */
    static List<Gait> gaitsOfTwoClusters() {
        return List.of(0.5, 1.0, 1.5, 2.0).stream().flatMap(frequency -> List.of(0.5, 1.0).stream()
                .map(amplitude -> new Gait(frequency, List.of(amplitude), List.of(0.0)))).toList();
    }

    /**
     * The body of two clusters.
     *
     * @param setting {@link #WATER}, {@link #VACUUM} or {@link #RESTING}
     */
    Experiment twoClusters(Gait gait, Water water, String setting) {
        ObjectNode overrides = Condition.stopping(false);
        String scene = "thesis/two-clusters";
        if (water == Water.OPEN_WATER) {
            scene = water.scene(1);
            overrides.putObject("creature").put("name", TWO_CLUSTERS);
        }
        SimulationRequest request = request(scene, setting.equals(RESTING) ? gait.resting() : gait, water, overrides);
        String subject = setting.equals(RESTING) ? RESTING : "f=" + gait.frequency() + "/a=" + gait.amplitude().get(0);
        return new Experiment(TWO_CLUSTERS, subject, setting, setting.equals(VACUUM) ? VacuumRequests.of(request, duration) : request,
                FIRST_START, few);
    }

    private List<Experiment> twoClusters(Water water) {
        List<Experiment> all = new ArrayList<>();
        gaitsOfTwoClusters().forEach(gait -> {
            all.add(twoClusters(gait, water, WATER));
            all.add(twoClusters(gait, water, VACUUM));
        });
        all.add(twoClusters(gaitsOfTwoClusters().get(0), water, RESTING));
        return all;
    }

    /** The thesis' tank and bodies as they are in scheme conserving. */
    Experiment sinking(int creature) {
        Gait gait = data.gaits().stream().filter(one -> one.creature() == creature).findFirst().orElseThrow().gait();
        return new Experiment(SINKING, "creature-" + creature, WATER, new SimulationRequest(0, ThesisData.scene(creature), gait, duration,
                Scheme.CONSERVING, Condition.stopping(true)), FIRST_START, few);
    }

    /** What depends on no evolution. */
    List<Experiment> independent() {
        List<Experiment> all = new ArrayList<>();
        for (Water water : Water.values()) {
            published(water).forEach(subject -> all.addAll(all(subject)));
            all.addAll(potentiated(water));
            all.addAll(twoClusters(water));
        }
        IntStream.rangeClosed(1, 4).forEach(creature -> all.add(sinking(creature)));
        return all;
    }

    private SimulationRequest request(String scene, Gait gait, Water water, ObjectNode overrides) {
        return new SimulationRequest(0, scene, gait, duration, water.scheme(), overrides);
    }
}
