/** What a run asks of results beside the distance, and of bodies: evaluators around another one, which is closed with them. */
package io.natator.fitness;
