package io.natator.plot;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import ch.qos.logback.classic.Logger;
import ch.qos.logback.classic.spi.ILoggingEvent;
import ch.qos.logback.core.read.ListAppender;
import java.io.IOException;
import java.lang.reflect.InvocationTargetException;
import java.nio.file.NoSuchFileException;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.slf4j.LoggerFactory;

/** Errors are those of OpenJDK 17: without font files, and, at the second try, without libfreetype. */
class DrawingTest {

    private static final String ADVICE = "; install fontconfig and a font package, in Debian and Ubuntu by apt-get install "
            + "fontconfig fonts-dejavu-core";

    private static void withoutFonts() {
        throw new InternalError(new InvocationTargetException(
                new RuntimeException("Fontconfig head is null,\ncheck your fonts or fonts configuration")));
    }

    private static void withoutLibrary() {
        throw (Error) new NoClassDefFoundError("Could not initialize class sun.awt.X11FontManager")
                .initCause(new UnsatisfiedLinkError("libfreetype.so.6: cannot open shared object file"));
    }

    /** What Java throws when it tries a second time. */
    private static void inAnotherThread() {
        throw new NoClassDefFoundError("libfreetype.so.6: cannot open shared object file [in thread \"pool-1-thread-2\"]");
    }

    private static List<String> warnings(Drawing.Task<RuntimeException> task) throws IOException {
        Logger logger = (Logger) LoggerFactory.getLogger(Drawing.class);
        ListAppender<ILoggingEvent> seen = new ListAppender<>();
        seen.start();
        logger.addAppender(seen);
        try {
            Drawing.orWarn("fitness curve", task);
        } finally {
            logger.detachAppender(seen);
        }
        return seen.list.stream().map(ILoggingEvent::getFormattedMessage).toList();
    }

    @Test
    void oneLineSaysWhatIsMissingAndWhatToInstall() throws IOException {
        assertThat(warnings(DrawingTest::withoutFonts)).containsExactly("fitness curve not drawn: Java finds no fonts, or no library that reads "
                + "them (Fontconfig head is null, | check your fonts or fonts configuration)" + ADVICE);
        assertThat(warnings(DrawingTest::withoutLibrary)).containsExactly("fitness curve not drawn: Java finds no fonts, or no library that reads "
                + "them (libfreetype.so.6: cannot open shared object file)" + ADVICE);
        assertThat(warnings(DrawingTest::withoutFonts)).as("said before").isEmpty();
        assertThat(warnings(DrawingTest::inAnotherThread)).as("said before, by another thread").isEmpty();
        assertThat(warnings(() -> { })).isEmpty();
    }

    @Test
    void whoCannotDoWithoutThePictureGetsTheSameWords() {
        assertThatThrownBy(() -> Drawing.checked(DrawingTest::withoutFonts)).isInstanceOf(IOException.class)
                .hasMessageStartingWith("Java finds no fonts").hasMessageEndingWith(ADVICE);
    }

    @Test
    void otherErrorsAreNotAboutFonts() {
        assertThatThrownBy(() -> warnings(() -> {
            throw new NoSuchFileException("plots");
        })).isInstanceOf(NoSuchFileException.class);
        assertThatThrownBy(() -> warnings(() -> {
            throw new OutOfMemoryError();
        })).isInstanceOf(OutOfMemoryError.class);
    }
}
