package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import io.natator.stream.StreamException;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamProcess;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.locks.ReentrantLock;
import java.util.function.Consumer;
import java.util.function.Function;
import org.eclipse.jetty.websocket.api.Callback;
import org.eclipse.jetty.websocket.api.Session;
import org.eclipse.jetty.websocket.api.StatusCode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * One socket and its simulator. Commands go up as they come, messages go down one by one: the next one is read from the
 * simulator when the last one is sent. So nothing is queued here, and a page that takes nothing holds up its simulator.
 * A simulator that dies is replaced, unless that has happened too often.
 */
final class StreamSession implements AutoCloseable {

    private static final Logger LOG = LoggerFactory.getLogger(StreamSession.class);
    private static final int MAX_RESTARTS = 3;
    private static final int MAX_REASON_BYTES = 100;
    private static final long WITHIN_NANOSECONDS = 60_000_000_000L;

    final Session socket;
    private final Path simulator;
    private final Set<String> files;
    private final Function<String, Path> policies;
    private final ReentrantLock sending = new ReentrantLock();
    private final Deque<Long> deaths = new ArrayDeque<>();
    /** Scenes that were saved since the page was told of them. */
    private final Set<String> untold = new LinkedHashSet<>();
    private boolean telling;
    private SessionState course;
    private StreamProcess process;
    private boolean closed;

    /** The socket cannot be written to any more. */
    private static final class SocketGoneException extends Exception {
        private static final long serialVersionUID = 1L;

        SocketGoneException(Throwable cause) {
            super(cause);
        }
    }

    /**
     * A session that waits for the command that starts its simulator.
     *
     * @param files    that commands may name; see {@link ClientCommand#check}
     * @param policies that drive the swimmer of a scene, or null
     */
    StreamSession(Session socket, Path simulator, Set<String> files, Function<String, Path> policies) {
        this.socket = socket;
        this.simulator = simulator;
        this.files = files;
        this.policies = policies;
    }

    /** Takes a command. Waits while an answer of the server's own cannot be sent. */
    void receive(String text) {
        JsonNode id = null;
        try {
            ClientCommand command = ClientCommand.read(text);
            id = command.id();
            command.check(files);
            pass(command);
        } catch (InvalidInputException | RequestRejectedException e) {
            refuse(id, e.getMessage());
        } catch (RuntimeException | StackOverflowError e) {
            // One bad command is not to cost the page its simulation.
            LOG.error("command: {}", e, e);
            refuse(id, "internal error");
        } catch (StreamException e) {
            socket.close(StatusCode.POLICY_VIOLATION, shortened(e.getMessage()), Callback.NOOP);
        }
    }

    private void refuse(JsonNode id, String error) {
        Map<String, Object> answer = new LinkedHashMap<>();
        answer.put("id", id);
        answer.put("error", error);
        sendUnlessGone("ANSW", answer);
    }

    private synchronized void pass(ClientCommand command) throws StreamException {
        if (command.what().equals(ClientCommand.START)) {
            if (course != null) {
                throw new InvalidInputException("start: a simulation runs already; expected scene");
            }
            begin(command);
        } else if (course == null) {
            throw new InvalidInputException(command.what() + ": no simulation runs; expected start");
        } else {
            course.follow(command);
            process.send(command.content());
        }
    }

    private void begin(ClientCommand start) throws StreamException {
        boolean started = false;
        course = new SessionState(start, policies.apply(start.scene()));
        try {
            started = startProcess();
        } finally {
            course = started ? course : null;
        }
        if (started) {
            Thread pump = new Thread(this::pump, "view-stream");
            pump.setDaemon(true);
            pump.start();
        }
    }

    /** Starts a simulator on the course, unless the session is closed. */
    private synchronized boolean startProcess() throws StreamException {
        if (closed) {
            return false;
        }
        try {
            process = new StreamProcess(simulator, course.options());
        } catch (InterruptedException e) {
            return false;
        }
        course.takeUp(process);
        return true;
    }

    /** Takes the simulator's messages to the page for as long as there is one. */
    private void pump() {
        try {
            boolean restarted = true;
            while (restarted) {
                String reason = untilDeath();
                restarted = reason != null && restart(reason);
            }
        } catch (SocketGoneException e) {
            close();
        } catch (RuntimeException | StackOverflowError e) {
            LOG.error("simulation: {}", e, e);
            close();
            socket.close(StatusCode.SERVER_ERROR, "internal error", Callback.NOOP);
        }
    }

