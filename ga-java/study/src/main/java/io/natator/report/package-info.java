/** Pictures of a run. */
package io.natator.report;
