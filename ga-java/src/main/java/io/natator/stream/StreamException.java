package io.natator.stream;

import java.io.IOException;

/** A stream that breaks its protocol, or that ended though it should not have; the message says how in one line. */
public final class StreamException extends IOException {

    private static final long serialVersionUID = 1L;

    StreamException(String message) {
        super(message);
    }

    StreamException(String message, Throwable cause) {
        super(message, cause);
    }
}
