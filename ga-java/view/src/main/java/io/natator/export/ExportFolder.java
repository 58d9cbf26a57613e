package io.natator.export;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.checkpoint.RunFolder;
import io.natator.config.FileErrors;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.file.OutputFolder;
import io.natator.simulator.ProgramEnd;
import java.io.Closeable;
import java.io.IOException;
import java.nio.channels.FileChannel;
import java.nio.channels.OverlappingFileLockException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.nio.file.StandardOpenOption;
import java.util.Comparator;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

/**
 * A folder that appears only when all in it is written: until then it is called {@code NAME.partial}. That goes when the
 * export fails or this program is told to end; what {@code kill -9} leaves goes with the next export to the same place. An empty
 * folder that is there already stays, with its owner and mode: at the end it is filled, {@code metadata.json} last. An earlier
 * export that is replaced is called {@code NAME.replaced} until the new one has its name.
 */
final class ExportFolder implements Closeable {

    /** In every export. */
    static final String METADATA = "metadata.json";
    /** Its entry with the names of all files of the export: whoever replaces it removes these alone. */
    static final String FILES = "files";
    static final String LOCK = "export.lock";

    private final Path target;
    private final Path partial;
    private final ReplacedExport replaced;
    private final boolean replace;
    private final FileChannel lock;
    private final ProgramEnd end = new ProgramEnd(Thread.currentThread()::interrupt, () -> { });
    private boolean committed;

    private ExportFolder(Path target, Path partial, ReplacedExport replaced, boolean replace, FileChannel lock) {
        this.target = target;
        this.partial = partial;
        this.replaced = replaced;
        this.replace = replace;
        this.lock = lock;
    }

    /**
     * Makes the folder under its temporary name.
     *
     * @param replace whether an earlier export may be there
     * @throws InvalidInputException if something else is there, it cannot be made, or another export is being written
     * @throws IOException           if it cannot be read
     */
    static ExportFolder begin(Path folder, boolean replace) throws IOException {
        Path target = followed(folder.toAbsolutePath().normalize());
        if (target.getFileName() == null) {
            throw new InvalidInputException("output folder is " + folder + "; expected a folder of its own");
        }
        Path partial = target.resolveSibling(target.getFileName() + ".partial");
        ReplacedExport replaced = new ReplacedExport(target);
        boolean isFilling = ExportFilling.isBegun(partial, target);
        if (RunFolder.isOccupied(target) && !isFilling) {
            failUnlessReplaceable(folder, target, replace);
        }
        if (RunFolder.isOccupied(partial) && !Files.exists(partial.resolve(LOCK))) {
            throw new InvalidInputException(partial + " is in the way; remove it");
        }
        OutputFolder.make(partial);
        FileChannel lock = FileChannel.open(partial.resolve(LOCK), StandardOpenOption.CREATE, StandardOpenOption.WRITE);
        try {
            if (lock.tryLock() == null) {
                throw new OverlappingFileLockException();
            }
        } catch (OverlappingFileLockException e) {
            lock.close();
            throw new InvalidInputException("another export to " + folder + " is being written", e);
        }
        ExportFolder fresh = new ExportFolder(target, partial, replaced, replace, lock);
        try {
            if (isFilling) {
                ExportFilling.takeBack(partial, target);
            }
            replaced.settle();
            if (RunFolder.isOccupied(target)) {
                failUnlessReplaceable(folder, target, replace);
            }
            deleteContents(partial);
            if (RunFolder.isOccupied(target)) {
                fresh.failUnlessMovable(folder);
            } else if (Files.exists(target)) {
                fresh.failUnlessFillable(folder);
            }
            return fresh;
        } catch (IOException | InvalidInputException e) {
            fresh.close();
            throw e;
        }
    }

    /** Where a link leads: a folder cannot take a link's name. */
    private static Path followed(Path folder) throws IOException {
        if (Files.isSymbolicLink(folder) && !Files.exists(folder)) {
            throw new InvalidInputException("output folder " + folder + " is a link that leads nowhere");
        }
        return Files.exists(folder) ? folder.toRealPath() : folder;
    }

