package io.natator.export;

import java.io.BufferedOutputStream;
import java.io.Closeable;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/** One array of an .npz that grows by a row with each frame; it waits in a file of its own. */
final class NpyColumn implements Closeable {

    /** The magic of version 1.0 and the length of the header. */
    private static final int PREFIX_BYTES = 10;
    private static final int ALIGNMENT = 64;

    private final String name;
    private final String type;
    private final int[] rowShape;
    private final Path file;
    private final OutputStream out;
    private int rows;

    /**
     * An array without rows.
     *
     * @param type     numpy's, for example {@code <f4}
     * @param rowShape shape of what one frame adds
     */
    NpyColumn(Path folder, String name, String type, int... rowShape) throws IOException {
        this.name = name;
        this.type = type;
        this.rowShape = rowShape.clone();
        this.file = folder.resolve(name + ".rows");
        this.out = new BufferedOutputStream(Files.newOutputStream(file));
    }

    String name() {
        return name;
    }

    /** Adds one frame's values. */
    void add(ByteBuffer row) throws IOException {
        out.write(row.array(), row.arrayOffset() + row.position(), row.remaining());
        rows++;
    }

    /** Writes the whole array in numpy's format and removes the file in which it waited. */
    void moveTo(OutputStream target) throws IOException {
        out.close();
        int[] shape = IntStream.concat(IntStream.of(rows), IntStream.of(rowShape)).toArray();
        target.write(header(type, shape));
        Files.copy(file, target);
        Files.delete(file);
    }

    /** The beginning of a .npy file, version 1.0. */
    static byte[] header(String type, int... shape) {
        String text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': ("
                + IntStream.of(shape).mapToObj(length -> length + ",").collect(Collectors.joining(" ")) + "), }";
        int padding = ALIGNMENT - (PREFIX_BYTES + text.length() + 1) % ALIGNMENT;
        byte[] dictionary = (text + " ".repeat(padding) + "\n").getBytes(StandardCharsets.US_ASCII);
        ByteBuffer header = LittleEndian.buffer(PREFIX_BYTES + dictionary.length);
        header.put((byte) 0x93).put("NUMPY".getBytes(StandardCharsets.US_ASCII)).put((byte) 1).put((byte) 0);
        return header.putShort((short) dictionary.length).put(dictionary).array();
    }

    @Override
    public void close() throws IOException {
        out.close();
    }
}
