package io.natator.picture;

/**
 * How a picture is taken.
 *
 * @param from   where from
 * @param width  pixels
 * @param height pixels; 0 for as many as what is shown takes
 * @param water  whether to show the water
 */
public record PictureOptions(From from, int width, int height, boolean water) {

    /** Fewest and most pixels each way. */
    public static final int LEAST = 64;
    /** See {@link #LEAST}. */
    public static final int MOST = 4096;
}
