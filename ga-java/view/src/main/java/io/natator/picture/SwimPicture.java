package io.natator.picture;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.awt.image.BufferedImage;
import java.util.List;

/** Draws a frame of a swim: the body's particles as spheres in clear water, with its tank and a scale. */
public final class SwimPicture {

    private static final double DEFAULT_SPACING = 0.075;
    /** Of a particle, in spacings: neighbours overlap. */
    private static final double RADIUS = 0.71;
    private static final float[] HEAD = Colours.linear(0xe0, 0x4a, 0x2b);
    private static final float[] TAIL = Colours.linear(0xf9, 0xae, 0x52);
    private static final float[] COMPANION = Colours.linear(0x8c, 0x6b, 0xb8);
    private static final float[] OBSTACLE = Colours.linear(0x8d, 0x98, 0xa3);
    private static final double SHADOW = 0.3;

    private final StreamScene scene;
    private final StreamFrame frame;
    private final PictureOptions options;

    private SwimPicture(StreamScene scene, StreamFrame frame, PictureOptions options) {
        this.scene = scene;
        this.frame = frame;
        this.options = options;
    }

    /**
     * The picture, in sRGB.
     *
     * @param frame with positions
     */
    public static BufferedImage draw(StreamScene scene, StreamFrame frame, PictureOptions options) {
        return new SwimPicture(scene, frame, options).draw();
    }

    /** Whether the tank closes up with itself along each axis. */
    private boolean[] openAxes() {
        return new boolean[] {scene.periodic().containsKey("x"), false, scene.periodic().containsKey("z")};
    }

    private BufferedImage draw() {
        Framing framing = Framing.of(scene, frame);
        int width = options.width();
        int height = options.height() > 0 ? options.height() : framing.height(options.from(), width);
        Projection projection = framing.projection(options.from(), width, height);
        BufferedImage image = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
        Surroundings surroundings = new Surroundings(projection, framing.tank(), openAxes(), width, height);
        surroundings.behind(image);
        float[] pixels = linear(image);
        if (!framing.tank().isEmpty() && projection.from() == From.THREE_QUARTER) {
            shade(pixels, projection, framing.tank().low()[1], width, height);
        }
        Spheres spheres = spheres(projection, width, height);
        float[] body = spheres.shaded();
        if (options.water() && scene.fluidCount() > 0) {
            water(projection, width, height, spheres.depths()).over(pixels, body, surroundings.inside());
        } else {
            over(pixels, body);
        }
        image.setRGB(0, 0, width, height, srgb(pixels), 0, width);
        surroundings.before(image, frame.time());
        return image;
    }

    private double x(int particle) {
        return frame.position()[3 * particle];
    }

    private double y(int particle) {
        return frame.position()[3 * particle + 1];
    }

    private double z(int particle) {
        return frame.position()[3 * particle + 2];
    }

    private Spheres spheres(Projection projection, int width, int height) {
        float[][] colours = colours();
        double body = RADIUS * projection.scale() * spacing("/creature/spacing")
                / scene.definition().at("/creature/refinement").asInt(1);
        double obstacle = RADIUS * projection.scale() * spacing("/obstacles/0/spacing");
        Spheres spheres = new Spheres(width, height, scene.particles() - scene.fluidCount());
        for (int i = 0; i < scene.particles(); i++) {
            if (!scene.isFluid(i)) {
                spheres.add(projection.x(x(i), y(i), z(i)), projection.y(x(i), y(i), z(i)),
                        projection.depth(x(i), y(i), z(i)), scene.mass().get(i) == null ? obstacle : body, colours[i]);
            }
        }
        return spheres;
    }

    private double spacing(String key) {
        return scene.definition().at(key).asDouble(DEFAULT_SPACING);
    }

    /** From head to tail; others by what they are. */
    private float[][] colours() {
        float[][] colours = new float[scene.particles()][];
        for (int i = 0; i < colours.length; i++) {
            colours[i] = scene.mass().get(i) == null ? OBSTACLE : COMPANION;
        }
        scene.body().forEach(particle -> colours[particle] = HEAD);
        List<List<Integer>> slices = scene.slices();
        for (int i = 0; i < slices.size(); i++) {
            float[] colour = Colours.mixed(HEAD, TAIL, i / Math.max(1.0, slices.size() - 1));
            slices.get(i).forEach(particle -> colours[particle] = colour);
        }
        return colours;
    }

    private Water water(Projection projection, int width, int height, float[] body) {
        Water water = new Water(width, height, projection.from(), body, projection.scale() * scene.fluidRestDistance());
        for (int i = scene.firstFluid(); i < scene.firstFluid() + scene.fluidCount(); i++) {
            water.add(projection.x(x(i), y(i), z(i)), projection.y(x(i), y(i), z(i)), projection.depth(x(i), y(i), z(i)));
        }
        return water;
    }

    /** The shadow of the body on the ground, straight below it. */
    private void shade(float[] pixels, Projection projection, double ground, int width, int height) {
        float[] shadow = new float[width * height];
        double radius = projection.scale() * spacing("/creature/spacing");
        for (int particle : scene.body()) {
            double middleX = projection.x(x(particle), ground, z(particle));
            double middleY = projection.y(x(particle), ground, z(particle));
            for (int row = (int) Math.max(0, middleY - radius / 2); row < Math.min(height, middleY + radius / 2); row++) {
                for (int column = (int) Math.max(0, middleX - radius); column < Math.min(width, middleX + radius); column++) {
                    shadow[row * width + column] = 1;
                }
            }
        }
        Smoothing.smooth(shadow, width, height, (int) Math.max(1, radius), 3);
        for (int i = 0; i < pixels.length; i++) {
            pixels[i] *= 1 - SHADOW * shadow[i / 3];
        }
    }

    private static void over(float[] pixels, float[] body) {
        for (int at = 0; at < body.length / 4; at++) {
            for (int channel = 0; channel < 3; channel++) {
                pixels[3 * at + channel] = (1 - body[4 * at + 3]) * pixels[3 * at + channel] + body[4 * at + channel];
            }
        }
    }

    private static float[] linear(BufferedImage image) {
        int[] rgb = image.getRGB(0, 0, image.getWidth(), image.getHeight(), null, 0, image.getWidth());
        float[] pixels = new float[3 * rgb.length];
        for (int i = 0; i < rgb.length; i++) {
            for (int channel = 0; channel < 3; channel++) {
                pixels[3 * i + channel] = Colours.linear(rgb[i] >> 8 * (2 - channel) & 0xff);
            }
        }
        return pixels;
    }

    private static int[] srgb(float[] pixels) {
        int[] rgb = new int[pixels.length / 3];
        for (int i = 0; i < rgb.length; i++) {
            rgb[i] = Colours.srgb(pixels[3 * i]) << 16 | Colours.srgb(pixels[3 * i + 1]) << 8 | Colours.srgb(pixels[3 * i + 2]);
        }
        return rgb;
    }
}
