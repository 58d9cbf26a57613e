package io.natator.view;

import io.javalin.http.Context;
import io.natator.base.Sha256;
import java.util.Base64;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/** Headers that let a page load from this server alone, and let no other site use it. */
final class SecurityHeaders {

    private static final Pattern INLINE_SCRIPT = Pattern.compile("<script(?![^>]*\\ssrc=)[^>]*>(.*?)</script>",
            Pattern.DOTALL | Pattern.CASE_INSENSITIVE);

    private final String scripts;

    /**
     * Headers for one page.
     *
     * @param html the scripts that it holds itself, such as its import map, are allowed by their hashes
     */
    SecurityHeaders(String html) {
        StringBuilder allowed = new StringBuilder("'self'");
        for (Matcher script = INLINE_SCRIPT.matcher(html); script.find();) {
            allowed.append(" 'sha256-")
                    .append(Base64.getEncoder().encodeToString(Sha256.digest(script.group(1)))).append('\'');
        }
        scripts = allowed.toString();
    }

    /** Sets them on an answer; its {@code Host} was checked. */
    void set(Context answer) {
        answer.header("Content-Security-Policy", "default-src 'none'; script-src " + scripts
                + "; style-src 'self'; img-src 'self' data: blob:; connect-src 'self' ws://" + answer.header("Host")
                + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
        answer.header("X-Content-Type-Options", "nosniff");
        answer.header("Referrer-Policy", "no-referrer");
        answer.header("Cross-Origin-Opener-Policy", "same-origin");
        answer.header("Cross-Origin-Resource-Policy", "same-origin");
        answer.header("Cache-Control", "no-cache");
    }
}
