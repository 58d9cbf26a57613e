package io.natator.process;

import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;

/** A request of a call, and where its result goes. */
record BatchJob(SimulationRequest request, Call call) {

    /** What came of a job: a result, or that its request is wrong. */
    record Reply(SimulationResult result, RequestRejectedException rejection) {
    }

    /** Who asked, and waits for replies. */
    static final class Call {
        private final BlockingQueue<Reply> replies = new LinkedBlockingQueue<>();
        private volatile boolean abandoned;

        BlockingQueue<Reply> replies() {
            return replies;
        }

        /** Its jobs that nobody has begun need not be done. */
        void abandon() {
            abandoned = true;
        }
    }

    boolean isAbandoned() {
        return call.abandoned;
    }

    void done(SimulationResult result) {
        call.replies.add(new Reply(result.withId(request.id()), null));
    }

    void rejected(RequestRejectedException reason) {
        call.replies.add(new Reply(null, reason));
    }
}
