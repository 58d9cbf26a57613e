package io.natator.file;

/** Arguments in commands that are printed to be copied. */
public final class ShellWord {

    private ShellWord() {
    }

    /** One word of a POSIX shell: quoted where it has a character that could mean something else. */
    public static String of(Object argument) {
        String plain = argument.toString();
        return plain.matches("[\\w\\p{L}\\p{M}\\p{N}./,:=+@%-]+") ? plain : "'" + plain.replace("'", "'\\''") + "'";
    }
}
