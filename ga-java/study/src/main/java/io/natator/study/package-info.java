/**
 * Studies made of many evaluations. {@code compare-flex}: the swimming speeds of scenes and variants beside those that
 * NVIDIA Flex 1.2.0 was measured to give.
 */
package io.natator.study;
