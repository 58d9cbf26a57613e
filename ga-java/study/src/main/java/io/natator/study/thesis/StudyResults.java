package io.natator.study.thesis;

import io.natator.config.Scheme;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.study.Sample;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.IntStream;

/**
 * All that was found, for the tables.
 *
 * @param evolved finished evolutions
 */
record StudyResults(ThesisData data, ExperimentCatalogue catalogue, MeasurementLog measurements,
        KinematicsLog motions, TimingLog timings, List<EvolvedRun> evolved) {

    /** Finished evolutions of a creature in a scheme. */
    List<EvolvedRun> evolved(int creature, Scheme scheme) {
        return evolved.stream().filter(run -> run.creature() == creature && run.scheme() == scheme).toList();
    }

    /** Speeds of a published gait. */
    Sample speed(ThesisData.PublishedGait gait, Scheme scheme, String setting) {
        return speed(catalogue.speeds(gait, scheme), setting);
    }

    /** Speeds of the best gait of one evolution. */
    Sample speed(EvolvedRun run, String setting) {
        return speed(catalogue.speeds(run), setting);
    }

    private Sample speed(List<Experiment> experiments, String setting) {
        return measurements.speed(experiments.stream().filter(one -> one.setting().equals(setting)).findFirst()
                .orElseThrow());
    }

    /** Over the seeds of evolution: the mean and spread of what their best gaits swim on average. */
    Sample speedOverSeeds(int creature, Scheme scheme, String setting) {
        return Sample.of(evolved(creature, scheme).stream().map(run -> speed(run, setting))
                .filter(sample -> sample.count() > 0).map(Sample::mean).toList());
    }

    /**
     * Of the seeds, the evolution whose best gait is fastest on average, of those that swim by the rule of
     * {@link ClaimsSection#swims} if there are any: evolution judges by a single run, so a gait that tumbles may win by
     * luck. Null if none is measured.
     */
    EvolvedRun best(int creature, Scheme scheme) {
        Comparator<EvolvedRun> bySpeed = Comparator
                .comparingDouble(run -> speed(run, ExperimentCatalogue.FLUID).mean());
        return evolved(creature, scheme).stream().filter(run -> speed(run, ExperimentCatalogue.FLUID).count() > 0)
                .max(Comparator.comparing(this::swims).thenComparing(bySpeed)).orElse(null);
    }

    private boolean swims(EvolvedRun run) {
        return ClaimsSection.swims(speed(run, ExperimentCatalogue.FLUID), speed(run, ExperimentCatalogue.VACUUM))
                .equals(ClaimsSection.YES);
    }

    /** e of the recorded runs against a mode. */
    static Sample error(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        return Sample.of(motions.stream().map(motion -> fits.apply(motion).get(mode.ordinal()).error()).toList());
    }

    /** The mode with the least mean e; null without recordings. */
    static FishMode nearest(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        return motions.isEmpty() ? null : IntStream.range(0, FishMode.values().length).mapToObj(i -> FishMode.values()[i])
                .min((a, b) -> Double.compare(error(motions, a, fits).mean(), error(motions, b, fits).mean()))
                .orElseThrow();
    }

    /** Whether that mode is like them at all, by means over the runs; see {@link ModeFit#resembles}. */
    private static boolean resembles(List<SwimKinematics> motions, FishMode mode, Function<SwimKinematics, List<ModeFit>> fits) {
        List<ModeFit> own = motions.stream().map(motion -> fits.apply(motion).get(mode.ordinal())).toList();
        return ModeFit.resembles(Sample.of(own.stream().map(ModeFit::relative).toList()).mean(),
                Sample.of(own.stream().map(ModeFit::alpha).toList()).mean());
    }

    /** Of the modes that they are like at all the one with the least mean e; empty if there is none. */
    static Optional<FishMode> like(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        return motions.isEmpty() ? Optional.empty() : Arrays.stream(FishMode.values()).filter(mode -> resembles(motions, mode, fits))
                .min(Comparator.comparingDouble(mode -> error(motions, mode, fits).mean()));
    }

    /** The same in words, with e, or with the least e where they are like none; a dash without recordings. */
    static String likeWhich(List<SwimKinematics> motions, Function<SwimKinematics, List<ModeFit>> fits) {
        FishMode fish = like(motions, fits).orElse(nearest(motions, fits));
        return fish == null ? TableFormat.NOTHING : like(motions, fits).map(FishMode::label).orElse("none")
                + " (" + TableFormat.number(error(motions, fish, fits).mean()) + ")";
    }

    /** Recorded runs of the best gait of one evolution. */
    List<SwimKinematics> motions(EvolvedRun run) {
        return motions.of(catalogue.speeds(run).get(0));
    }

    /** Recorded runs of a published gait. */
    List<SwimKinematics> motions(ThesisData.PublishedGait gait, Scheme scheme) {
        return motions.of(catalogue.speeds(gait, scheme).get(0));
    }

    /** Recorded runs of a published gait in flex, where inverse masses are linear in height. */
    List<SwimKinematics> motionsOfInverseMass(ThesisData.PublishedGait gait) {
        return motions.of(catalogue.speeds(gait, Scheme.FLEX).get(1));
    }

    /** Head to tail of a creature at rest, as recorded; NaN if it was not. */
    double bodyLength(int creature) {
        return data.gaits().stream().filter(gait -> gait.creature() == creature)
                .flatMap(gait -> ExperimentCatalogue.SCHEMES.stream().flatMap(scheme -> motions(gait, scheme).stream()))
                .mapToDouble(SwimKinematics::bodyLength).findFirst().orElse(Double.NaN);
    }
}
