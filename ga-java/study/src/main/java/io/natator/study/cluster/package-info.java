/** How well a cluster would be used: a simulation of its driver and executors, by measured times of evaluations. */
package io.natator.study.cluster;
