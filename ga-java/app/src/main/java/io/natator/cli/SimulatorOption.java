package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.process.SimulatorLocator;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** The option that names the native program. */
@Section(Topic.COMPUTING)
final class SimulatorOption {

    @Option(names = "--simulator-path", paramLabel = "FILE", description = "The native program. Default: the one that "
            + "the environment variable " + SimulatorLocator.VARIABLE
            + " names, else the one installed or built with this program, else "
            + "natator-sim on the PATH or in ~/.local/bin, else build/release/bin/natator-sim.")
    private Path path;

    /** See {@link SimulatorLocator#locate}. */
    Path path() throws InterruptedException {
        return SimulatorLocator.locate(path);
    }
}
