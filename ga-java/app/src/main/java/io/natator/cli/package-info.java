/** The command line: options, progress, messages and exit statuses. */
package io.natator.cli;
