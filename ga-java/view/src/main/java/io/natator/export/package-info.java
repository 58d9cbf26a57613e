/** A swim in the formats of other programs: ParaView, Blender, USD, tables and numpy. */
package io.natator.export;
