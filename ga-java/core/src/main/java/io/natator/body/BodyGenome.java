package io.natator.body;

import io.natator.body.Curve.Point;
import io.natator.encoding.GeneRange;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.Locale;
import java.util.function.DoublePredicate;
import java.util.function.UnaryOperator;

/**
 * Genes of a body, around that of a scene: length, height and width at a few places, the fin's height, places of the joints,
 * stiffness and muscle strength along the body. The number of joints stays, and with it that of the muscles. Whatever the
 * genes, the body has as many particles as the scene's, by scaling of its cross-sections, and its muscles pull as hard together.
 */
public final class BodyGenome {

    private static final double MIN_LENGTH = 0.75;
    private static final double MAX_LENGTH = 1.3;
    private static final double MIN_THICKNESS = 0.6;
    private static final double MAX_THICKNESS = 1.6;
    private static final double MIN_STIFFNESS = 0.1;
    /** Share of the way to the next joint that a joint may move. */
    private static final double JOINT_MOVE = 0.45;
    /** Least range of a joint on either side, as a share of the body's length. */
    private static final double MIN_MOVE = 0.001;
    /** Share of the particles that may be too many or too few. */
    private static final double HELD = 0.01;
    /** Section sizes are scaled by up to so much more in front than behind, or less, until the particles are held. */
    private static final double MAX_TILT = 0.2;
    private static final double TILT_STEP = 0.02;
    private static final double MAX_SCALE = 4;
    private static final int HALVINGS = 40;
    /** Against rounding at the least thickness. */
    private static final double ABOVE = 1 + 1e-9;

    private final ProfileBody scene;
    private final Curve height;
    private final Curve width;
    private final Curve stiffness;
    private final Curve muscles;
    private final List<GeneRange> genes = new ArrayList<>();
    private final List<Double> own = new ArrayList<>();

    /** Genes around this body. */
    public BodyGenome(ProfileBody scene) {
        this.scene = scene;
        double end = scene.finBegin();
        height = controlled(scene.height(), 3, 8, 5, end);
        width = controlled(scene.width(), 3, 8, 5, end);
        stiffness = controlled(scene.stiffness(), 2, 5, 3, 1);
        muscles = controlled(scene.muscles(), 2, 5, 3, 1);
        double shortest = Math.max(MIN_LENGTH * scene.length(), (scene.joints().size() + 4) * scene.spacing());
        add("length", Math.min(shortest, scene.length()), MAX_LENGTH * scene.length(), scene.length());
        addSections("height", height);
        addSections("width", width);
        if (scene.fin() != null) {
            double tip = last(scene.fin()).value();
            add("fin height", Math.max(thinnest(), MIN_THICKNESS * tip), MAX_THICKNESS * tip, tip);
        }
        addJoints(scene.jointEnd());
        addStiffness("stiffness", stiffness);
        addStiffness("muscle strength", muscles);
    }

    /** A curve with as many points as suit genes: its own, else so many of equal distance. */
    private static Curve controlled(Curve curve, int least, int most, int usual, double end) {
        int points = curve.points().size();
        if (points >= least && points <= most) {
            return curve;
        }
        List<Point> even = new ArrayList<>();
        for (int i = 0; i < usual; i++) {
            double at = end * i / (usual - 1);
            even.add(new Point(at, curve.at(at)));
        }
        return new Curve(even);
    }

    private void add(String name, double lower, double upper, double value) {
        genes.add(new GeneRange(name, lower, upper));
        own.add(Math.min(Math.max(value, lower), upper));
    }

    private void addSections(String name, Curve curve) {
        for (Point point : curve.points()) {
            if (isShown(point)) {
                add(named(name, point), Math.max(thinnest(), MIN_THICKNESS * point.value()),
                        MAX_THICKNESS * point.value(), point.value());
            }
        }
    }

    /** Height and width are not used behind the beginning of the fin. */
    private boolean isShown(Point point) {
        return point.at() <= scene.finBegin();
    }

    private void addStiffness(String name, Curve curve) {
        curve.points().forEach(point -> add(named(name, point), MIN_STIFFNESS, 1, point.value()));
    }

    private static String named(String name, Point point) {
        return String.format(Locale.ROOT, "%s at %.0f %%", name, 100 * point.at());
    }

    private void addJoints(double end) {
        List<Double> joints = scene.joints();
        for (int i = 0; i < joints.size(); i++) {
            double before = i == 0 ? 0 : joints.get(i - 1);
            double behind = i + 1 == joints.size() ? end : joints.get(i + 1);
            double move = Math.max(MIN_MOVE, JOINT_MOVE * Math.min(joints.get(i) - before, behind - joints.get(i)));
            add("joint " + (i + 1), joints.get(i) - move, joints.get(i) + move, joints.get(i));
        }
    }

    private double thinnest() {
        return CrossSection.MIN_EXTENT * scene.spacing() * ABOVE;
    }

    private static Point last(Curve curve) {
        return curve.points().get(curve.points().size() - 1);
    }

