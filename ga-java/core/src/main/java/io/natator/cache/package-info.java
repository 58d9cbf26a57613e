/** Evaluations that are never done twice. */
package io.natator.cache;
