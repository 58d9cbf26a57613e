package io.natator.export;

import java.util.Locale;

/** What a particle is; files hold the ordinal, tables the name. */
public enum ParticleKind {
    /** Of the fluid. */
    WATER,
    /** Of the swimming body. */
    BODY,
    /** A solid that belongs to no body. */
    OTHER;

    /** Its name in tables. */
    public String text() {
        return name().toLowerCase(Locale.ROOT);
    }
}
