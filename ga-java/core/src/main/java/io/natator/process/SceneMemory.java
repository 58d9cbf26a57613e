package io.natator.process;

import com.fasterxml.jackson.databind.JsonNode;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Remembers what the simulator said about scenes, of many bodies those that were asked for last. For several threads.
 *
 * @param <T> what it said
 */
public final class SceneMemory<T> {

    private static final int MAX_KNOWN = 4096;

    private final Map<List<Object>, T> known = new LinkedHashMap<>(16, 0.75f, true) {
        private static final long serialVersionUID = 1L;

        @Override
        protected boolean removeEldestEntry(Map.Entry<List<Object>, T> eldest) {
            return size() > MAX_KNOWN;
        }
    };

    /**
     * Asks about a scene.
     *
     * @param <T> what it answers
     */
    @FunctionalInterface
    public interface Question<T> {
        /** The answer. */
        T answer() throws InterruptedException;
    }

    /**
     * What is known of a scene, else what is answered now.
     *
     * @param overrides JSON Merge Patch on the scene, or null
     */
    public T of(String scene, JsonNode overrides, Question<T> question) throws InterruptedException {
        List<Object> name = Arrays.asList(scene, overrides);
        synchronized (known) {
            T answer = known.get(name);
            if (answer != null) {
                return answer;
            }
        }
        T answer = question.answer();
        synchronized (known) {
            known.put(name, answer);
        }
        return answer;
    }
}
