/** Figures that sum up a generation. */
package io.natator.analysis;
