package io.natator.protocol;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.Json;

/** Reads the simulator's answers, and trusts none that contradicts the protocol. */
public final class ResultReader {

    private static final int SHOWN_CHARACTERS = 80;

    private ResultReader() {
    }

    /**
     * Reads a result: status ok with a finite distance, unstable, or error with its reason.
     *
     * @throws SimulatorFailure if the text is no such thing
     */
    public static SimulationResult read(String text) throws SimulatorFailure {
        SimulationResult result;
        try {
            result = Json.parse(text, SimulationResult.class);
        } catch (JsonProcessingException e) {
            throw new SimulatorFailure("no valid result: " + Json.reason(e) + "; output " + shown(text), e);
        }
        String fault = faultOf(result);
        if (fault != null) {
            throw new SimulatorFailure("no valid result: " + fault + "; output " + shown(text));
        }
        return result;
    }

    private static String faultOf(SimulationResult result) {
        if (result.status() == SimulationResult.Status.ERROR) {
            return result.error() == null ? "error without a reason" : null;
        }
        if (result.id() == null) {
            return "no id";
        }
        if (result.status() == SimulationResult.Status.OK) {
            return !Double.isFinite(result.distance()) ? "no finite distance"
                    : !(result.simulated() >= 0) ? "no simulated time" : null;
        }
        return result.status() == SimulationResult.Status.UNSTABLE ? null : "status " + result.status();
    }

    /** The beginning of an answer, quoted, on one line. */
    public static String shown(String text) {
        String stripped = text.strip();
        String start = stripped.length() <= SHOWN_CHARACTERS ? stripped : stripped.substring(0, SHOWN_CHARACTERS) + "…";
        return "\"" + start.replaceAll("\\R", " | ").replaceAll("\\p{Cntrl}", "�") + "\"";
    }
}
