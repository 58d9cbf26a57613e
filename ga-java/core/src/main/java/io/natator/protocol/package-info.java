/** What is asked of the native program and what it answers; the formats are {@code sim-native/protocol/}. */
package io.natator.protocol;
