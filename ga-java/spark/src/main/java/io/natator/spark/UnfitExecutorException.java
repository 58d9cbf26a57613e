package io.natator.spark;

/** This executor cannot do, or would do otherwise, what it was asked; another one may. The message says where and why. */
final class UnfitExecutorException extends Exception {

    private static final long serialVersionUID = 1L;

    UnfitExecutorException(String message) {
        super(message);
    }

    UnfitExecutorException(String message, Throwable cause) {
        super(message, cause);
    }
}
