package io.natator.stream;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;

/**
 * The body of a {@code FRAM}: all particles at one time. The arrays are not copied.
 *
 * @param scene            number of the {@link StreamScene} that it belongs to
 * @param frame            since the start; 0 = settled start
 * @param dropped          frames since the start that there was no credit for
 * @param running          whether the simulation goes on by itself
 * @param touchesPlane     whether a particle of the body touches a plane
 * @param time             since the start, s
 * @param frameSeconds     wall time that the simulation of one frame takes, s
 * @param distance         change of the body's mean x since the start, length
 * @param centreVelocity   of the body's centre of mass, x, y, z, length/s
 * @param linearMomentum   as {@code laws} of a result has it
 * @param angularMomentum  likewise
 * @param meanDensityError likewise
 * @param maxDensityError  likewise
 * @param activation       a u of each actuator, without unit
 * @param position         x, y, z of each particle in turn, length; empty if the scene's fields lack it
 * @param velocity         likewise, length/s
 * @param density          of each particle in rest densities, 0 for solids; empty if the scene's fields lack it
 */
public record StreamFrame(long scene, long frame, long dropped, boolean running, boolean touchesPlane, double time,
        double frameSeconds, double distance, float[] centreVelocity, float linearMomentum, float angularMomentum,
        float meanDensityError, float maxDensityError, float[] activation, float[] position, float[] velocity,
        float[] density) {

    /** What comes before the actuators. */
    static final int HEAD_BYTES = 72;
    private static final int RUNNING = 1;
    private static final int TOUCHES_PLANE = 2;

    /** Decodes a body whose length is the scene's {@link StreamScene#frameBytes()}. */
    static StreamFrame decode(StreamScene scene, ByteBuffer body) {
        ByteBuffer in = body.duplicate().order(ByteOrder.LITTLE_ENDIAN);
        long number = Integer.toUnsignedLong(in.getInt());
        long frame = Integer.toUnsignedLong(in.getInt());
        long dropped = Integer.toUnsignedLong(in.getInt());
        int flags = in.getInt();
        double time = in.getDouble();
        double frameSeconds = in.getDouble();
        double distance = in.getDouble();
        float[] velocity = floats(in, 3);
        float[] laws = floats(in, 4);
        in.getInt();
        return new StreamFrame(number, frame, dropped, (flags & RUNNING) != 0, (flags & TOUCHES_PLANE) != 0, time,
                frameSeconds, distance, velocity, laws[0], laws[1], laws[2], laws[3], floats(in, scene.actuators()),
                field(in, scene, StreamField.POSITION), field(in, scene, StreamField.VELOCITY),
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
