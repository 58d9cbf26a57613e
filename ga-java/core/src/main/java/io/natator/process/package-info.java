/** The native program as processes: one per evaluation, kept alive, or fed with batches; what it says about itself and scenes. */
package io.natator.process;
