package io.natator.cli;

import java.lang.annotation.ElementType;
import java.lang.annotation.Retention;
import java.lang.annotation.RetentionPolicy;
import java.lang.annotation.Target;

/** Under which heading of a command's help an option stands; on a class, all the options declared in it. */
@Retention(RetentionPolicy.RUNTIME)
@Target({ElementType.FIELD, ElementType.TYPE})
@interface Section {

    Topic value();

    /** The headings, in their order. */
    enum Topic {
        SCENE("What swims"), SEARCH("How its gait is searched for"), EXTENT("How much is done"), COMPUTING(
                "How it is computed"), OUTPUT(
                        "What is written, and where"), PAGE("Where the page is served"), OTHER("Other options");

        private final String heading;

        Topic(String heading) {
            this.heading = heading;
        }

        String heading() {
            return heading;
        }
    }
}
