package io.natator.file;

/** Arguments in commands that are printed to be copied. */
public final class ShellWord {

    private ShellWord() {
    }

    /** As one word of a POSIX shell: in quotes where it has a character that could mean something else. */
    public static String of(Object argument) {
        String plain = argument.toString();
        return plain.matches("[\\w\\p{L}\\p{M}\\p{N}./,:=+@%-]+") ? plain : "'" + plain.replace("'", "'\\''") + "'";
    }
}
