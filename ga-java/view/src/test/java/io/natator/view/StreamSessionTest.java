package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;

import java.lang.reflect.Proxy;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArrayList;
import org.eclipse.jetty.websocket.api.Callback;
import org.eclipse.jetty.websocket.api.Session;
import org.junit.jupiter.api.Test;
import io.natator.process.Processes;

/** A session with a page that takes what it is sent when the test says so. */
class StreamSessionTest {

    private final List<String> sent = new CopyOnWriteArrayList<>();
    private final List<Callback> done = new CopyOnWriteArrayList<>();
    private final Session socket = (Session) Proxy.newProxyInstance(Session.class.getClassLoader(),
            new Class<?>[] {Session.class}, (proxy, method, arguments) -> {
                if (method.getName().equals("sendText")) {
                    sent.add((String) arguments[0]);
                    done.add((Callback) arguments[1]);
                }
                return null;
            });
    private final StreamSession session = new StreamSession(socket, Path.of("none"), Set.of(), scene -> null);

    private static long tellers() {
        return Thread.getAllStackTraces().keySet().stream().filter(thread -> thread.getName().equals("view-saved"))
                .count();
    }

    @Test
    void aPageThatTakesNothingCostsOneThreadHoweverOftenAFileIsSaved() throws InterruptedException {
        long before = tellers();
        session.saved("a.json");
        Processes.await("the first is sent", () -> sent.size() == 1);
        for (int i = 0; i < 1000; i++) {
            session.saved(i % 2 == 0 ? "a.json" : "b.json");
        }
        assertThat(tellers() - before).isEqualTo(1);

        for (int taken = 0; taken < 3; taken++) {
            int next = taken;
            Processes.await("the next is sent", () -> done.size() > next);
            done.get(next).succeed();
        }
        Processes.await("all is told", () -> tellers() == before);
        assertThat(sent).hasSize(3);
        assertThat(sent.subList(1, 3)).anyMatch(text -> text.contains("a.json"))
                .anyMatch(text -> text.contains("b.json"));

        session.saved("a.json");
        Processes.await("a later one is sent", () -> sent.size() == 4);
        done.get(3).succeed();
    }

    @Test
    void theReasonOfACloseFrameFits() {
        for (String reason : new String[] {"x".repeat(500), "é".repeat(500), "水".repeat(500), "🐟".repeat(500),
                "short"}) {
            assertThat(StreamSession.shortened(reason).getBytes(StandardCharsets.UTF_8).length).isBetween(5, 123);
        }
    }
}
