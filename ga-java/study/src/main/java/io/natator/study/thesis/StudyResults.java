package io.natator.study.thesis;

import io.natator.checkpoint.Controls;
import io.natator.checkpoint.SwimSample;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.study.Sample;
import io.natator.verdict.ControlVerdict;
import io.natator.verdict.Verdict;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;

/**
 * All that was found, for what follows from it; closes the files that it is kept in.
 *
 * @param directory    of the study
 * @param measurements on its backend
 * @param processor    the same again on the processor, of the central gaits
 * @param convergence  at half the spacing
 * @param motions      recorded
 * @param winners      of the finished evolutions
 * @param duration     of a measured run, in seconds
 */
record StudyResults(ThesisData data, Path directory, ExperimentCatalogue catalogue, MeasurementLog measurements,
        MeasurementLog processor, ConvergenceLog convergence, KinematicsLog motions, Winners winners, double duration) implements AutoCloseable {

    /** Of a run (thesis 2.6). */
    static final double THESIS_SECONDS = 4;

    /** Finished evolutions. */
    List<EvolvedRun> runs() {
        return winners.runs();
    }

    /** Everything to be measured that is known by now: what is found adds to it. */
    List<Experiment> experiments() {
        List<Experiment> all = new ArrayList<>(catalogue.independent());
        all.addAll(winners.experiments());
        evolved().forEach(subject -> all.addAll(catalogue.all(subject)));
        Arrays.stream(Water.values()).flatMap(water -> studied(water).stream()).forEach(subject -> all.addAll(catalogue.studies(subject)));
        return all;
    }

    /** The gaits of all that. */
    Set<Gait> gaits() {
        return experiments().stream().map(one -> one.request().gait()).collect(Collectors.toSet());
    }

    /** What is measured on the processor too: bits that can be checked anywhere, and a second backend for the winners. */
    List<Experiment> onProcessor() {
        return subjects().map(subject -> catalogue.of(subject, Condition.WATER))
                .map(one -> new Experiment(one.group(), one.subject(), one.setting(), one.request(), one.first(), Math.min(2, one.starts())))
                .toList();
    }

    /** All gaits, the published ones of each water first. */
    Stream<Subject> subjects() {
        return Arrays.stream(Water.values()).flatMap(water -> Stream.concat(catalogue.published(water).stream(),
                evolved(water).stream()));
    }

    /** Winners of all evolutions that are known. */
    List<Subject> evolved() {
        return winners.all();
    }

    List<Subject> evolved(Water water) {
        return evolved().stream().filter(subject -> subject.water() == water).toList();
    }

    /** Gaits with which parameters are studied: a published one that swims, and the best that evolved of creatures 1 and 2. */
    List<Subject> studied(Water water) {
        List<Subject> studied = new ArrayList<>(List.of(Subject.of(data.gait(ExperimentCatalogue.STUDIED), water)));
        List.of(1, 2).forEach(creature -> best(creature, water).ifPresent(studied::add));
        return studied;
    }

    /** Of the seeds, the winner that gets furthest by the lesser of its ways at both time steps; empty while none is measured. */
    Optional<Subject> best(int creature, Water water) {
        return evolved(water).stream().filter(subject -> subject.creature() == creature)
                .filter(subject -> measurements.has(catalogue.of(subject, Condition.HALF_STEP)))
                .max(Comparator.comparingDouble(subject -> Math.min(way(subject, Condition.WATER), way(subject, Condition.HALF_STEP))));
    }

    /** What a winner is chosen by, as it evolved: mean, in the whole time. */
    private double way(Subject subject, Condition condition) {
        return duration * measurements.speed(catalogue.of(subject, condition), duration).mean();
    }

    /**
     * Scene units per second: in the thesis' tank over the whole time, in open water, which stands for water without walls, until
     * a run ends at one.
     */
    Sample speed(Subject subject, Condition condition) {
        return speed(measurements, subject, condition);
    }

    /** The same of a gait in its water, as computed by the processor. */
    Sample speedOnProcessor(Subject subject) {
        return speed(processor, subject, Condition.WATER);
    }

    private Sample speed(MeasurementLog log, Subject subject, Condition condition) {
        Experiment swim = catalogue.of(subject, condition);
        Water water = condition == Condition.OTHER_WATER ? subject.water().other() : subject.water();
        return water == Water.OPEN_WATER ? log.speedWhileLasting(swim) : log.speed(swim, duration);
    }

    /** Seconds that its runs in its water last. */
    Sample lasted(Subject subject) {
        return measurements.lasted(catalogue.of(subject, Condition.WATER));
    }

    /** The speed of a gait with what it is known to. */
    Optional<Speed> speed(Subject subject) {
        Sample water = speed(subject, Condition.WATER);
        return water.count() == 0 ? Optional.empty()
                : Optional.of(Speed.of(water, speed(subject, Condition.HALF_STEP), convergence.change(catalogue.of(subject, Condition.WATER))));
    }

    /**
     * Everything that a verdict rests on; empty while something is missing. The processor is another backend only for what
     * was measured on a GPU.
     */
    Optional<Controls> controls(Subject subject) {
        SwimSample water = swim(subject, Condition.WATER);
        SwimSample resting = swim(subject, Condition.RESTING);
        SwimSample vacuum = swim(subject, Condition.VACUUM);
        SwimSample half = swim(subject, Condition.HALF_STEP);
        SwimSample mirrored = swim(subject, Condition.MIRRORED);
        if (water == null || resting == null || vacuum == null || half == null || mirrored == null) {
            return Optional.empty();
        }
        Experiment swim = catalogue.of(subject, Condition.WATER);
        SwimSample other = measurements.isOnGpu(swim) ? processor.swim(swim, Water.SUBSTEPS, duration, length(subject.creature())) : null;
        Sample under = Sample.of(motions(subject).stream().map(SwimKinematics::underWater).filter(Objects::nonNull).toList());
        return Optional.of(new Controls(subject.gait(), null, Json.name(subject.water().scheme()), duration, length(subject.creature()), water,
                resting, vacuum, subject.water() == Water.FLEX ? swim(subject, Condition.NO_CLAMP) : null, half, mirrored, other,
                other == null ? null : "cpu", under.count() == 0 ? null : under.mean()));
    }

    /** Whether a gait swims; empty while something is missing. */
    Optional<ControlVerdict> verdict(Subject subject) {
        return controls(subject).map(ControlVerdict::of);
    }

    /** Whether no control has shown that a gait does not swim; false while something is missing. */
    boolean maySwim(Subject subject) {
        return verdict(subject).filter(verdict -> verdict.kind() != Verdict.Kind.DOES_NOT_SWIM).isPresent();
    }

    /** All figures of the runs that are measured of a gait; null without any. */
    SwimSample swim(Subject subject, Condition condition) {
        return measurements.swim(catalogue.of(subject, condition), (condition == Condition.HALF_STEP ? 2 : 1) * Water.SUBSTEPS, duration,
                length(subject.creature()));
    }

    private Double length(int creature) {
        double length = bodyLength(creature);
        return Double.isFinite(length) ? length : null;
    }

    /** e of recorded runs against a mode. */
    static Sample error(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        return Sample.of(motions.stream().map(motion -> fits.apply(motion).get(mode.ordinal()).error()).toList());
    }

    /** The mode with the least mean e; null without recordings. */
    static FishMode nearest(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        return nearest(Arrays.stream(FishMode.values()), motions, fits).orElse(null);
    }

    private static Optional<FishMode> nearest(Stream<FishMode> modes, List<SwimKinematics> motions,
            Function<SwimKinematics, List<ModeFit>> fits) {
        return motions.isEmpty() ? Optional.empty() : modes.min(Comparator.comparingDouble(mode -> error(motions, mode, fits).mean()));
    }

    /** e as a share of that of no motion. */
    static Sample relative(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        return Sample.of(motions.stream().map(motion -> fits.apply(motion).get(mode.ordinal()).relative()).toList());
    }

    /** Whether that mode is like them at all, by means over the runs; see {@link ModeFit#resembles}. */
    private static boolean resembles(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        return ModeFit.resembles(relative(motions, mode, fits).mean(), scale(motions, mode, fits));
    }

    /** Mean α, by which the simulated spine is scaled to fit best. */
    static double scale(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        return motions.stream().mapToDouble(motion -> fits.apply(motion).get(mode.ordinal()).alpha()).average().orElse(Double.NaN);
    }

    /** Of the modes that they are like at all the one with the least mean e; empty if there is none. */
    static Optional<FishMode> like(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        return nearest(Arrays.stream(FishMode.values()).filter(mode -> resembles(motions, mode, fits)), motions, fits);
    }

    /** The same in words, with e as a share of no motion's, the part of the body that it was taken over, and α. */
    static String likeWhich(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        FishMode fish = like(motions, fits).orElse(nearest(motions, fits));
        return fish == null ? TableFormat.NOTHING : like(motions, fits).map(FishMode::label).orElse("none")
                + " (" + TableFormat.shortNumber(relative(motions, fish, fits).mean()) + " over "
                + TableFormat.shortNumber(motions.stream().mapToDouble(SwimKinematics::measuredPart).average().orElse(Double.NaN)) + " of it, α "
                + TableFormat.shortNumber(scale(motions, fish, fits)) + ")";
    }

    /** Recorded runs of a gait in its water. */
    List<SwimKinematics> motions(Subject subject) {
        return motions.of(catalogue.of(subject, Condition.WATER));
    }

    /** Recorded runs of a published gait in flex, where inverse masses are linear in height. */
    List<SwimKinematics> motionsOfInverseMass(Subject subject) {
        return motions.of(catalogue.of(subject, Condition.INVERSE_MASS));
    }

    /** What is recorded: all gaits in their water, and published ones in the tank of inverse masses. */
    List<Experiment> recorded() {
        List<Experiment> all = new ArrayList<>(subjects().map(subject -> catalogue.of(subject, Condition.WATER)).toList());
        catalogue.published(Water.FLEX).forEach(subject -> all.add(catalogue.of(subject, Condition.INVERSE_MASS)));
        return all;
    }

    /** Head to tail of a creature at rest, as recorded; NaN if it was not. */
    double bodyLength(int creature) {
        return Arrays.stream(Water.values()).flatMap(water -> catalogue.published(water).stream())
                .filter(subject -> subject.creature() == creature).flatMap(subject -> motions(subject).stream())
                .mapToDouble(SwimKinematics::bodyLength).findFirst().orElse(Double.NaN);
    }

    /** All that evolved, in its water. */
    List<Experiment> evolvedInWater() {
        return evolved().stream().map(subject -> catalogue.of(subject, Condition.WATER)).toList();
    }

    /** What is drawn, by the name of its files: the published gaits in flex, and the best that evolved. */
    Map<String, Subject> drawn() {
        Map<String, Subject> drawn = new LinkedHashMap<>();
        catalogue.published(Water.FLEX).forEach(subject -> drawn.put(subject.name().replace('/', '-'), subject));
        for (Water water : Water.values()) {
            IntStream.rangeClosed(1, 4).forEach(creature -> best(creature, water)
                    .ifPresent(subject -> drawn.put("creature-" + creature + "-" + water.label(), subject)));
        }
        return drawn;
    }

    /** The fastest that evolved in open water, else in flex; empty without any. */
    Optional<Subject> portrayed() {
        return Stream.of(Water.OPEN_WATER, Water.FLEX).flatMap(water -> IntStream.rangeClosed(1, 4)
                .mapToObj(creature -> best(creature, water)).flatMap(Optional::stream)
                .max(Comparator.comparingDouble(subject -> speed(subject, Condition.WATER).mean())).stream()).findFirst();
    }

    @Override
    public void close() {
        measurements.close();
        processor.close();
        convergence.close();
        motions.close();
    }
}
