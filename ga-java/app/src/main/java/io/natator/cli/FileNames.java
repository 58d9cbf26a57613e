package io.natator.cli;

import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import picocli.CommandLine;
import picocli.CommandLine.TypeConversionException;

/** Tells of a text that cannot be the name of a file: mostly one beyond ASCII, read without a locale, which Java has no option for. */
final class FileNames {

    private static final String UTF_8 = "UTF-8";

    private FileNames() {
    }

    /** Makes a command, and those below it, tell of it in this program's words. */
    static void install(CommandLine command) {
        command.registerConverter(Path.class, text -> {
            try {
                return Path.of(text);
            } catch (InvalidPathException e) {
                throw new TypeConversionException(fault(e));
            }
        });
    }

    /** What is wrong, and what helps. */
    static String fault(InvalidPathException name) {
        return fault(name, System.getProperty("sun.jnu.encoding", UTF_8));
    }

    /** What is wrong with a file's name where Java reads names in this encoding. */
    static String fault(InvalidPathException name, String encoding) {
        return "'" + name.getInput() + "' cannot be the name of a file" + (encoding.equals(UTF_8)
                ? ": " + name.getReason()
                : " in " + encoding
                        + ", which Java has from the locale; expected LC_ALL=C.UTF-8 before java, or the command natator, which sets it");
    }
}
