package io.natator.export;

import io.natator.stream.StreamScene;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;

/**
 * The skin of a body whose slices are rows of particles in (y, z), one above the other and each as far to the left as to
 * the right: triangles between the rims of neighbouring slices, and the first and the last slice. Seen from outside, the
 * corners of a triangle go round counter-clockwise.
 */
final class BodySurface {

    /** Neighbours in a slice sit half a solid rest distance apart; rows are told apart by half of that. */
    private static final double ROW_GAP = 0.25;
    private static final int SIDES = 4;
    private static final int CORNERS = 3;

    private final List<int[]> triangles = new ArrayList<>();

    /** One particle of a rim: its place on the way round, a side from 0 to 1 after the other. */
    private record RimPoint(double way, int particle) {
    }

    private BodySurface() {
    }

    /**
     * The surface of a scene's body; without triangles if it has none or its slices are no such rows.
     *
     * @param position x, y, z of every particle at rest
     */
    static BodySurface of(StreamScene scene, float[] position) {
        return of(scene, scene.slices(), position);
    }

    /** The same of these slices, the body's or a companion's. */
    static BodySurface of(StreamScene scene, List<List<Integer>> slices, float[] position) {
        BodySurface surface = new BodySurface();
        List<int[][]> grids = new ArrayList<>();
        for (List<Integer> slice : slices) {
            int[][] grid = grid(slice, position, ROW_GAP * scene.solidRestDistance());
            if (grid == null) {
                return surface;
            }
            grids.add(grid);
        }
        if (grids.size() > 1) {
            surface.cap(grids.get(0), true);
            for (int i = 1; i < grids.size(); i++) {
                surface.join(rim(grids.get(i - 1)), rim(grids.get(i)));
            }
            surface.cap(grids.get(grids.size() - 1), false);
        }
        return surface;
    }

    /** All triangles of these. */
    static BodySurface joined(List<BodySurface> surfaces) {
        BodySurface all = new BodySurface();
        surfaces.forEach(surface -> all.triangles.addAll(surface.triangles));
        return all;
    }

    /** Rows from the bottom to the top, each from the left to the right; null if the slice does not consist of such. */
    private static int[][] grid(List<Integer> slice, float[] position, double gap) {
        List<Integer> upwards = new ArrayList<>(slice);
        upwards.sort(Comparator.comparingDouble(particle -> position[3 * particle + 1]));
        List<int[]> rows = new ArrayList<>();
        for (int from = 0, to = 1; to <= upwards.size(); to++) {
            if (to == upwards.size()
                    || position[3 * upwards.get(to) + 1] - position[3 * upwards.get(to - 1) + 1] > gap) {
                rows.add(upwards.subList(from, to).stream()
                        .sorted(Comparator.comparingDouble(particle -> position[3 * particle + 2]))
                        .mapToInt(Integer::intValue).toArray());
                from = to;
            }
        }
        int[][] grid = rows.toArray(int[][]::new);
        return isRounded(grid) ? grid : null;
    }

    /** Whether rows widen to the middle and narrow again, as far below as above it, if they differ at all. */
    private static boolean isRounded(int[][] grid) {
        for (int r = 0; r < grid.length; r++) {
            boolean widens = r == 0 || r > (grid.length - 1) / 2 || grid[r].length >= grid[r - 1].length;
            boolean even = (grid[r].length - grid[0].length) % 2 == 0;
            if (!widens || !even || grid[r].length != grid[grid.length - 1 - r].length) {
                return false;
            }
        }
        return grid.length > 0;
    }

