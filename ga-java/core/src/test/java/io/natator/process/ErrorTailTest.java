package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class ErrorTailTest {

    /** A program that does not buffer writes a message in pieces; whatever their size, none of the last kilobytes is lost. */
    @ParameterizedTest
    @ValueSource(ints = {1, 7, 1000, ErrorTail.KEPT_BYTES})
    void theLastKilobytesAreKept(int piece) throws IOException {
        for (int lines = 500; lines < 1500; lines += 100) {
            String all = "a long story\n".repeat(lines) + "natator-sim: disk full\n";

            String tail = ErrorTail.read(inPieces(all, piece));

            assertThat(tail).endsWith(" | a long story | natator-sim: disk full");
            assertThat(tail.replace(ErrorTail.LINE_END, "\n").length()).isBetween(ErrorTail.KEPT_BYTES - 1,
                    2 * ErrorTail.KEPT_BYTES);
        }
    }

    /** A stream that has no more than so many bytes at a time. */
    private static InputStream inPieces(String text, int most) {
        return new ByteArrayInputStream(text.getBytes(StandardCharsets.US_ASCII)) {
            @Override
            public synchronized int read(byte[] buffer, int offset, int length) {
                return super.read(buffer, offset, Math.min(length, most));
            }
        };
    }
}
