/** Settings with their ranges, and how they are read from and written as JSON. */
package io.natator.config;
