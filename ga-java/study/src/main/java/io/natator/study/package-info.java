/** Studies of what the simulator and the optimizers give. */
package io.natator.study;
