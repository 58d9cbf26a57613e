/** Pictures of the native program's studies, from the CSV that {@code natator-sim bench} writes. */
package io.natator.plot;
