package io.natator.body;

import io.natator.base.Numbers;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Collectors;

/** An evolved body in words, beside that of its scene. */
public final class BodyText {

    private static final int DIGITS = 3;

    private BodyText() {
    }

    /** Rows of name and text; lengths in scene units, places in percent of the body's length. */
    public static Map<String, String> of(ProfileBody body, ProfileBody scene) {
        Map<String, String> text = new LinkedHashMap<>();
        text.put("length", number(body.length()) + " units" + beside(number(scene.length())));
        text.put("height", curves(body, scene, ProfileBody::height, " units"));
        text.put("width", curves(body, scene, ProfileBody::width, " units"));
        if (body.fin() != null) {
            text.put("fin height", curves(body, scene, ProfileBody::fin, " units"));
        }
        text.put("joints", percent(body.joints()) + " % of the length" + beside(percent(scene.joints())));
        text.put("stiffness", curves(body, scene, ProfileBody::stiffness, ""));
        text.put("muscles", curves(body, scene, ProfileBody::muscles, ""));
        text.put("particles", body.particles() + beside("" + scene.particles()));
        return text;
    }

    private static String beside(String ofScene) {
        return ", the scene's " + ofScene;
    }

    private static String curves(ProfileBody body, ProfileBody scene, Function<ProfileBody, Curve> which, String unit) {
        List<Double> places = which.apply(body).points().stream().map(Curve.Point::at).toList();
        Function<ProfileBody, String> values = one -> places.stream().map(place -> number(which.apply(one).at(place)))
                .collect(Collectors.joining(" "));
        return values.apply(body) + unit + " at " + percent(places) + " % of the length" + beside(values.apply(scene));
    }

    private static String percent(List<Double> parts) {
        return parts.stream().map(part -> "" + Math.round(100 * part)).collect(Collectors.joining(" "));
    }

    private static String number(double value) {
        return Numbers.significant(value, DIGITS);
    }
}
