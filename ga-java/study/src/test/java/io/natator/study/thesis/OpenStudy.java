package io.natator.study.thesis;

import java.nio.file.Path;
import java.util.List;

/** What a study's folder holds, for tests of what follows from it. */
final class OpenStudy {

    private OpenStudy() {
    }

    /** Of these evolutions, with runs as long as the thesis'. */
    static StudyResults of(Path folder, ExperimentCatalogue catalogue, List<EvolvedRun> runs) {
        MeasurementLog log = new MeasurementLog(folder.resolve("measurements.jsonl"));
        return new StudyResults(ThesisData.load(), folder, catalogue, log, new MeasurementLog(folder.resolve("processor.jsonl")),
                new ConvergenceLog(folder), new KinematicsLog(folder, 2), new Winners(folder, catalogue, log, runs), StudyResults.THESIS_SECONDS);
    }
}
