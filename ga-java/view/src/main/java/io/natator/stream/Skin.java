package io.natator.stream;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.Arrays;
import java.util.List;

/**
 * The mesh that a body was made of. Each vertex moves as one of the body's clusters and the next one do, by their shares.
 *
 * @param file      as the creature names it
 * @param vertices  x, y, z each at rest, from the centre of the last slice
 * @param triangles three vertices each, counter-clockwise seen from outside
 * @param cluster   of each vertex, the cluster nearer the head
 * @param share     of each vertex, how much it follows that cluster; the rest is the next one's
 * @param rest      x, y, z of the body's particles at rest, in the order of {@link StreamScene#body}, from the same place
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record Skin(String file, @JsonProperty(required = true) List<double[]> vertices,
        @JsonProperty(required = true) List<int[]> triangles, @JsonProperty(required = true) int[] cluster,
        @JsonProperty(required = true) double[] share, @JsonProperty(required = true) List<double[]> rest) {

    /** Whether it fits a body of so many particles and clusters. */
    boolean fits(int particles, int clusters) {
        int count = vertices.size();
        if (cluster.length != count || share.length != count || rest.size() != particles
                || !vertices.stream().allMatch(Skin::isPlace) || !rest.stream().allMatch(Skin::isPlace)) {
            return false;
        }
        for (int i = 0; i < count; i++) {
            boolean last = cluster[i] == clusters - 1;
            if (cluster[i] < 0 || cluster[i] >= clusters || !(share[i] >= 0 && share[i] <= 1) || last && share[i] < 1) {
                return false;
            }
        }
        return triangles.stream().allMatch(corners -> corners != null && corners.length == 3
                && Arrays.stream(corners).allMatch(corner -> corner >= 0 && corner < count));
    }

    private static boolean isPlace(double[] place) {
        return place != null && place.length == 3;
    }
}
