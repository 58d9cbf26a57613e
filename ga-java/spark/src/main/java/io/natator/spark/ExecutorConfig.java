package io.natator.spark;

import io.natator.config.Backend;
import io.natator.protocol.SimulationRequest;

/**
 * What an executor has to know besides the requests; crosses the wire as JSON.
 *
 * @param program        name of the native program among the files of the cluster
 * @param sha256         digest of that file
 * @param instructionSet that the program uses in the driver, or null where that does not matter
 * @param backend        what it computes on
 * @param device         number of the GPU for a task that Spark gives none
 * @param timeout        longest time for one attempt at an evaluation, ms
 * @param sample         a short swim that every executor has to do first, or null
 * @param hash           of its end, or null if that is to be found out
 * @param gpu            name of the kind of GPU, or null likewise
 */
record ExecutorConfig(String program, String sha256, String instructionSet, Backend backend, int device, long timeout,
        SimulationRequest sample, String hash, String gpu) {

    /** This mission for executors whose GPU is of that kind and swims like that. */
    ExecutorConfig like(String newHash, String newGpu) {
        return new ExecutorConfig(program, sha256, instructionSet, backend, device, timeout, sample, newHash, newGpu);
    }
}
