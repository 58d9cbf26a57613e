package io.natator.view;

import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.Locale;
import java.util.Set;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Who may talk to the server: only pages that it served itself. A foreign name in {@code Host} is that of a site which
 * has made its name point to this machine, so that the browser takes the two for one; an address cannot be so abused.
 */
final class AllowedHosts {

    private static final Pattern HOST = Pattern.compile("(?<name>[A-Za-z0-9._-]+|\\[[0-9A-Fa-f:.]+\\])(:[0-9]{1,5})?");
    private static final Pattern ADDRESS = Pattern.compile("[0-9]+(\\.[0-9]+){3}|\\[.*\\]");

    private final Set<String> names;

    /** Those by which a server that listens at a host can be reached. */
    AllowedHosts(String host) {
        names = Stream.of("localhost", host.toLowerCase(Locale.ROOT), ownName()).collect(Collectors.toSet());
    }

    private static String ownName() {
        try {
            return InetAddress.getLocalHost().getHostName().toLowerCase(Locale.ROOT);
        } catch (UnknownHostException e) {
            return "";
        }
    }

    /** Whether a {@code Host} header names this server. */
    boolean contains(String host) {
        Matcher parts = HOST.matcher(host == null ? "" : host);
        return parts.matches() && (ADDRESS.matcher(parts.group("name")).matches()
                || names.contains(parts.group("name").toLowerCase(Locale.ROOT)));
    }

    /** Whether a page of this origin was served under this {@code Host}. Browsers send both when they open a socket. */
    boolean isOwnPage(String origin, String host) {
        return contains(host)
                && Stream.of("http://", "https://").anyMatch(scheme -> (scheme + host).equalsIgnoreCase(origin));
    }
}
