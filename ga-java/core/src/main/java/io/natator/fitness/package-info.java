/** What a run asks of results beside the distance: evaluators around another one, which is closed with them. */
package io.natator.fitness;
