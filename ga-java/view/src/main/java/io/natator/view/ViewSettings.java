package io.natator.view;

import io.natator.encoding.Gait;
import java.nio.file.Path;
import java.util.List;
import java.util.function.Function;

/**
 * What is served, and where.
 *
 * @param simulator the native program
 * @param host      name or address to listen at
 * @param port      0 for any that is free
 * @param start     what is shown first
 * @param known     the gait that the page offers in a scene of this name, or null
 * @param runs      run folders that may be looked at; the page knows them by their place in this list
 * @param policy    file of a policy that drives the swimmer that is shown first, or null
 */
public record ViewSettings(Path simulator, String host, int port, InitialScene start, Function<String, Gait> known,
        List<Path> runs, Path policy) {

    /** The address of this machine that no other can reach. */
    public static final String LOOPBACK = "127.0.0.1";

    /** Copies the list. */
    public ViewSettings {
        runs = List.copyOf(runs);
    }
}
