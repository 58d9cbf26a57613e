package io.natator.export;

import io.natator.stream.Skin;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.IntStream;

/**
 * For USD: {@code swim.usda}, a time code for each simulated frame. {@code Water} and {@code BodyParticles} are
 * points, {@code Muscles} are curves. {@code Body} is the body's surface: the mesh that it was made of, or that of its slices. Where there is
 * one, its particles are there but invisible. The unit of length counts as a metre.
 */
final class UsdWriter implements FrameWriter {

    private static final double MUSCLE_WIDTH = 0.05;  // in solid rest distances

    private final ExportContext swim;
    private final Path folder;
    private final List<UsdPrim> prims = new ArrayList<>();
    private long first = -1;
    private long last = -1;

    UsdWriter(ExportContext swim, Path folder) throws IOException {
        this.swim = swim;
        this.folder = folder;
        StreamScene scene = swim.scene();
        if (swim.hasWater()) {
            UsdPrim water = points("Water", swim.water(), scene.fluidRestDistance());
            water.fix("color3f[] primvars:displayColor = [(0.35, 0.62, 0.86)] (interpolation = \"constant\")");
            water.fix("float[] primvars:displayOpacity = [0.3] (interpolation = \"constant\")");
        }
        if (swim.solids().size() > 0) {
            if (swim.hasSkin()) {
                addSkin();
            } else if (swim.surface().size() > 0) {
                addSurface();
            }
            UsdPrim body = points("BodyParticles", swim.solids(), scene.solidRestDistance() / 2);
            body.fix("int[] primvars:cluster = " + UsdText.clusters(swim.solids()) + " (interpolation = \"vertex\")");
            body.fix(colours());
            if (swim.hasSkin() || swim.surface().size() > 0) {
                body.fix("token visibility = \"invisible\"");
            }
        }
        if (!scene.muscles().isEmpty()) {
            addMuscles();
        }
    }

    private UsdPrim prim(String type, String name, ParticleSet particles, double width) throws IOException {
        return prim(type, name, frame -> particles.values(frame.position(), 3), width);
    }

    private UsdPrim prim(String type, String name, UsdPrim.Points points, double width) throws IOException {
        UsdPrim prim = new UsdPrim(folder, type, name, points, width);
        prims.add(prim);
        return prim;
    }

    private UsdPrim points(String name, ParticleSet particles, double width) throws IOException {
        UsdPrim points = prim("Points", name, particles, width);
        points.fix("int64[] ids = " + UsdText.indices(particles));
        points.fix("float[] widths = [" + (float) width + "] (interpolation = \"constant\")");
        points.fix("float[] primvars:mass = " + UsdText.masses(particles) + " (interpolation = \"vertex\")");
        if (swim.hasVelocity()) {
            points.sample("vector3f[] velocities",
                    (samples, frame) -> samples.add(frame.frame(), particles, frame.velocity(), 3));
        }
        if (swim.hasDensity()) {
            points.fix("float[] primvars:density (interpolation = \"vertex\")");
            points.sample("float[] primvars:density",
                    (samples, frame) -> samples.add(frame.frame(), particles, frame.density(), 1));
        }
        return points;
    }

    /** The mesh that the body was made of. */
    private void addSkin() throws IOException {
        Skin skin = swim.scene().skin();
        SkinMotion motion = new SkinMotion(swim.scene());
        UsdPrim mesh = prim("Mesh", "Body", frame -> motion.places(frame.position()), 0);
        mesh.fix("int[] faceVertexCounts = " + UsdText.list(skin.triangles().size(), 3));
        mesh.fix("int[] faceVertexIndices = "
                + UsdText.list(skin.triangles().stream().flatMapToInt(IntStream::of).toArray()));
        mesh.fix("uniform token subdivisionScheme = \"none\"");
        mesh.fix("color3f[] primvars:displayColor = " + UsdText.colours(skin.cluster()) + " (interpolation = \"vertex\")");
    }

    private void addSurface() throws IOException {
        UsdPrim mesh = prim("Mesh", "Body", swim.solids(), 0);
        mesh.fix("int[] faceVertexCounts = " + UsdText.list(swim.surface().size(), 3));
        mesh.fix("int[] faceVertexIndices = " + UsdText.list(swim.surface().corners(swim.solids())));
        mesh.fix("uniform token subdivisionScheme = \"none\"");
        mesh.fix("uniform bool doubleSided = 1");
        mesh.fix(colours());
    }

    private String colours() {
        return "color3f[] primvars:displayColor = " + UsdText.colours(swim.solids()) + " (interpolation = \"vertex\")";
    }

    /** The points of a curve are those of its two ends, so a particle may occur more than once. */
    private void addMuscles() throws IOException {
        List<StreamScene.Muscle> muscles = swim.scene().muscles();
        double width = MUSCLE_WIDTH * swim.scene().solidRestDistance();
        ParticleSet ends = ParticleSet.listed(swim.scene(), swim.muscleEnds());
        UsdPrim curves = prim("BasisCurves", "Muscles", ends, width);
        curves.fix("uniform token type = \"linear\"");
        curves.fix("int[] curveVertexCounts = " + UsdText.list(muscles.size(), 2));
        curves.fix("float[] widths = [" + (float) width + "] (interpolation = \"constant\")");
        curves.fix("int[] primvars:actuator = "
                + UsdText.list(muscles.stream().mapToInt(StreamScene.Muscle::actuator).toArray())
                + " (interpolation = \"uniform\")");
        curves.fix("float[] primvars:contraction (interpolation = \"uniform\")");
        curves.sample("float[] primvars:contraction", (samples, frame) -> {
            float[] contraction = new float[muscles.size()];
            for (int i = 0; i < contraction.length; i++) {
                contraction[i] = ExportContext.contraction(muscles.get(i), frame);
            }
            samples.add(frame.frame(), contraction, 1);
        });
    }

    @Override
    public void frame(StreamFrame frame) throws IOException {
        first = first < 0 ? frame.frame() : first;
        last = frame.frame();
        for (UsdPrim prim : prims) {
            prim.frame(frame);
        }
    }

    @Override
    public void finish() throws IOException {
        double codesPerSecond = 1 / swim.scene().timeStep();
        try (BufferedWriter out = Files.newBufferedWriter(folder.resolve("swim.usda"))) {
            out.write("#usda 1.0\n(\n    defaultPrim = \"Swim\"\n    doc = \"" + swim.title() + "\"\n    endTimeCode = "
                    + last + "\n    framesPerSecond = " + codesPerSecond + "\n    metersPerUnit = 1\n"
                    + "    startTimeCode = " + first + "\n    timeCodesPerSecond = " + codesPerSecond
                    + "\n    upAxis = \"Y\"\n)\n\ndef Xform \"Swim\" (kind = \"component\")\n{");
            for (UsdPrim prim : prims) {
                prim.moveTo(out);
            }
            out.write("}\n");
        }
    }

    @Override
    public void close() throws IOException {
        for (UsdPrim prim : prims) {
            prim.close();
        }
    }
}
