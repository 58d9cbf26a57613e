/** What all packages may use and that uses none of them: numbers as text, bad input, patches of JSON, digests. */
package io.natator.base;
