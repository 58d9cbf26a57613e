/** Bodies given by curves along their length ({@code sim-native/protocol/creatures.md}), and genes that stand for them. */
package io.natator.body;