    /** Why the simulator has ended; null if it was to. */
    private String untilDeath() throws SocketGoneException {
        StreamProcess running;
        synchronized (this) {
            running = process;
        }
        try (running) {
            for (StreamMessage message = running.next(); message != null; message = running.next()) {
                forward(message);
            }
            return isClosed() ? null : "simulator ended";
        } catch (InvalidInputException e) {
            forget();
            lost(e.getMessage(), false);
            return null;
        } catch (IOException e) {
            return isClosed() ? null : e.getMessage();
        }
    }

    /** Replaces the simulator, then tells the page: what it sends after that is for the new one. */
    private boolean restart(String reason) throws SocketGoneException {
        String why = reason;
        boolean again = false;
        try {
            again = isRestartDue() && startProcess();
        } catch (RequestRejectedException | StreamException e) {
            why += "; " + e.getMessage();
        }
        if (!again) {
            forget();
        }
        lost(why, again);
        return again;
    }

    private boolean isRestartDue() {
        long now = System.nanoTime();
        deaths.add(now);
        while (now - deaths.getFirst() > WITHIN_NANOSECONDS) {
            deaths.removeFirst();
        }
        return deaths.size() <= MAX_RESTARTS;
    }

    /** From here on the page may start another simulation. */
    private synchronized void forget() {
        course = null;
        deaths.clear();
    }

    private void forward(StreamMessage message) throws SocketGoneException {
        if (message instanceof StreamMessage.Scene scene) {
            synchronized (this) {
                course.follow(scene.scene());
            }
            send("SCEN", scene.json());
        } else if (message instanceof StreamMessage.Frame frame) {
            send(done -> socket.sendBinary(frame.body(), done));
        } else if (message instanceof StreamMessage.Water water) {
            send(done -> socket.sendBinary(withHead(water.body()), done));
        } else if (message instanceof StreamMessage.Answer answer) {
            send("ANSW", answer.json());
        } else if (message instanceof StreamMessage.Stop stop) {
            send("STOP", stop.json());
        }
    }

    /** With the head that it had in the stream, which tells it from a frame: those go without. */
    private static ByteBuffer withHead(ByteBuffer body) {
        return ByteBuffer.allocate(8 + body.remaining()).order(ByteOrder.LITTLE_ENDIAN)
                .put("WATR".getBytes(StandardCharsets.US_ASCII)).putInt(body.remaining()).put(body.duplicate()).flip();
    }

    private void lost(String reason, boolean restarted) throws SocketGoneException {
        Map<String, Object> body = new LinkedHashMap<>();
        body.put("reason", reason);
        body.put("restarted", restarted);
        send("LOST", Json.line(body));
    }

    /**
     * Tells the page of a scene whose file was saved; whether and how it reads it again is the page's. Does not wait: what is saved
     * again while the page takes nothing is told once.
     */
    void saved(String scene) {
        synchronized (untold) {
            untold.add(scene);
            if (telling) {
                return;
            }
            telling = true;
        }
        Thread teller = new Thread(this::tellSaved, "view-saved");
        teller.setDaemon(true);
        teller.start();
    }

    private void tellSaved() {
        for (String scene = nextUntold(); scene != null; scene = nextUntold()) {
            sendUnlessGone("SAVED", Map.of("scene", scene));
        }
    }

    private String nextUntold() {
        synchronized (untold) {
            Iterator<String> left = untold.iterator();
            telling = left.hasNext();
            String next = telling ? left.next() : null;
            untold.remove(next);
            return next;
        }
    }

    private void sendUnlessGone(String type, Object body) {
        try {
            send(type, Json.line(body));
        } catch (SocketGoneException e) {
            close();
        }
    }

    private void send(String type, String json) throws SocketGoneException {
        String text = "{\"type\":\"" + type + "\",\"body\":" + json + "}";
        send(done -> socket.sendText(text, done));
    }

    /** Sends and waits until it is sent; one message at a time. */
    private void send(Consumer<Callback> message) throws SocketGoneException {
        Callback.Completable sent = new Callback.Completable();
        sending.lock();
        try {
            message.accept(sent);
            sent.get();
        } catch (ExecutionException e) {
            throw new SocketGoneException(e.getCause());
        } catch (InterruptedException e) {
            throw new SocketGoneException(e);
        } finally {
            sending.unlock();
        }
    }

    /** The reason of a close frame has at most 123 bytes. */
    static String shortened(String reason) {
        int end = Math.min(reason.length(), MAX_REASON_BYTES);
        while (reason.substring(0, end).getBytes(StandardCharsets.UTF_8).length > MAX_REASON_BYTES) {
            end--;
        }
        return reason.substring(0, end);
    }

    private synchronized boolean isClosed() {
        return closed;
    }

    /** Ends the simulator. The socket is the caller's. */
    @Override
    public synchronized void close() {
        closed = true;
        if (process != null) {
            process.close();
        }
    }
}
