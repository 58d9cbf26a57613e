/** Evaluations on the executors of an Apache Spark cluster; the evolution itself stays in the driver. */
package io.natator.spark;
