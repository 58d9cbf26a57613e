package io.natator.plot;

import java.io.IOException;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** What draws with Java's graphics. A Java without fonts, or without the libraries that read them, throws errors of many kinds. */
public final class Drawing {

    private static final Logger LOG = LoggerFactory.getLogger(Drawing.class);
    /** What was said: a process may end many runs. */
    private static final Set<String> WARNINGS = ConcurrentHashMap.newKeySet();

    private Drawing() {
    }

    /**
     * Draws and writes.
     *
     * @param <E> what else it may throw
     */
    @FunctionalInterface
    public interface Task<E extends Exception> {

        /** Does it. */
        void draw() throws IOException, E;
    }

    /** Java cannot draw; the message says what is missing and what to install. */
    private static final class CannotDrawException extends IOException {

        private static final long serialVersionUID = 1;

        CannotDrawException(Error error) {
            super("Java finds no fonts, or no library that reads them (" + reason(error) + "); install fontconfig and a font "
                    + "package, in Debian and Ubuntu by apt-get install fontconfig fonts-dejavu-core", error);
        }

        /** What was wrong at first, on one line. */
        private static String reason(Throwable error) {
            Throwable first = error;
            while (first.getCause() != null) {
                first = first.getCause();
            }
            return String.valueOf(first.getMessage() == null ? first : first.getMessage()).replaceAll(" *\\[in thread \"[^\"]*\"]", "").strip()
                    .replaceAll("\\s*\\R\\s*", " | ");
        }
    }

    /**
     * Draws.
     *
     * @param <E> what else it may throw
     * @throws IOException that says in words what Java lacks, too
     */
    public static <E extends Exception> void checked(Task<E> task) throws IOException, E {
        try {
            task.draw();
        } catch (LinkageError | InternalError e) {
            throw new CannotDrawException(e);
        }
    }

    /**
     * Draws what can be done without: if Java cannot, a warning says so, the first time.
     *
     * @param <E>  what else it may throw
     * @param what is drawn, for the warning
     * @throws IOException if a file cannot be written
     */
    public static <E extends Exception> void orWarn(String what, Task<E> task) throws IOException, E {
        try {
            checked(task);
        } catch (CannotDrawException e) {
            String warning = what + " not drawn: " + e.getMessage();
            if (WARNINGS.add(warning)) {
                LOG.warn(warning);
            }
        }
    }
}
