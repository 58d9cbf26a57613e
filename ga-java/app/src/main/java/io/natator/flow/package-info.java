/** How much of a swimmer is in the water. */
package io.natator.flow;
