package io.natator.config;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.core.StreamReadFeature;
import com.fasterxml.jackson.databind.DeserializationFeature;
import com.fasterxml.jackson.databind.JsonMappingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.MapperFeature;
import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.cfg.CoercionAction;
import com.fasterxml.jackson.databind.cfg.CoercionInputShape;
import com.fasterxml.jackson.databind.exc.MismatchedInputException;
import com.fasterxml.jackson.databind.json.JsonMapper;
import com.fasterxml.jackson.databind.type.LogicalType;
import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.CharacterCodingException;
import java.nio.file.NoSuchFileException;
import java.nio.file.Path;
import java.util.Objects;
import java.util.stream.Collectors;

/** The one way in which this program reads and writes JSON: strict, nothing taken for what it is not, doubles with all their digits. */
public final class Json {

    private static final ObjectMapper MAPPER = JsonMapper.builder()
            .enable(DeserializationFeature.FAIL_ON_TRAILING_TOKENS)
            .enable(DeserializationFeature.FAIL_ON_NULL_FOR_PRIMITIVES)
            .disable(DeserializationFeature.ACCEPT_FLOAT_AS_INT)
            .enable(DeserializationFeature.FAIL_ON_NUMBERS_FOR_ENUMS).disable(MapperFeature.ALLOW_COERCION_OF_SCALARS)
            .withCoercionConfig(LogicalType.Textual,
                    text -> text.setCoercion(CoercionInputShape.Integer, CoercionAction.Fail)
                            .setCoercion(CoercionInputShape.Float, CoercionAction.Fail)
                            .setCoercion(CoercionInputShape.Boolean, CoercionAction.Fail))
            .enable(StreamReadFeature.STRICT_DUPLICATE_DETECTION).disable(StreamReadFeature.INCLUDE_SOURCE_IN_LOCATION)
            .build();

    private static final String BYTE_ORDER_MARK = "\ufeff";

    private Json() {
    }

    /** The value as one line of JSON. */
    public static String line(Object value) {
        try {
            return MAPPER.writeValueAsString(value);
        } catch (JsonProcessingException e) {
            throw new IllegalArgumentException("not expressible as JSON: " + value.getClass(), e);
        }
    }

    /** What JSON calls a constant, without quotes. */
    public static String name(Enum<?> constant) {
        return line(constant).replace("\"", "");
    }

    /** The value as indented JSON that ends with a line feed. */
    public static String document(Object value) {
        try {
            return MAPPER.writerWithDefaultPrettyPrinter().writeValueAsString(value) + "\n";
        } catch (JsonProcessingException e) {
            throw new IllegalArgumentException("not expressible as JSON: " + value.getClass(), e);
        }
    }

    /**
     * Reads one value.
     *
     * @throws JsonProcessingException if the text is not exactly one such value
     */
    public static <T> T parse(String text, Class<T> type) throws JsonProcessingException {
        T value = finite(text, type);
        if (value == null) {
            throw MismatchedInputException.from(null, type, "no value");
        }
        return value;
    }

    private static <T> T finite(String text, Class<T> type) throws JsonProcessingException {
        try (JsonParser parser = new FiniteNumbers(MAPPER.createParser(text))) {
            return MAPPER.readValue(parser, type);
        } catch (JsonProcessingException e) {
            throw e;
        } catch (IOException e) {
            throw new UncheckedIOException("a text in memory", e);
        }
    }

    /**
     * Reads one value that was parsed before.
     *
     * @throws JsonProcessingException if it is not such a value
     */
    public static <T> T tree(JsonNode node, Class<T> type) throws JsonProcessingException {
        return MAPPER.treeToValue(node, type);
    }

    /** The value as it would be written. */
    public static JsonNode tree(Object value) {
        return MAPPER.valueToTree(value);
    }

    /**
     * Reads one value that the user gave. A byte order mark before it, which editors of Windows write, is skipped.
     *
     * @param what what it is, for the message: for example {@code gait file}
     * @throws InvalidInputException if the file is missing or is not such a value
     */
    public static <T> T read(Path file, Class<T> type, String what) {
        try {
            String text = FileErrors.text(file);
            return parse(text.startsWith(BYTE_ORDER_MARK) ? text.substring(1) : text, type);
        } catch (NoSuchFileException e) {
            throw new InvalidInputException(what + " " + file + " does not exist", e);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(what + " " + file + ": " + reason(e), e);
        } catch (CharacterCodingException e) {
            throw new InvalidInputException(what + " " + file + " is not UTF-8", e);
        } catch (IOException e) {
            throw new InvalidInputException(what + " " + file + " cannot be read: " + FileErrors.reason(file, e), e);
        }
    }

    /** The beginning of a value, as messages have it. */
    public static String shown(JsonNode value) {
        return JsonErrors.shown(value);
    }

    /** Why the text was refused, as one line with the field, and the place if that is known. */
    public static String reason(JsonProcessingException e) {
        return reason(e, "line " + (e.getLocation() == null ? 0 : e.getLocation().getLineNr()) + ", ");
    }

    /** Why a line of a file was refused, without the number of the line, which the caller tells. */
    public static String reasonInLine(JsonProcessingException e) {
        return reason(e, "");
    }

    private static String reason(JsonProcessingException e, String line) {
        String message = JsonErrors.message(e);
        String field = e instanceof JsonMappingException mapping ? mapping.getPath().stream()
                .map(JsonMappingException.Reference::getFieldName).filter(Objects::nonNull)
                .collect(Collectors.joining(".")) : "";
        return (field.isEmpty() ? "" : field + ": ") + message
                + (e.getLocation() == null || e.getLocation().getLineNr() < 1 ? ""
                        : " (" + line + "column " + e.getLocation().getColumnNr() + ")");
    }
}
