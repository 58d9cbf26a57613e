package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.process.SimulatorLocator;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** The option that names the native program. */
@Section(Topic.COMPUTING)
final class SimulatorOption {

    @Option(names = "--simulator-path", paramLabel = "FILE", description = "The native program. Default: the one that "
            + "the environment variable " + SimulatorLocator.VARIABLE + " names, else build/release/bin/natator-sim.")
    private Path path;

    /** See {@link SimulatorLocator#locate}. */
    Path path() {
        return SimulatorLocator.locate(path);
    }
}
