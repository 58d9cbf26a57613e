package io.natator.export;

import java.io.IOException;
import java.nio.file.Path;
import java.util.Locale;

/** What a swim can be written as. */
public enum ExportFormat {
    /** ParaView: VTK PolyData, a file for each frame. */
    VTP(VtpWriter::new),
    /** Blender and others: binary PLY, a file for each frame. */
    PLY(PlyWriter::new),
    /** USD: one layer in text form with time samples. */
    USD(UsdWriter::new),
    /** USD: the same layer in binary form. */
    USDC(UsdWriter::binary),
    /** glTF: bodies alone, as meshes that bones move, in one binary file. */
    GLB(GlbWriter::new),
    /** One table. */
    CSV(CsvWriter::new),
    /** numpy: one archive of arrays. */
    NPZ(NpzWriter::new);

    private final Opening opening;

    ExportFormat(Opening opening) {
        this.opening = opening;
    }

    @FunctionalInterface
    private interface Opening {
        FrameWriter open(ExportContext swim, Path folder) throws IOException;
    }

    FrameWriter open(ExportContext swim, Path folder) throws IOException {
        return opening.open(swim, folder);
    }

    /** Whether files of it can hold a mesh whose vertices are others in every frame. */
    boolean holdsWaterSurface() {
        return this == VTP || this == PLY || this == USD || this == USDC;
    }

    /** Whether files of it hold particles, of water too, instead of bodies alone. */
    public boolean holdsParticles() {
        return this != GLB;
    }

    /** Its name on the command line and in metadata. */
    public String text() {
        return name().toLowerCase(Locale.ROOT);
    }
}
