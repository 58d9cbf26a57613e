/** Gaits, and how genes stand for them (thesis 2.5 and 2.6). */
package io.natator.encoding;
