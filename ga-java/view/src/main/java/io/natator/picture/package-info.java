/** A frame of a swim as a picture, drawn without a browser or a graphics card. */
package io.natator.picture;