    /** Names and ranges: lengths in scene units, joints in parts of the length. */
    public List<GeneRange> genes() {
        return List.copyOf(genes);
    }

    /** What stands for the scene's own body. */
    public List<Double> own() {
        return List.copyOf(own);
    }

    /**
     * The body that genes stand for. What would be too thin, or two joints in one slice, is mended.
     *
     * @param values as many as {@link #genes()}, each within its range
     */
    public ProfileBody decode(List<Double> values) {
        Iterator<Double> next = values.iterator();
        double length = next.next();
        Curve tall = height.map(point -> isShown(point) ? new Point(point.at(), next.next()) : point);
        Curve wide = width.map(point -> isShown(point) ? new Point(point.at(), next.next()) : point);
        Curve fin = scene.fin() == null ? null : finOf(next.next());
        List<Double> joints = new ArrayList<>();
        scene.joints().forEach(joint -> joints.add(next.next()));
        Curve stiff = stiffness.map(point -> new Point(point.at(), next.next()));
        Curve strong = muscles.map(point -> new Point(point.at(), next.next()));
        ProfileBody drawn = new ProfileBody(scene.spacing(), length, tall, wide, fin, scene.thickness(), joints, stiff,
                strong);
        return withStrength(withParticles(withJoints(drawn)));
    }

    private Curve finOf(double tip) {
        double scale = tip / last(scene.fin()).value();
        return scene.fin().map(point -> new Point(point.at(), Math.max(thinnest(), scale * point.value())));
    }

    /** Each joint in a slice of its own, behind the first and before the last, and not in a thin fin. */
    private static ProfileBody withJoints(ProfileBody body) {
        int last = Math.min(body.slices() - 2, (int) Math.ceil(body.jointEnd() * body.slices() - 0.5) - 1);
        List<Integer> slices = new ArrayList<>(body.jointSlices());
        for (int i = 0; i < slices.size(); i++) {
            slices.set(i, Math.max(slices.get(i), i == 0 ? 1 : slices.get(i - 1) + 1));
        }
        for (int i = slices.size() - 1; i >= 0; i--) {
            slices.set(i, Math.min(slices.get(i), i + 1 == slices.size() ? last : slices.get(i + 1) - 1));
        }
        return body.withJoints(slices.stream().map(slice -> body.part(slice)).toList());
    }

    /** Scaled until it has as many particles as the scene's body; as near to that as the lattice allows. */
    private ProfileBody withParticles(ProfileBody body) {
        int wanted = scene.particles();
        ProfileBody best = scaled(body, 1, 0);
        for (int step = 0; step * TILT_STEP <= MAX_TILT && off(best, wanted) > HELD * wanted; step++) {
            for (int side = -1; side <= 1; side += 2) {
                best = nearest(best, body, side * step * TILT_STEP, wanted);
            }
        }
        return best;
    }

    /** The best so far, or what comes nearer with sections that grow by the tilt towards the tail. */
    private ProfileBody nearest(ProfileBody best, ProfileBody body, double tilt, int wanted) {
        ProfileBody nearest = best;
        for (double scale : bisect(1 / MAX_SCALE, MAX_SCALE,
                middle -> scaled(body, middle, tilt).particles() < wanted)) {
            ProfileBody candidate = scaled(body, scale, tilt);
            nearest = off(candidate, wanted) < off(nearest, wanted) ? candidate : nearest;
        }
        return nearest;
    }

    private static int off(ProfileBody body, int wanted) {
        return Math.abs(body.particles() - wanted);
    }

    private ProfileBody scaled(ProfileBody body, double scale, double tilt) {
        UnaryOperator<Point> change = point -> new Point(point.at(),
                Math.max(thinnest(), scale * (1 + tilt * (2 * point.at() - 1)) * point.value()));
        return body.with(to -> to.height(body.height().map(change)).width(body.width().map(change)));
    }

    /** With muscles that pull as hard together as those of the scene's body, none harder than 1. */
    private ProfileBody withStrength(ProfileBody body) {
        double wanted = scene.strength();
        double scale = wanted / body.strength();
        if (body.muscles().points().stream().allMatch(point -> scale * point.value() <= 1)) {
            return stronger(body, scale);
        }
        return stronger(body,
                bisect(scale, 1 / MIN_STIFFNESS, middle -> stronger(body, middle).strength() < wanted)[1]);
    }

    /** The ends of an interval that is halved until they hardly differ: what lies below the place where {@code isBelow} ends, and above it. */
    private static double[] bisect(double low, double high, DoublePredicate isBelow) {
        double[] ends = {low, high};
        for (int i = 0; i < HALVINGS; i++) {
            double middle = (ends[0] + ends[1]) / 2;
            ends[isBelow.test(middle) ? 0 : 1] = middle;
        }
        return ends;
    }

    private static ProfileBody stronger(ProfileBody body, double scale) {
        return body.withMuscles(body.muscles().map(point -> new Point(point.at(), Math.min(1, scale * point.value()))));
    }
}
