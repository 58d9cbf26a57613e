#!/bin/sh
# Runs the Java half of Natator: evolve, show, view ... Its jar is named by NATATOR_JAR, or is looked for where Natator is
# installed, beside the scenes, or in the source tree that this was built in.
# Java tells of it by a stack trace.
if [ -z "$(pwd -P 2>/dev/null)" ]; then
    echo "natator: the working directory is no longer there: go to another one by cd" >&2
    exit 1
fi
self=$0
while [ -L "$self" ]; do
    target=$(readlink "$self")
    case $target in
        /*) self=$target ;;
        *) self=$(dirname "$self")/$target ;;
    esac
done
bin=$(cd "$(dirname "$self")" && pwd -P) || exit 1
installed=$bin/../share/natator/natator.jar
if [ -n "${NATATOR_JAR:-}" ]; then
    jar=$NATATOR_JAR
elif [ -f "$installed" ]; then
    jar=$installed
else
    jar=$bin/../../../ga-java/target/natator.jar
fi

if [ ! -f "$jar" ]; then
    if [ -n "${NATATOR_JAR:-}" ]; then
        echo "natator: no jar $jar, which NATATOR_JAR names" >&2
    elif [ -d "$bin/../../../ga-java" ]; then
        echo "natator: no jar $(cd "$bin/../../.." && pwd -P)/ga-java/target/natator.jar: build it there by mvn package -DskipTests, or name one by NATATOR_JAR" >&2
    else
        echo "natator: no jar $(dirname "$bin")/share/natator/natator.jar: build it by mvn package -DskipTests before cmake --install, or name one by NATATOR_JAR" >&2
    fi
    exit 1
fi
if [ -n "${JAVA_HOME:-}" ] && [ -x "$JAVA_HOME/bin/java" ]; then
    java=$JAVA_HOME/bin/java
elif command -v java >/dev/null 2>&1; then
    java=java
else
    echo "natator: no java on the PATH nor in JAVA_HOME: install a Java runtime, version 17 or later" >&2
    exit 1
fi
# Java takes file names for text in the locale's characters: without a locale, as under cron or in a container, and in one that
# is not installed these are ASCII's alone.
case $(locale charmap 2>/dev/null) in
    ANSI_X3.4-1968 | US-ASCII) export LC_ALL=C.UTF-8 ;;
esac
# How it was called, for the commands that it suggests: a name that the PATH leads to is given to this script as a path.
command=$0
name=${0##*/}
if [ "$(command -v "$name")" = "$0" ]; then
    command=$name
fi
exec "$java" "-Dnatator.command=$command" -jar "$jar" "$@"
