package io.natator.export;

import java.io.BufferedOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/** One file of VTK's PolyData in XML (.vtp), its numbers behind the XML as they are (appended, raw). */
final class PolyData {

    private final double time;
    private final int points;
    private final List<ByteBuffer> blocks = new ArrayList<>();
    private long offset;
    private final StringBuilder pointArrays = new StringBuilder();
    private final StringBuilder cellArrays = new StringBuilder();
    private final StringBuilder cells = new StringBuilder();
    private final StringBuilder counts = new StringBuilder();
    private final String coordinates;

    /**
     * A data set of points without cells.
     *
     * @param time     s
     * @param position x, y, z of each point, 32-bit
     */
    PolyData(double time, ByteBuffer position) {
        this.time = time;
        this.points = position.remaining() / (3 * Float.BYTES);
        this.coordinates = array("Float32", "points", 3, position);
    }

    /**
     * A number or more of each point.
     *
     * @param type VTK's, for example {@code Float32}
     */
    void ofPoints(String type, String name, int components, ByteBuffer values) {
        pointArrays.append(array(type, name, components, values));
    }

    /** A number of each cell. */
    void ofCells(String type, String name, ByteBuffer values) {
        cellArrays.append(array(type, name, 1, values));
    }

    /**
     * Cells of one sort.
     *
     * @param sort  {@code Verts}, {@code Lines} or {@code Polys}
     * @param nodes points of all cells in turn, 32-bit
     * @param ends  where in {@code nodes} each cell ends, 32-bit
     */
    void cells(String sort, ByteBuffer nodes, ByteBuffer ends) {
        counts.append(" NumberOf").append(sort).append("=\"").append(ends.remaining() / Integer.BYTES).append('"');
        cells.append("<").append(sort).append(">\n").append(array("Int32", "connectivity", 1, nodes))
                .append(array("Int32", "offsets", 1, ends)).append("</").append(sort).append(">\n");
    }

    private String array(String type, String name, int components, ByteBuffer values) {
        String text = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + components
                + "\" format=\"appended\" offset=\"" + offset + "\"/>\n";
        blocks.add(values.duplicate());
        offset += Long.BYTES + values.remaining();
        return text;
    }

    /** Writes the file. */
    void write(Path file) throws IOException {
        String head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\""
                + " header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\""
                + " NumberOfTuples=\"1\" format=\"ascii\">" + time + "</DataArray>\n</FieldData>\n"
                + "<Piece NumberOfPoints=\"" + points + "\"" + counts + ">\n<PointData>\n" + pointArrays
                + "</PointData>\n<CellData>\n" + cellArrays + "</CellData>\n<Points>\n" + coordinates + "</Points>\n"
                + cells + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        try (OutputStream out = new BufferedOutputStream(Files.newOutputStream(file))) {
            out.write(head.getBytes(StandardCharsets.UTF_8));
            for (ByteBuffer block : blocks) {
                out.write(LittleEndian.longs(block.remaining()).array());
                out.write(block.array(), block.arrayOffset() + block.position(), block.remaining());
            }
            out.write("\n</AppendedData>\n</VTKFile>\n".getBytes(StandardCharsets.UTF_8));
        }
    }
}
