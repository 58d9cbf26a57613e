package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import java.io.ByteArrayOutputStream;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.WebSocket;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;

/** What a page does at its socket. It reads all that comes, unless it was opened as a slow one. */
public final class StreamClient implements WebSocket.Listener, AutoCloseable {

    static final HttpClient HTTP = HttpClient.newHttpClient();
    private static final long PATIENCE_SECONDS = 600;

    private final BlockingQueue<JsonNode> texts = new LinkedBlockingQueue<>();
    private final BlockingQueue<ByteBuffer> frames = new LinkedBlockingQueue<>();
    private final CompletableFuture<String> closing = new CompletableFuture<>();
    private final StringBuilder text = new StringBuilder();
    private final ByteArrayOutputStream binary = new ByteArrayOutputStream();
    private final boolean slow;
    private final WebSocket socket;

    private StreamClient(URI server, boolean slow) {
        this.slow = slow;
        String host = server.getAuthority();
        socket = HTTP.newWebSocketBuilder().header("Origin", "http://" + host)
                .buildAsync(URI.create("ws://" + host + "/stream"), this).join();
    }

    /** A page that takes what comes. */
    public static StreamClient open(URI server) {
        return new StreamClient(server, false);
    }

    /** A page that takes nothing until {@link #wake}. */
    static StreamClient openSlow(URI server) {
        return new StreamClient(server, true);
    }

    @Override
    public void onOpen(WebSocket webSocket) {
        if (!slow) {
            webSocket.request(Long.MAX_VALUE);
        }
    }

    /** From here on it takes what comes. */
    void wake() {
        socket.request(Long.MAX_VALUE);
    }

    @Override
    public CompletionStage<?> onText(WebSocket webSocket, CharSequence data, boolean last) {
        text.append(data);
        if (last) {
            try {
                texts.add(Json.parse(text.toString(), JsonNode.class));
            } catch (JsonProcessingException e) {
                closing.completeExceptionally(e);
            }
            text.setLength(0);
        }
        return null;
    }

    @Override
    public CompletionStage<?> onBinary(WebSocket webSocket, ByteBuffer data, boolean last) {
        byte[] part = new byte[data.remaining()];
        data.get(part);
        binary.writeBytes(part);
        if (last) {
            frames.add(ByteBuffer.wrap(binary.toByteArray()).order(ByteOrder.LITTLE_ENDIAN));
            binary.reset();
        }
        return null;
    }

    @Override
    public CompletionStage<?> onClose(WebSocket webSocket, int status, String reason) {
        closing.complete(status + " " + reason);
        return null;
    }

    @Override
    public void onError(WebSocket webSocket, Throwable error) {
        closing.complete("error " + error);
    }

    /** Sends a command; single quotes stand for double ones. */
    public StreamClient send(String command) {
        socket.sendText(command.replace('\'', '"'), true).join();
        return this;
    }

    /** Sends what no page does. */
    void sendBinary() {
        socket.sendBinary(ByteBuffer.allocate(8), true).join();
    }

    /** Starts a scene. */
    StreamClient start(String scene, String gait, boolean paused) {
        return send("{'do':'start','scene':'" + scene + "','overrides':null,'gait':" + gait + ",'options':{'paused':"
                + paused + "}}");
    }

    /** The next message: type and body. */
    public JsonNode next() throws InterruptedException {
        JsonNode next = texts.poll(PATIENCE_SECONDS, TimeUnit.SECONDS);
        assertThat(next).as("a message; the socket: %s", closing).isNotNull();
        return next;
    }

    /** The body of the next message of a type; others before it are passed over. */
    JsonNode await(String type) throws InterruptedException {
        JsonNode next = next();
        while (!next.get("type").textValue().equals(type)) {
            next = next();
        }
        return next.get("body");
    }

    /** The next frame. */
    public ByteBuffer awaitFrame() throws InterruptedException {
        ByteBuffer frame = frames.poll(PATIENCE_SECONDS, TimeUnit.SECONDS);
        assertThat(frame).as("a frame; the socket: %s", closing).isNotNull();
        return frame;
    }

    /** Frames that came and were not taken. */
    int waitingFrames() {
        return frames.size();
    }

    /** Status and reason with which the server closes the socket. */
    String awaitClose() {
        return closing.orTimeout(PATIENCE_SECONDS, TimeUnit.SECONDS).join();
    }

    @Override
    public void close() {
        socket.abort();
    }
}
