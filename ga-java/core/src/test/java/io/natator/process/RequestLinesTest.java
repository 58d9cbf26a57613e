package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;

class RequestLinesTest {

    private final List<String> told = new ArrayList<>();

    private void write(OutputStream stdin) {
        RequestLines requests = new RequestLines(stdin, told::add);
        requests.add("{}\n");
        requests.add("{}\n{}\n");
        requests.close();
        requests.run();
    }

    /** A program's input that fails, and tells when it is closed. */
    private final class Faulty extends OutputStream {

        private final Throwable fault;

        Faulty(Throwable fault) {
            this.fault = fault;
        }

        @Override
        public void write(int one) throws IOException {
            if (fault instanceof IOException closed) {
                throw closed;
            }
            throw (Error) fault;
        }

        @Override
        public void close() {
            told.add("closed");
        }
    }

    @Test
    void allLinesAreWritten() {
        ByteArrayOutputStream stdin = new ByteArrayOutputStream();
        write(stdin);

        assertThat(stdin.toString()).isEqualTo("{}\n{}\n{}\n");
        assertThat(told).isEmpty();
    }

    /** Whoever waits would wait for all the time that an answer may take, for requests that nobody writes. */
    @Test
    void whatEndsTheWriterIsToldBeforeTheProgramFindsItsInputAtAnEnd() {
        write(new Faulty(new OutOfMemoryError("Java heap space")));

        assertThat(told).containsExactly("input not writable: \"java.lang.OutOfMemoryError: Java heap space\"",
                "closed");
    }

    @Test
    void aProgramThatDoesNotReadOnTellsWhyByItself() {
        write(new Faulty(new IOException("Broken pipe")));

        assertThat(told).containsExactly("closed");
    }
}
