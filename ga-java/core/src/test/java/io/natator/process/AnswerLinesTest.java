package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayInputStream;
import java.io.InputStream;
import java.io.SequenceInputStream;
import java.nio.charset.StandardCharsets;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class AnswerLinesTest {

    private final AtomicInteger kills = new AtomicInteger();

    private AnswerLines read(InputStream stdout) throws InterruptedException {
        AnswerLines lines = new AnswerLines(stdout, kills::incrementAndGet);
        Thread reader = new Thread(lines);
        reader.setUncaughtExceptionHandler((thread, error) -> {
        });
        reader.start();
        reader.join(TimeUnit.MINUTES.toMillis(5));
        assertThat(reader.isAlive()).isFalse();
        return lines;
    }

    private static InputStream text(String text) {
        return new ByteArrayInputStream(text.getBytes(StandardCharsets.UTF_8));
    }

    @Test
    void linesComeInOrderAndThenTheEnd() throws InterruptedException {
        AnswerLines lines = read(text("one\n\ntwo\n"));

        for (String expected : new String[] {"one", "", "two"}) {
            assertThat(lines.poll(0)).isEqualTo(new AnswerLines.Line(expected, null));
        }
        assertThat(lines.poll(0)).isEqualTo(new AnswerLines.Line(null, "output ended"));
        assertThat(kills).hasValue(0);
    }

    /** Whoever waits would wait for all the time that an answer may take, while nobody reads. */
    @ParameterizedTest
    @ValueSource(classes = {OutOfMemoryError.class, AssertionError.class, IllegalStateException.class})
    void whatEndsTheReaderIsToldAtOnceAndEndsTheProgram(Class<? extends Throwable> kind) throws InterruptedException {
        InputStream faulty = new InputStream() {
            @Override
            public int read() {
                throw AnswerLinesTest.<RuntimeException>thrown(kind);
            }
        };

        AnswerLines lines = read(new SequenceInputStream(text("one\n"), faulty));

        assertThat(lines.poll(0)).isEqualTo(new AnswerLines.Line("one", null));
        assertThat(lines.poll(0))
                .isEqualTo(new AnswerLines.Line(null, "output not readable: \"" + kind.getName() + "\""));
        assertThat(kills).hasValue(1);
    }

    /** Throws one of that kind, checked or not. */
    @SuppressWarnings("unchecked")
    private static <T extends Throwable> T thrown(Class<? extends Throwable> kind) throws T {
        try {
            throw (T) kind.getConstructor().newInstance();
        } catch (ReflectiveOperationException e) {
            throw new IllegalArgumentException(e);
        }
    }
}
