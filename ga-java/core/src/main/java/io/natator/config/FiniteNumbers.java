package io.natator.config;

import com.fasterxml.jackson.core.JsonParseException;
import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.util.JsonParserDelegate;
import java.io.IOException;

/** A parser that refuses numbers beyond the range of doubles, such as 1e400, which Jackson takes for infinity. */
final class FiniteNumbers extends JsonParserDelegate {

    FiniteNumbers(JsonParser parser) {
        super(parser);
    }

    @Override
    public double getDoubleValue() throws IOException {
        double value = super.getDoubleValue();
        if (Double.isInfinite(value)) {
            throw new JsonParseException(this, "found the number " + getText() + "; expected one within 1.8e308");
        }
        return value;
    }
}
