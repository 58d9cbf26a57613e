package io.natator.export;

import io.natator.stream.Skin;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.IntStream;

/**
 * For USD: {@code swim.usda}, or {@code swim.usdc}, a time code for each simulated frame. {@code Water},
 * {@code BodyParticles} and {@code Obstacles} are points, {@code Muscles} are curves, {@code WaterSurface} is a mesh.
 * {@code Body} is the swimmer's surface: the mesh that it was made of, or that of its slices; {@code Companion1} and so on
 * are those of companions. Where there is a surface, its particles are there but invisible. The unit of length counts as a metre.
 */
final class UsdWriter implements FrameWriter {

    private static final String INVISIBLE = "token visibility = \"invisible\"";
    private static final double MUSCLE_WIDTH = 0.05;  // in solid rest distances

    private final ExportContext swim;
    private final Path folder;
    private final List<UsdPrim> prims = new ArrayList<>();
    private final boolean binary;
    private long first = -1;
    private long last = -1;

    UsdWriter(ExportContext swim, Path folder) throws IOException {
        this(swim, folder, false);
    }

    private UsdWriter(ExportContext swim, Path folder, boolean binary) throws IOException {
        this.swim = swim;
        this.folder = folder;
        this.binary = binary;
        StreamScene scene = swim.scene();
        if (swim.hasWater()) {
            UsdPrim water = points("Water", swim.water(), scene.fluidRestDistance());
            paintAsWater(water);
            if (swim.hasWaterSurface()) {
                water.fix(INVISIBLE);
            }
        }
        if (swim.hasWaterSurface()) {
            addWaterSurface();
        }
        addBodies();
        ParticleSet obstacles = ParticleSet.obstacles(scene);
        if (obstacles.size() > 0) {
            points("Obstacles", obstacles, scene.solidRestDistance())
                    .fix("color3f[] primvars:displayColor = [(0.56, 0.62, 0.66)] (interpolation = \"constant\")");
        }
        if (!scene.muscles().isEmpty()) {
            addMuscles();
        }
    }

    /** One in binary form. */
    static UsdWriter binary(ExportContext swim, Path folder) throws IOException {
        return new UsdWriter(swim, folder, true);
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

    private void addBodies() throws IOException {
        ParticleSet bodies = ParticleSet.creaturesOf(swim.scene());
        if (bodies.size() == 0) {
            return;
        }
        if (swim.hasSkin()) {
            addSkin();
        }
        for (int i = 0; i < swim.surfaces().size(); i++) {
            if (swim.surfaces().get(i).size() > 0 && !(i == 0 && swim.hasSkin())) {
                addSurface(i == 0 ? "Body" : "Companion" + i, ParticleSet.ofCreature(swim.scene(), i), swim.surfaces().get(i));
            }
        }
        UsdPrim points = points("BodyParticles", bodies, swim.scene().solidRestDistance() / 2);
        points.fix("int[] primvars:cluster = " + UsdText.clusters(bodies) + " (interpolation = \"vertex\")");
        points.fix("int[] primvars:creature = " + UsdText.creatures(bodies) + " (interpolation = \"vertex\")");
        points.fix(colours(bodies));
        if (swim.hasSkin() || swim.surface().size() > 0) {
            points.fix(INVISIBLE);
        }
    }

    /** Its faces are others in every frame. */
    private void addWaterSurface() throws IOException {
        WaterSurface surface = swim.waterSurface();
        UsdPrim mesh = prim("Mesh", "WaterSurface", frame -> surface.of(frame).places(), 0);
        mesh.sample("int[] faceVertexCounts", (samples, frame) -> {
            int[] counts = new int[surface.of(frame).triangleCount()];
            Arrays.fill(counts, 3);
            samples.add(frame.frame(), counts);
        });
        mesh.sample("int[] faceVertexIndices",
                (samples, frame) -> samples.add(frame.frame(), surface.of(frame).triangles()));
        mesh.fix("uniform token subdivisionScheme = \"none\"");
        paintAsWater(mesh);
    }

    private static void paintAsWater(UsdPrim prim) {
        prim.fix("color3f[] primvars:displayColor = [(0.35, 0.62, 0.86)] (interpolation = \"constant\")");
        prim.fix("float[] primvars:displayOpacity = [0.3] (interpolation = \"constant\")");
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

    private void addSurface(String name, ParticleSet body, BodySurface surface) throws IOException {
        UsdPrim mesh = prim("Mesh", name, body, 0);
        mesh.fix("int[] faceVertexCounts = " + UsdText.list(surface.size(), 3));
        mesh.fix("int[] faceVertexIndices = " + UsdText.list(surface.corners(body)));
        mesh.fix("uniform token subdivisionScheme = \"none\"");
        mesh.fix("uniform bool doubleSided = 1");
        mesh.fix(colours(body));
    }

    private static String colours(ParticleSet bodies) {
        return "color3f[] primvars:displayColor = " + UsdText.colours(bodies) + " (interpolation = \"vertex\")";
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
        Path text = folder.resolve("swim.usda");
        try (BufferedWriter out = Files.newBufferedWriter(text)) {
            out.write("#usda 1.0\n(\n    defaultPrim = \"Swim\"\n    doc = " + UsdText.quoted(swim.title()) + "\n    endTimeCode = "
                    + last + "\n    framesPerSecond = " + codesPerSecond + "\n    metersPerUnit = 1\n"
                    + "    startTimeCode = " + first + "\n    timeCodesPerSecond = " + codesPerSecond
                    + "\n    upAxis = \"Y\"\n)\n\ndef Xform \"Swim\" (kind = \"component\")\n{");
            for (UsdPrim prim : prims) {
                prim.moveTo(out);
            }
            out.write("}\n");
        }
        if (binary) {
            swim.python().run("usd_binary.py", text.toString(), folder.resolve("swim.usdc").toString());
            Files.delete(text);
        }
    }

    @Override
    public void close() throws IOException {
        for (UsdPrim prim : prims) {
            prim.close();
        }
    }
}
