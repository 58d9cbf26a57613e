/** The thesis done again: evolution of all its creatures, its tables, figures and other experiments. */
package io.natator.study.thesis;
