package io.natator.plot;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.plot.ParetoFront.Point;
import java.util.List;
import org.junit.jupiter.api.Test;

class ParetoFrontTest {

    @Test
    void holdsWhatNothingBeats() {
        List<Point> points = List.of(new Point(4, 1), new Point(1, 9), new Point(2, 9), new Point(3, 2),
                new Point(5, 3), new Point(1, 9), new Point(1, 10));

        assertThat(ParetoFront.of(points)).containsExactly(new Point(1, 9), new Point(3, 2), new Point(4, 1));
    }

    @Test
    void ofNothingIsEmpty() {
        assertThat(ParetoFront.of(List.of())).isEmpty();
    }
}
