package io.natator.file;

import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.base.InvalidInputException;
import io.natator.config.FileErrors;
import io.natator.config.Json;
import io.natator.config.Limits;
import java.io.ByteArrayOutputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.zip.GZIPInputStream;
import java.util.zip.GZIPOutputStream;

/** Files of one JSON value, compressed by gzip. */
public final class CompressedJson {

    private CompressedJson() {
    }

    /** Replaces a file, as {@link AtomicFile} does; the same value gives the same bytes. */
    public static void write(Path file, Object value) {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try (GZIPOutputStream out = new GZIPOutputStream(bytes)) {
            out.write(Json.line(value).getBytes(StandardCharsets.UTF_8));
        } catch (IOException e) {
            throw new UncheckedIOException(e);  // not in memory
        }
        AtomicFile.write(file, bytes.toByteArray());
    }

    /**
     * Reads a file.
     *
     * @param what what it is, for the message: for example {@code recording}
     * @throws InvalidInputException if it is missing or is not such a value
     */
    public static <T> T read(Path file, Class<T> type, String what) {
        try (GZIPInputStream in = new GZIPInputStream(Files.newInputStream(file))) {
            byte[] content = in.readNBytes(Limits.FILE_BYTES);
            if (in.read() >= 0) {
                throw new IOException("larger than " + Limits.FILE_BYTES + " bytes");
            }
            return Json.parse(new String(content, StandardCharsets.UTF_8), type);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(what + " " + file + ": " + Json.reason(e), e);
        } catch (EOFException e) {
            throw new InvalidInputException(what + " " + file + " ends too early", e);
        } catch (IOException e) {
            throw new InvalidInputException(what + " " + file + " cannot be read: " + FileErrors.reason(file, e), e);
        }
    }
}
