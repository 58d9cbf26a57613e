package io.natator.export;

import io.natator.checkpoint.RunFolder;
import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;

/**
 * An earlier export on its way out: {@code NAME} becomes {@code NAME.replaced}, and goes when the new one has the name. It gets a lock
 * file first, by which one that a killed program left is told from a folder of somebody else.
 */
final class ReplacedExport {

    private final Path folder;
    private final Path aside;

    /** Of the export in a folder, whether there is one or not. */
    ReplacedExport(Path folder) {
        this.folder = folder;
        this.aside = folder.resolveSibling(folder.getFileName() + ".replaced");
    }

    /**
     * Looks whether another folder has the name.
     *
     * @throws InvalidInputException that names it
     */
    void failIfInTheWay() throws IOException {
        if (RunFolder.isOccupied(aside)) {
            throw new InvalidInputException(aside + " is in the way; remove it");
        }
    }

    void setAside() throws IOException {
        Path mark = folder.resolve(ExportFolder.LOCK);
        Files.newByteChannel(mark, StandardOpenOption.CREATE, StandardOpenOption.WRITE).close();
        try {
            Files.move(folder, aside, StandardCopyOption.ATOMIC_MOVE);
        } catch (IOException e) {
            Files.delete(mark);
            throw e;
        }
    }

    /** Undoes {@link #setAside}. */
    void takeBack() throws IOException {
        Files.move(aside, folder, StandardCopyOption.ATOMIC_MOVE);
        Files.delete(folder.resolve(ExportFolder.LOCK));
    }

    /** What a kill leaves of it goes with the next export. */
    void delete() throws IOException {
        ExportFolder.delete(aside);
    }

    /** Ends what a killed program began: the earlier export is there again, or gone if the new one is there. */
    void settle() throws IOException {
        if (!Files.exists(aside.resolve(ExportFolder.LOCK))) {
            return;
        }
        if (RunFolder.isOccupied(folder)) {
            delete();
        } else {
            takeBack();
        }
    }
}
