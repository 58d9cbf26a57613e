/** Evolutions in run folders, from the settings to the report. Begin with {@link io.natator.run.EvolutionRun}. */
package io.natator.run;
