/** A scene that runs while someone watches: the reading side of {@code sim-native/protocol/stream.md}. */
package io.natator.stream;
