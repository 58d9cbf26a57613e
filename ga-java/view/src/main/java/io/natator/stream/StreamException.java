package io.natator.stream;

import java.io.IOException;

/** A stream that breaks its protocol, or that ended though it should not have; the message says how in one line. */
public final class StreamException extends IOException {

    private static final long serialVersionUID = 1L;

    private final boolean atEnd;

    StreamException(String message) {
        this(message, null, false);
    }

    StreamException(String message, Throwable cause) {
        this(message, cause, false);
    }

    private StreamException(String message, Throwable cause, boolean atEnd) {
        super(message, cause);
        this.atEnd = atEnd;
    }

    /** For a stream that ended within a message. */
    static StreamException atEnd(String message) {
        return new StreamException(message, null, true);
    }

    /** Whether the stream ended, within a message. */
    boolean isAtEnd() {
        return atEnd;
    }
}
