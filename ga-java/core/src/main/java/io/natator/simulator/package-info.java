/** Evaluations by the native program over pipes; the protocol is {@code sim-native/protocol/}. */
package io.natator.simulator;
