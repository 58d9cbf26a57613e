package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.nio.file.attribute.BasicFileAttributes;
import java.nio.file.attribute.FileTime;
import java.util.HashMap;
import java.util.Map;
import java.util.Set;
import java.util.function.Consumer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Looks several times a second whether a scene's file has been saved, or one that it builds on: its base or its creature. It
 * looks at the files, not at their folders' events: those are not told of on every file system.
 */
final class SavedFiles implements AutoCloseable {

    private static final Logger LOG = LoggerFactory.getLogger(SavedFiles.class);
    private static final String FILE_ENDING = ".json";
    private static final long LOOK_MILLISECONDS = 250;
    private static final int MAX_BASES = 8;
    private static final Stamp MISSING = new Stamp(null, -1);

    private final Map<String, Map<Path, Stamp>> seen = new HashMap<>();
    private final Consumer<String> saved;
    private final Thread watcher = new Thread(this::watch, "view-files");

    /** What tells a file from what it was. */
    private record Stamp(FileTime modified, long size) {

        static Stamp of(Path file) {
            try {
                BasicFileAttributes found = Files.readAttributes(file, BasicFileAttributes.class);
                return new Stamp(found.lastModifiedTime(), found.size());
            } catch (IOException e) {
                return MISSING;
            }
        }
    }

    /**
     * Starts to look.
     *
     * @param scenes names, of which those that are files are watched
     * @param saved  told the scene whose file was saved
     */
    SavedFiles(Set<String> scenes, Consumer<String> saved) {
        this.saved = saved;
        scenes.stream().filter(scene -> scene.endsWith(FILE_ENDING)).forEach(scene -> seen.put(scene, stamps(scene)));
        watcher.setDaemon(true);
        if (!seen.isEmpty()) {
            watcher.start();
        }
    }

    private void watch() {
        try {
            while (true) {
                Thread.sleep(LOOK_MILLISECONDS);
                seen.replaceAll(this::look);
            }
        } catch (InterruptedException e) {
            // Told to end.
        }
    }

    private Map<Path, Stamp> look(String scene, Map<Path, Stamp> before) {
        boolean isThere = Files.exists(Path.of(scene));  // some editors rename a new file to it
        if (!isThere || before.entrySet().stream().allMatch(file -> Stamp.of(file.getKey()).equals(file.getValue()))) {
            return before;
        }
        Map<Path, Stamp> now = stamps(scene);
        try {
            saved.accept(scene);
        } catch (RuntimeException e) {
            LOG.error("{} was saved: {}", scene, e, e);  // and will be again
        }
        return now;
    }

    private static Map<Path, Stamp> stamps(String scene) {
        Map<Path, Stamp> stamps = new HashMap<>();
        add(scene, stamps, MAX_BASES);
        return stamps;
    }

    /** A file and those that it names; of one that can't be read, itself. The stamp is taken first: a later change is seen. */
    private static void add(String name, Map<Path, Stamp> stamps, int levels) {
        Path file = Path.of(name);
        if (!name.endsWith(FILE_ENDING) || levels < 0 || stamps.containsKey(file)) {
            return;
        }
        stamps.put(file, Stamp.of(file));
        if (!Files.isRegularFile(file)) {
            return;  // a pipe would be waited for
        }
        try {
            JsonNode content = Json.read(file, JsonNode.class, "scene");
            addNamed(file, content.path("base").asText(), stamps, levels - 1);
            addNamed(file, content.at("/creature/name").asText(), stamps, 0);
        } catch (InvalidInputException e) {
            // The simulator says what is wrong with it.
        }
    }

    /** A named file is looked for beside the file that names it, then from the working directory. */
    private static void addNamed(Path file, String name, Map<Path, Stamp> stamps, int levels) {
        Path beside;
        try {
            beside = file.resolveSibling(name);
        } catch (InvalidPathException e) {
            return;  // what no file can be called
        }
        add(beside.toString(), stamps, levels);
        if (!Files.exists(beside)) {
            add(name, stamps, levels);
        }
    }

    @Override
    public void close() {
        watcher.interrupt();
    }
}