    /** By --force, which is named only where it helps. */
    private static void failUnlessReplaceable(Path folder, Path target, boolean replace) throws IOException {
        if (Path.of("").toRealPath().startsWith(target)) {
            throw new InvalidInputException("output folder " + folder + " is the current folder, or holds it; expected another, such as "
                    + target.resolve("swim"));
        }
        if (!Files.isRegularFile(target.resolve(METADATA))) {
            throw new InvalidInputException("output folder " + folder + " is not empty and holds no export: it has no " + METADATA
                    + "; choose another by --output-dir");
        }
        Set<String> ofExport = new HashSet<>();
        Json.read(target.resolve(METADATA), JsonNode.class, METADATA).path(FILES).forEach(name -> ofExport.add(name.asText()));
        for (String name : files(target)) {
            if (!ofExport.contains(name)) {
                throw new InvalidInputException("output folder " + folder + " holds " + name
                        + ", which is no part of the export in it; move it away, or choose another folder by --output-dir");
            }
        }
        if (!replace) {
            throw new InvalidInputException("output folder " + folder + " is not empty; choose another by "
                    + "--output-dir, or replace the export in it by --force");
        }
    }

    /** What is there makes room for the export at its end: whether it can is tried before anything is computed. */
    private void failUnlessMovable(Path folder) throws IOException {
        replaced.failIfInTheWay();
        try {
            replaced.setAside();
            replaced.takeBack();
        } catch (IOException e) {
            throw new InvalidInputException("output folder " + folder + " cannot be replaced: " + FileErrors.whyNotMade(target, e)
                    + "; expected another, such as " + target.resolve("swim"), e);
        }
    }

    /** The same of an empty folder, which is to be filled. */
    private void failUnlessFillable(Path folder) throws IOException {
        try {
            ExportFilling.rehearse(partial, target);
        } catch (IOException e) {
            throw new InvalidInputException("output folder " + folder + " cannot be filled: " + FileErrors.whyNotMade(target, e)
                    + "; expected another, such as " + target.resolve("swim"), e);
        }
    }

    /** Names of all files in a folder and in its folders, in order, with slashes between; none of a lock. */
    static List<String> files(Path folder) throws IOException {
        try (Stream<Path> all = Files.walk(folder)) {
            return all.filter(path -> !Files.isDirectory(path)).map(path -> folder.relativize(path).toString().replace('\\', '/'))
                    .filter(name -> !name.equals(LOCK)).sorted().toList();
        }
    }

    /** Where the files go. */
    Path path() {
        return partial;
    }

    /** Gives the folder its name, or fills that which is there; an earlier export goes. */
    void commit() throws IOException {
        if (Files.exists(target) && !RunFolder.isOccupied(target)) {
            ExportFilling.fill(partial, target);
            delete(partial);
            committed = true;
            return;
        }
        if (RunFolder.isOccupied(target)) {
            replaceEarlier();
        } else {
            Files.move(partial, target, StandardCopyOption.ATOMIC_MOVE);
            committed = true;
        }
        Files.delete(target.resolve(LOCK));
    }

    /** If nothing but an export, which may be replaced, is in the folder still: who put something there meanwhile keeps it. */
    private void replaceEarlier() throws IOException {
        failUnlessReplaceable(target, target, replace);
        replaced.failIfInTheWay();
        replaced.setAside();
        try {
            Files.move(partial, target, StandardCopyOption.ATOMIC_MOVE);
        } catch (IOException e) {
            replaced.takeBack();
            throw e;
        }
        committed = true;
        replaced.delete();
    }

    /** Removes the folder unless it was committed. */
    @Override
    public void close() throws IOException {
        try (end; lock) {
            if (!committed) {
                delete(partial);
            }
        }
    }

    /** A folder that has a lock, where it exists: the lock goes last, so that what a kill leaves is known again. */
    static void delete(Path folder) throws IOException {
        if (Files.exists(folder)) {
            deleteContents(folder);
            Files.deleteIfExists(folder.resolve(LOCK));
            Files.delete(folder);
        }
    }

    /** All but the lock. */
    private static void deleteContents(Path folder) throws IOException {
        List<Path> inwards;
        try (Stream<Path> all = Files.walk(folder)) {
            inwards = all.filter(one -> !one.equals(folder) && !one.equals(folder.resolve(LOCK)))
                    .sorted(Comparator.reverseOrder()).toList();
        }
        for (Path one : inwards) {
            Files.delete(one);
        }
    }
}
