/** {@code natator view}: a scene that swims in the browser. Serves the page, what it asks for, and running simulators. */
package io.natator.view;
