package io.natator.export;

import java.nio.ByteBuffer;
import java.nio.ByteOrder;

/** Buffers in the byte order of all binary formats here. */
final class LittleEndian {

    private LittleEndian() {
    }

    /** @throws ArithmeticException if one buffer cannot hold so much */
    static ByteBuffer buffer(long bytes) {
        return ByteBuffer.allocate(Math.toIntExact(bytes)).order(ByteOrder.LITTLE_ENDIAN);
    }

    static ByteBuffer floats(float... values) {
        ByteBuffer out = buffer((long) values.length * Float.BYTES);
        out.asFloatBuffer().put(values);
        return out;
    }

    static ByteBuffer doubles(double... values) {
        ByteBuffer out = buffer((long) values.length * Double.BYTES);
        out.asDoubleBuffer().put(values);
        return out;
    }

    static ByteBuffer ints(int... values) {
        ByteBuffer out = buffer((long) values.length * Integer.BYTES);
        out.asIntBuffer().put(values);
        return out;
    }

    static ByteBuffer longs(long... values) {
        ByteBuffer out = buffer((long) values.length * Long.BYTES);
        out.asLongBuffer().put(values);
        return out;
    }
}
