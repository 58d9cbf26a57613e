package io.natator.config;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.exc.InvalidFormatException;
import com.fasterxml.jackson.databind.exc.MismatchedInputException;
import com.fasterxml.jackson.databind.exc.UnrecognizedPropertyException;
import com.fasterxml.jackson.databind.exc.ValueInstantiationException;
import io.natator.base.InvalidInputException;
import java.util.Arrays;
import java.util.Collection;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

/** What is wrong with a JSON text, without the names that classes and settings have in this program. */
final class JsonErrors {

    private static final int MAX_SHOWN = 60;
    private static final Pattern REFUSED_VALUE = Pattern.compile("^Cannot coerce \\w+ value \\(\"?(.*?)\"?\\) to ");

    private JsonErrors() {
    }

    /** One line, without the place. */
    static String message(JsonProcessingException e) {
        if (e instanceof UnrecognizedPropertyException unknown) {
            return "unknown key; expected some of " + unknown.getKnownPropertyIds().stream().map(String::valueOf)
                    .collect(Collectors.joining(", "));
        }
        if (e instanceof ValueInstantiationException) {
            if (e.getCause() instanceof InvalidInputException || e.getCause() instanceof IllegalArgumentException) {
                return e.getCause().getMessage();
            }
            return isMissing(e.getCause()) ? e.getCause().getMessage() + " is missing"
                    : "expected an object with all its keys";
        }
        String message = e.getOriginalMessage().lines().findFirst().orElse("not JSON");
        if (message.startsWith("No content")) {
            return "found nothing; expected a JSON text";
        }
        if (message.startsWith("Unexpected end-of-input")) {
            return "ends too early; expected the rest of the JSON text";
        }
        if (message.startsWith("Trailing token")) {
            return "found another value after the first; expected one";
        }
        if (e instanceof MismatchedInputException mismatch && mismatch.getTargetType() != null) {
            return "expected " + described(mismatch.getTargetType())
                    + (e instanceof InvalidFormatException invalid ? ", not " + shortened(invalid.getValue())
                            : taken(message));
        }
        return message.replaceFirst(": enable `.*", "");
    }

    /** Whether a record required a key by its name and did not get it. */
    private static boolean isMissing(Throwable cause) {
        return cause instanceof NullPointerException && cause.getMessage() != null
                && cause.getMessage().matches("\\w+");
    }

    /** The value that Jackson says it does not take for another type. */
    private static String taken(String message) {
        Matcher value = REFUSED_VALUE.matcher(message);
        return value.find() ? ", not " + shortened(value.group(1)) : "";
    }

    private static String shortened(Object value) {
        return "'" + shown(value) + "'";
    }

    /** The beginning of a value, as messages have it. */
    static String shown(Object value) {
        String text = String.valueOf(value);
        return text.length() > MAX_SHOWN ? text.substring(0, MAX_SHOWN) + "…" : text;
    }

    private static String described(Class<?> type) {
        if (type.isEnum()) {
            return "one of " + Arrays.stream(type.getEnumConstants())
                    .map(one -> Json.name((Enum<?>) one)).collect(Collectors.joining(", "));
        }
        if (type == int.class || type == long.class || type == Integer.class || type == Long.class) {
            return "a whole number";
        }
        if (type.isPrimitive() && type != boolean.class || Number.class.isAssignableFrom(type)) {
            return "a number";
        }
        if (type == boolean.class || type == Boolean.class) {
            return "true or false";
        }
        if (type == String.class) {
            return "a text";
        }
        return type.isArray() || Collection.class.isAssignableFrom(type) ? "a list" : "an object";
    }
}
