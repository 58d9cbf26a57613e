package io.natator.replay;

import java.io.ByteArrayOutputStream;

/**
 * Tables of whole numbers, one row for each time, as bytes that compress well: what differs from the row before, or from
 * what the two rows before lead one to expect, least significant bytes first, all of them of one column after another.
 *
 * <p>Bytes of a row: for each column, {@code bytes} times the lowest, next … byte of every number. A number is
 * sign-folded (0, −1, 1, −2 … as 0, 1, 2, 3 …) and taken modulo 256 to the power of {@code bytes}.
 */
final class TimeCode {

    /** How much of the last change is expected to happen again. */
    enum Expectation {
        /** Nothing: a number stays as it is. */
        SAME,
        /** All of it: a number goes on as it went. */
        STEADY
    }

    private TimeCode() {
    }

    /**
     * Codes a table.
     *
     * @param rows  for each time, all numbers of the first column, then of the next
     * @param bytes of each number, 1 to 4; all numbers must be from 0 to below 256 to that power
     */
    static byte[] encode(int[][] rows, int bytes, Expectation expectation) {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        for (int time = 0; time < rows.length; time++) {
            byte[] planes = new byte[bytes * rows[time].length];
            for (int i = 0; i < rows[time].length; i++) {
                int folded = folded(rows[time][i] - expected(rows, time, i, expectation), bytes);
                for (int plane = 0; plane < bytes; plane++) {
                    planes[plane * rows[time].length + i] = (byte) (folded >>> 8 * plane);
                }
            }
            out.writeBytes(planes);
        }
        return out.toByteArray();
    }

    private static int expected(int[][] rows, int time, int i, Expectation expectation) {
        if (time == 0) {
            return 0;
        }
        int last = rows[time - 1][i];
        return expectation == Expectation.SAME || time == 1 ? last : 2 * last - rows[time - 2][i];
    }

    /** The difference, which is known modulo 256^bytes, as the one nearest to 0, sign-folded. */
    private static int folded(int difference, int bytes) {
        int unused = Integer.SIZE - 8 * bytes;
        int nearest = difference << unused >> unused;
        return (nearest << 1 ^ nearest >> Integer.SIZE - 1) & mask(bytes);
    }

    private static int mask(int bytes) {
        return bytes == Integer.BYTES ? -1 : (1 << 8 * bytes) - 1;
    }
}
