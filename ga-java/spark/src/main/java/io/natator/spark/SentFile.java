package io.natator.spark;

import io.natator.base.Sha256;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import org.apache.spark.SparkFiles;

/** A file that Spark has brought to this executor. Its name tells the digest of its content. */
final class SentFile {

    private static final Set<Path> CHECKED = ConcurrentHashMap.newKeySet();

    private SentFile() {
    }

    static String name(String kind, String digest) {
        return switch (kind) {
            case "scene" -> "scene-" + digest + ".json";  // the native program takes a name that ends so for a file
            default -> kind + "-" + digest;
        };
    }

    /**
     * Where it lies.
     *
     * @throws UnfitExecutorException if it is not what was sent
     */
    static Path get(String name) throws UnfitExecutorException {
        Path file = Path.of(SparkFiles.get(name));
        if (!CHECKED.contains(file)) {
            try {
                String digest = Sha256.of(file);
                if (!name.contains(digest)) {
                    throw new UnfitExecutorException(
                            "file " + file + " has digest " + digest + ", not that in its name");
                }
            } catch (UncheckedIOException e) {
                throw new UnfitExecutorException(e.getMessage(), e);
            }
            CHECKED.add(file);
        }
        return file;
    }
}
