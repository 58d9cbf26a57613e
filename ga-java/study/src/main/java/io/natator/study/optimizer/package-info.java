/** Optimizers compared at an equal number of evaluations. Begin with {@code OptimizerStudy}. */
package io.natator.study.optimizer;
