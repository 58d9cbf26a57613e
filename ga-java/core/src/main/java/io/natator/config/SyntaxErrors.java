package io.natator.config;

import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** Why a text is no JSON: what was found and what was expected, without the parser's own names for both. */
final class SyntaxErrors {

    private static final String CHARACTER = "Unexpected character \\('(.+)' \\(code [^)]*\\)\\)";

    /** What the parser says, and that in plain words; the first that fits counts. */
    private static final List<Rule> RULES = List.of(
            rule("Unexpected end-of-input.*", "ends too early; expected the rest of the JSON text"),
            rule(CHARACTER + ": was expecting double-quote to start field name.*",
                    "found '$1'; expected a key in double quotes"),
            rule(CHARACTER + ": was expecting a colon.*", "found '$1'; expected a colon"),
            rule(CHARACTER + ": was expecting comma to separate Object.*", "found '$1'; expected a comma or '}'"),
            rule(CHARACTER + ": was expecting comma to separate Array.*", "found '$1'; expected a comma or ']'"),
            rule("Unexpected character \\('.' \\(code 65279 .*", "found a byte order mark; expected JSON"),
            rule(CHARACTER + ": expected a valid value.*", "found '$1'; expected a value"),
            rule(CHARACTER + ": expected a hex-digit.*", "found '$1'; expected a hexadecimal digit"),
            rule(CHARACTER + " in numeric value.*", "found '$1'; expected a digit"),
            rule(CHARACTER + ".*", "found '$1'; expected JSON"),
            rule("Unexpected close marker '(.)': expected '(.)'.*", "found '$1'; expected a comma or '$2'"),
            rule("Unexpected close marker '(.)'.*", "found '$1', which closes nothing; expected JSON"),
            rule("Unrecognized token '(.*?)': .*", "found '$1'; expected JSON"),
            rule("Non-standard token '(.*?)'.*", "found '$1'; expected a number"),
            rule("Invalid numeric value: Leading zeroes.*", "found a number that begins with 0; expected it without"),
            rule("Illegal unquoted character \\(\\(CTRL-CHAR, code (\\d+)\\)\\).*",
                    "found a control character (code $1) in a text; expected an escape such as \\\\n"),
            rule("Illegal character \\(\\(CTRL-CHAR, code (\\d+)\\)\\).*",
                    "found a control character (code $1); expected JSON"),
            rule("Unrecognized character escape '(.+)'.*", "found '\\\\$1'; expected an escape that JSON has"),
            rule("Duplicate field '(.*)'", "key '$1' stands twice; expected it once"),
            rule("Trailing token.*", "found another value after the first; expected one"),
            rule("Numeric value \\((.*)\\) out of range of \\w+ \\((-?\\d+) - (\\d+)\\).*",
                    "expected a whole number from $2 to $3, not '$1'"),
            rule("([\\w ]+) \\((\\d+)\\) exceeds the maximum allowed \\((\\d+),.*", "$1 is $2; expected at most $3"));

    private record Rule(Pattern told, String said) {
    }

    private SyntaxErrors() {
    }

    private static Rule rule(String told, String said) {
        return new Rule(Pattern.compile(told, Pattern.DOTALL), said);
    }

    /** The message in plain words; as it is if it is none of a parser. */
    static String plain(String message) {
        for (Rule rule : RULES) {
            Matcher matcher = rule.told.matcher(message);
            if (matcher.matches()) {
                return matcher.replaceFirst(rule.said);
            }
        }
        return message;
    }
}
