/** What a run's best gait comes to, in words, and whether today's program repeats it. */
package io.natator.verdict;
