package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.kinematics.Attitude;
import io.natator.kinematics.BodyPath;
import io.natator.kinematics.ModeFit;
import io.natator.kinematics.SpinePath;
import io.natator.kinematics.Swimming;
import io.natator.simulator.SimulationRequest;
import java.util.Arrays;
import java.util.List;

/**
 * How a recorded run moved; a line of {@code motions.jsonl}.
 *
 * @param program     SHA-256 of the native program that ran it
 * @param request     what was run; its id is 0
 * @param simulated   seconds recorded
 * @param speed       change of mean x over that time, scene units per second
 * @param bodyLength  head to tail at rest, scene units
 * @param tailSwing   a(x) at the end of the measured spine with the roll taken out, in body lengths
 * @param fits        e, α and β against the three modes, as in the thesis: sideways is z
 * @param fitsOfBody  the same with the body's roll taken out: sideways is the body's own side
 * @param end         attitude at the end, radians
 * @param largestYaw  largest turn about y on the way, radians
 * @param heights     y of the body's centre at the start and at the end
 * @param measuredPart share of the body that a(x) and e are taken over: the shortest spine by the spine at rest
 * @param underWater  share of the body's particles below the water's level, halfway; null without water
 */
record SwimKinematics(@JsonProperty(required = true) String program,
        @JsonProperty(required = true) SimulationRequest request,
        double simulated, double speed, double bodyLength, double tailSwing, List<ModeFit> fits,
        List<ModeFit> fitsOfBody, Attitude end, double largestYaw, List<Double> heights, double measuredPart,
        Double underWater) implements RequestLog.Answer {

    /**
     * Measures a recorded path; the fits to real fish need a gait with a frequency.
     *
     * @param underWater share of the body below the water's level, or null
     */
    static SwimKinematics of(String program, SimulationRequest request, BodyPath path, Double underWater) {
        SpinePath spine = path.spine();
        Swimming swimming = new Swimming(spine);
        int last = spine.frames() - 1;
        double[][] start = path.particles()[0];
        List<Attitude> attitude = Arrays.stream(path.particles()).map(now -> Attitude.of(start, now)).toList();
        double largestYaw = attitude.stream().mapToDouble(one -> Math.abs(one.yaw())).max().orElseThrow();
        Swimming upright = new Swimming(spine.unrolled(attitude));
        double simulated = path.times()[last] - path.times()[0];
        double length = spine.restLength();
        return new SwimKinematics(program, request, simulated,
                simulated > 0 ? (path.centre(last)[0] - path.centre(0)[0]) / simulated : 0, length,
                upright.envelope(upright.measuredLength()) / length,
                ModeFit.all(swimming, request.gait().frequency()), ModeFit.all(upright, request.gait().frequency()),
                attitude.get(last), largestYaw, List.of(path.centre(0)[1], path.centre(last)[1]),
                upright.measuredLength() / length, underWater);
    }
}
