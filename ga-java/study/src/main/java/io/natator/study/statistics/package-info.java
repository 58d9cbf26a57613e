/** What samples tell: medians with intervals, differences between samples, ranks. */
package io.natator.study.statistics;
