/** One HTML file that replays swims without this program. */
package io.natator.replay;