    /** Along the bottom to the right, up, along the top to the left, and down. */
    private static List<RimPoint> rim(int[][] grid) {
        int rows = grid.length;
        int columns = grid[0].length;  // of the highest row too
        List<RimPoint> rim = new ArrayList<>();
        for (int c = 0; c < columns - 1; c++) {
            rim.add(new RimPoint(c / (columns - 1.0), grid[0][c]));
        }
        for (int r = 0; r < rows - 1; r++) {
            rim.add(new RimPoint(1 + r / (rows - 1.0), grid[r][grid[r].length - 1]));
        }
        for (int c = columns - 1; c > 0; c--) {
            rim.add(new RimPoint(2 + (columns - 1 - c) / (columns - 1.0), grid[rows - 1][c]));
        }
        for (int r = rows - 1; r > 0; r--) {
            rim.add(new RimPoint(3 + (rows - 1 - r) / (rows - 1.0), grid[r][0]));
        }
        return rim.isEmpty() ? List.of(new RimPoint(0, grid[0][0])) : rim;
    }

    /** Goes round both rims at once, on the one whose next particle comes first. */
    private void join(List<RimPoint> front, List<RimPoint> rear) {
        int i = 0;
        int j = 0;
        while (i < front.size() || j < rear.size()) {
            if (j == rear.size() || i < front.size() && next(front, i) <= next(rear, j)) {
                add(at(front, i), at(front, i + 1), at(rear, j));
                i++;
            } else {
                add(at(front, i), at(rear, j + 1), at(rear, j));
                j++;
            }
        }
    }

    private static double next(List<RimPoint> rim, int i) {
        return i + 1 < rim.size() ? rim.get(i + 1).way : SIDES + rim.get(0).way;
    }

    private static int at(List<RimPoint> rim, int i) {
        return rim.get(i % rim.size()).particle;
    }

    private void cap(int[][] grid, boolean front) {
        for (int r = 0; r + 1 < grid.length; r++) {
            for (int c = 0; c + 1 < Math.min(grid[r].length, grid[r + 1].length); c++) {
                int below = c + beyond(grid[r], grid[r + 1]);
                int above = c + beyond(grid[r + 1], grid[r]);
                int low = front ? grid[r][below + 1] : grid[r][below];
                int lowNext = front ? grid[r][below] : grid[r][below + 1];
                int high = front ? grid[r + 1][above + 1] : grid[r + 1][above];
                int highNext = front ? grid[r + 1][above] : grid[r + 1][above + 1];
                add(low, lowNext, highNext);
                add(low, highNext, high);
            }
            fan(grid[r], grid[r + 1], !front);
            fan(grid[r + 1], grid[r], front);
        }
    }

    /** Particles of a row that are further left, or further right, than all of another. */
    private static int beyond(int[] row, int[] other) {
        return Math.max(0, (row.length - other.length) / 2);
    }

    /** Triangles from the ends of a row to what a wider one has beyond them, along that one to the right or to the left. */
    private void fan(int[] wide, int[] row, boolean right) {
        int beyond = beyond(wide, row);
        for (int c = 0; c < beyond; c++) {
            int end = wide.length - 1 - c;
            if (right) {
                add(row[0], wide[c], wide[c + 1]);
                add(row[row.length - 1], wide[end - 1], wide[end]);
            } else {
                add(row[0], wide[c + 1], wide[c]);
                add(row[row.length - 1], wide[end], wide[end - 1]);
            }
        }
    }

    private void add(int a, int b, int c) {
        if (a != b && b != c && c != a) {
            triangles.add(new int[] {a, b, c});
        }
    }

    /** Number of triangles. */
    int size() {
        return triangles.size();
    }

    /** The corners of all triangles, three in turn, as places in a set that holds the body. */
    int[] corners(ParticleSet particles) {
        int[] corners = new int[CORNERS * triangles.size()];
        for (int i = 0; i < corners.length; i++) {
            corners[i] = particles.placeOf(triangles.get(i / CORNERS)[i % CORNERS]);
        }
        return corners;
    }

    /** Where in {@link #corners} each triangle ends. */
    int[] ends() {
        int[] ends = new int[triangles.size()];
        Arrays.setAll(ends, i -> CORNERS * (i + 1));
        return ends;
    }
}
