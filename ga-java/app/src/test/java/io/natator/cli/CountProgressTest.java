package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import org.junit.jupiter.api.Test;

class CountProgressTest {

    private final AtomicLong clock = new AtomicLong();
    private final StringWriter out = new StringWriter();
    private final CountProgress progress = new CountProgress(new PrintWriter(out), clock::get);

    private void done(int seconds) {
        clock.addAndGet(TimeUnit.SECONDS.toNanos(seconds));
        progress.done();
    }

    @Test
    void whatBecomesKnownIsCountedToo() {
        progress.expect(2);
        done(11);
        done(11);
        progress.expect(3);
        done(11);

        assertThat(out.toString().lines()).containsExactly("1 of 2", "2 of 2", "3 of 5");
        assertThat(progress.all()).isEqualTo(5);
    }

    @Test
    void isToldEveryTenSecondsOnly() {
        progress.expect(4);
        done(6);
        done(6);
        done(6);
        done(6);

        assertThat(out.toString().lines()).containsExactly("2 of 4", "4 of 4");
    }
}
