package io.natator.base;

/** Bad usage or input: the message is one line that says what, where and what was expected. Exit status 2. */
public class InvalidInputException extends RuntimeException {

    private static final long serialVersionUID = 1L;

    /** Input that is wrong by itself. */
    public InvalidInputException(String message) {
        super(message);
    }

    /** Input that could not be read. */
    public InvalidInputException(String message, Throwable cause) {
        super(message, cause);
    }
}
