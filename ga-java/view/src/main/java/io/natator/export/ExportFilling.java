package io.natator.export;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.checkpoint.RunFolder;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.util.Comparator;
import java.util.List;
import java.util.stream.Stream;

/**
 * Moves a whole export into an empty folder beside it, so that this stays the folder that it is. The list of files goes last:
 * while it is not there the folder holds no export, and what was moved already can be told by it.
 */
final class ExportFilling {

    private ExportFilling() {
    }

    /** Moves all but the lock; if that fails nothing stays in the folder. */
    static void fill(Path partial, Path target) throws IOException {
        List<Path> all;
        try (Stream<Path> contents = Files.list(partial)) {
            all = contents.filter(one -> !one.endsWith(ExportFolder.LOCK))
                    .sorted(Comparator.comparing(one -> one.endsWith(ExportFolder.METADATA))).toList();
        }
        try {
            for (Path one : all) {
                move(one, target);
            }
        } catch (IOException e) {
            takeBack(partial, target);
            throw e;
        }
    }

    /** Tries with an empty file whether a folder can be filled. */
    static void rehearse(Path partial, Path target) throws IOException {
        Path moved = move(Files.createTempFile(partial, "export", ".tmp"), target);
        Files.delete(moved);
    }

    private static Path move(Path one, Path target) throws IOException {
        return Files.move(one, target.resolve(one.getFileName()), StandardCopyOption.ATOMIC_MOVE);
    }

    /** Whether an export may have been killed, or be under way, within {@link #fill}. */
    static boolean isBegun(Path partial, Path target) {
        return Files.exists(partial.resolve(ExportFolder.LOCK)) && Files.exists(partial.resolve(ExportFolder.METADATA))
                && !Files.exists(target.resolve(ExportFolder.METADATA));
    }

    /** Removes from the folder what is on the export's list and not beside that any more; nothing where the list is damaged. */
    static void takeBack(Path partial, Path target) throws IOException {
        JsonNode names;
        try {
            names = Json.read(partial.resolve(ExportFolder.METADATA), JsonNode.class, ExportFolder.METADATA).path(ExportFolder.FILES);
        } catch (InvalidInputException e) {
            return;  // it was not whole, so nothing was moved
        }
        for (JsonNode name : names) {
            if (!Files.exists(partial.resolve(name.asText())) && Files.deleteIfExists(target.resolve(name.asText()))) {
                deleteEmpty(target.resolve(name.asText()).getParent(), target);
            }
        }
    }

    /** Removes a folder, and those that it is in, up to one that is not empty or is the whole. */
    private static void deleteEmpty(Path folder, Path whole) throws IOException {
        for (Path one = folder; !one.equals(whole) && !RunFolder.isOccupied(one); one = one.getParent()) {
            Files.delete(one);
        }
    }
}
