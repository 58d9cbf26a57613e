package io.natator.protocol;

/** The simulator says that the request cannot be carried out, or cannot be started; trying again would not help. */
public class RequestRejectedException extends RuntimeException {

    private static final long serialVersionUID = 1L;

    private final boolean badInput;

    /**
     * A refusal.
     *
     * @param badInput whether the fault lies in the request
     */
    public RequestRejectedException(String message, boolean badInput) {
        super(message);
        this.badInput = badInput;
    }

    /** Whether the fault lies in the request (the simulator's exit status 2), not in the machine it runs on. */
    public boolean isBadInput() {
        return badInput;
    }

    /**
     * For those who can do without what was refused, but not without a machine.
     *
     * @throws RequestRejectedException this one, unless the fault lies in the request
     */
    public void throwUnlessBadInput() {
        if (!badInput) {
            throw this;
        }
    }
}
