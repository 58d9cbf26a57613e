/** Files as this program keeps them: replaced whole, JSON values line by line, tables of comma-separated values. */
package io.natator.file;
