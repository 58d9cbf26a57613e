/** Runs side by side by what their best gaits do from fresh starts, and what samples tell: medians, intervals, ranks. */
package io.natator.compare;
