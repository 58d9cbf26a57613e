package io.natator.cache;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.Sha256;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.protocol.SimulationResult;
import java.io.IOException;
import java.nio.charset.CharacterCodingException;
import java.nio.file.Files;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.concurrent.atomic.AtomicBoolean;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Results of evaluations that were carried out before, by any run: a file for each, named by the digest of all that
 * determines it. Several processes can use it at once, since files appear whole. A file that is damaged counts as
 * missing; deleting the folder costs time only.
 */
public final class EvaluationCache {

    private static final Logger LOG = LoggerFactory.getLogger(EvaluationCache.class);

    private final Path folder;
    private final AtomicBoolean refused = new AtomicBoolean();

    /** A cache in a folder, which is made when there is something to keep. */
    public EvaluationCache(Path folder) {
        this.folder = folder;
    }

    /**
     * The user's: {@code evaluations} in $NATATOR_CACHE, else in natator in $XDG_CACHE_HOME, else in ~/.cache/natator; null if the first
     * variable is empty.
     */
    public static Path ofUser() {
        String own = System.getenv("NATATOR_CACHE");
        String shared = System.getenv("XDG_CACHE_HOME");
        Path natator = own != null ? Path.of(own)
                : shared != null && !shared.isEmpty() ? Path.of(shared, "natator")
                        : Path.of(System.getProperty("user.home"), ".cache", "natator");
        return own != null && own.isEmpty() ? null : natator.resolve("evaluations");
    }

    /**
     * The result that was kept under a key, or null.
     *
     * @param key all that determines the result, on one line
     */
    public SimulationResult find(String key) {
        try {
            String[] lines = Files.readString(file(key)).split("\n", -1);
            if (lines.length != 4 || !lines[0].equals(key) || !lines[2].equals(Sha256.of(lines[0] + lines[1]))) {
                return null;
            }
            return Json.parse(lines[1], SimulationResult.class);
        } catch (NoSuchFileException | JsonProcessingException | CharacterCodingException e) {
            return null;
        } catch (IOException e) {
            complain(e);
            return null;
        }
    }

    /** Keeps a result. That it cannot be kept is told once, and is no failure. */
    public void store(String key, SimulationResult result) {
        Path file = file(key);
        String json = Json.line(result);
        try {
            Files.createDirectories(file.getParent());
            Path fresh = Files.createTempFile(file.getParent(), "new-", ".tmp");
            try {
                Files.writeString(fresh, key + "\n" + json + "\n" + Sha256.of(key + json) + "\n");
                Files.move(fresh, file, StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
            } finally {
                Files.deleteIfExists(fresh);
            }
        } catch (IOException e) {
            complain(e);
        }
    }

    private void complain(IOException e) {
        if (refused.compareAndSet(false, true)) {
            LOG.warn("evaluations are not cached in {}: {}", folder, FileErrors.whyNotMade(folder, e));
        }
    }

    private Path file(String key) {
        String digest = Sha256.of(key);
        return folder.resolve(digest.substring(0, 2)).resolve(digest.substring(2) + ".json");
    }
}
