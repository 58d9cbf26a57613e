/** The fluid at one moment: its velocity and vorticity in a plane. */
package io.natator.flow;
