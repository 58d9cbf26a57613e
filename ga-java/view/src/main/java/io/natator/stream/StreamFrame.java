package io.natator.stream;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;

/**
 * What a replay keeps of a {@code FRAM}: all particles at one time. The arrays are not copied.
 *
 * @param frame            since the start; 0 = settled start
 * @param time             since the start, s
 * @param distance         change of the body's mean x since the start, length
 * @param centreVelocity   of the body's centre of mass, x, y, z, length/s
 * @param linearMomentum   as {@code laws} of a result has it
 * @param angularMomentum  likewise
 * @param meanDensityError likewise
 * @param maxDensityError  likewise
 * @param activation       a u of each actuator, without unit
 * @param position         x, y, z of each particle in turn, length; empty if the scene's fields lack it
 * @param density          of each particle in rest densities, 0 for solids; empty if the scene's fields lack it
 */
public record StreamFrame(long frame, double time, double distance, float[] centreVelocity, float linearMomentum,
        float angularMomentum, float meanDensityError, float maxDensityError, float[] activation, float[] position,
        float[] density) {

    /** What comes before the actuators. */
    static final int HEAD_BYTES = 72;
    private static final int FRAME = 4;
    private static final int TIME = 16;
    private static final int DISTANCE = 32;

    /** Decodes a body whose length is the scene's {@link StreamScene#frameBytes()}. */
    static StreamFrame decode(StreamScene scene, ByteBuffer body) {
        ByteBuffer in = body.duplicate().order(ByteOrder.LITTLE_ENDIAN);
        long frame = Integer.toUnsignedLong(in.getInt(FRAME));
        double time = in.getDouble(TIME);
        in.position(DISTANCE);
        double distance = in.getDouble();
        float[] velocity = floats(in, 3);
        float[] laws = floats(in, 4);
        in.position(HEAD_BYTES);
        float[] activation = floats(in, scene.actuators());
        float[] position = field(in, scene, StreamField.POSITION);
        field(in, scene, StreamField.VELOCITY);
        return new StreamFrame(frame, time, distance, velocity, laws[0], laws[1], laws[2], laws[3], activation,
                position,
                field(in, scene, StreamField.DENSITY));
    }

    private static float[] field(ByteBuffer in, StreamScene scene, StreamField field) {
        return floats(in, scene.has(field) ? field.components() * scene.particles() : 0);
    }

    private static float[] floats(ByteBuffer in, int count) {
        float[] values = new float[count];
        in.asFloatBuffer().get(values);
        in.position(in.position() + count * Float.BYTES);
        return values;
    }
}
