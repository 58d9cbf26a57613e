package io.natator.cli;

import java.io.PrintWriter;
import java.io.StringWriter;
import picocli.CommandLine;

/** What a command prints at once when all of it is known: of what is refused meanwhile, nothing. */
final class WholeOutput {

    /** Writes what is to be printed. */
    interface Content {
        void write(PrintWriter out) throws InterruptedException;
    }

    private WholeOutput() {
    }

    /** Prints it to the command's standard output. */
    static void print(CommandLine command, Content content) throws InterruptedException {
        StringWriter text = new StringWriter();
        content.write(new PrintWriter(text));
        command.getOut().print(text);
        command.getOut().flush();
    }
}
