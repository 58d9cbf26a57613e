/** The run folder: what is written when, and how a run continues from it. */
package io.natator.checkpoint;
