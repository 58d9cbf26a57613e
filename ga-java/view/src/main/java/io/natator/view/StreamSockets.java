package io.natator.view;

import io.javalin.websocket.WsConfig;
import io.javalin.websocket.WsContext;
import java.nio.file.Path;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.function.Function;
import org.eclipse.jetty.websocket.api.StatusCode;

/** All sockets, each with a session of its own, and no more than {@value #MAX_SESSIONS} at a time. */
final class StreamSockets implements AutoCloseable {

    static final int MAX_SESSIONS = 4;
    /** A page that is loaded anew opens its socket before the end of the old one is noticed. */
    private static final long PATIENCE_SECONDS = 5;
    private static final long PING_SECONDS = 15;

    private final Path simulator;
    private final Set<String> files;
    private final Function<String, Path> policies;
    private final Map<String, StreamSession> sessions = new ConcurrentHashMap<>();
    private final Semaphore free = new Semaphore(MAX_SESSIONS, true);

    /** See {@link StreamSession}. */
    StreamSockets(Path simulator, Set<String> files, Function<String, Path> policies) {
        this.simulator = simulator;
        this.files = files;
        this.policies = policies;
    }

    /** What happens at a socket. */
    void handle(WsConfig socket) {
        socket.onConnect(this::open);
        socket.onMessage(message -> {
            StreamSession session = sessions.get(message.sessionId());
            if (session != null) {
                session.receive(message.message());
            }
        });
        socket.onBinaryMessage(message -> message.closeSession(StatusCode.BAD_DATA, "expected text"));
        socket.onClose(this::end);
        socket.onError(this::end);
    }

    /** Those that are open. */
    Collection<StreamSession> sessions() {
        return List.copyOf(sessions.values());
    }

    private void open(WsContext context) throws InterruptedException {
        if (!free.tryAcquire(PATIENCE_SECONDS, TimeUnit.SECONDS)) {
            context.closeSession(StatusCode.TRY_AGAIN_LATER, MAX_SESSIONS + " simulations run already; close a page");
            return;
        }
        // Tells a page that is paused from one that has gone.
        context.enableAutomaticPings(PING_SECONDS, TimeUnit.SECONDS);
        sessions.put(context.sessionId(), new StreamSession(context.session, simulator, files, policies));
    }

    private void end(WsContext context) {
        StreamSession session = sessions.remove(context.sessionId());
        if (session != null) {
            session.close();
            free.release();
        }
    }

    @Override
    public void close() {
        sessions.values().forEach(StreamSession::close);
    }
}
