package io.natator.protocol;

import io.natator.base.InvalidInputException;

/** The simulator works, but does not take a scene; the message says why. */
public final class RefusedSceneException extends InvalidInputException {

    private static final long serialVersionUID = 1L;

    /** A refusal in these words. */
    public RefusedSceneException(String message) {
        super(message);
    }
}
