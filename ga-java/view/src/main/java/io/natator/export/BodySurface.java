package io.natator.export;

import io.natator.stream.StreamScene;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;

/**
 * The skin of a body whose slices are grids in (y, z): triangles between the rims of neighbouring slices, and the first
 * and the last slice. Seen from outside, the corners of a triangle go round counter-clockwise.
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
     * The surface of a scene's body; without triangles if it has none or its slices are no grids.
     *
     * @param position x, y, z of every particle at rest
     */
    static BodySurface of(StreamScene scene, float[] position) {
        BodySurface surface = new BodySurface();
        List<int[][]> grids = new ArrayList<>();
        for (List<Integer> slice : scene.slices()) {
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

    /** Rows from the bottom to the top, each from the left to the right; null if the slice is not such a grid. */
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
        boolean complete = !rows.isEmpty() && rows.stream().allMatch(row -> row.length == rows.get(0).length);
        return complete ? rows.toArray(int[][]::new) : null;
    }

    /** Along the bottom to the right, up, along the top to the left, and down. */
    private static List<RimPoint> rim(int[][] grid) {
        int rows = grid.length;
        int columns = grid[0].length;
        List<RimPoint> rim = new ArrayList<>();
        for (int c = 0; c < columns - 1; c++) {
            rim.add(new RimPoint(c / (columns - 1.0), grid[0][c]));
        }
        for (int r = 0; r < rows - 1; r++) {
            rim.add(new RimPoint(1 + r / (rows - 1.0), grid[r][columns - 1]));
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
            for (int c = 0; c + 1 < grid[0].length; c++) {
                int low = front ? grid[r][c + 1] : grid[r][c];
                int lowNext = front ? grid[r][c] : grid[r][c + 1];
                int high = front ? grid[r + 1][c + 1] : grid[r + 1][c];
                int highNext = front ? grid[r + 1][c] : grid[r + 1][c + 1];
                add(low, lowNext, highNext);
                add(low, highNext, high);
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
