package io.natator.config;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.base.InvalidInputException;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

class AggregateTest {

    /** Reference: numpy.quantile, whose default is type 7 of Hyndman and Fan. */
    @ParameterizedTest
    @CsvSource({"MEAN, 2.25", "MEDIAN, 1.5", "LOWER_QUARTILE, 0.25"})
    void isThatOfTheRuns(Aggregate judge, double worth) {
        assertThat(judge.of(List.of(8.0, 1.0, -2.0, 2.0))).isCloseTo(worth, within(1e-12));
    }

    @ParameterizedTest
    @EnumSource(Aggregate.class)
    void ofOneRunIsThatRun(Aggregate judge) {
        assertThat(judge.of(List.of(0.7))).isEqualTo(0.7);
    }

    @ParameterizedTest
    @CsvSource({"MEAN, 0, 'starts is 0; expected a whole number from 1 to 1000'",
            "MEAN, 1001, 'starts is 1001; expected a whole number from 1 to 1000'",
            "MEDIAN, 2, 'starts is 2; expected at least 3 with --judge median'",
            "LOWER_QUARTILE, 3, 'starts is 3; expected at least 4 with --judge lower-quartile'"})
    void needsEnoughStarts(Aggregate judge, int starts, String message) {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2);
        assertThatThrownBy(() -> settings.withStarts(starts, judge)).isInstanceOf(InvalidInputException.class)
                .hasMessage(message);
        assertThat(settings.withStarts(judge.leastRuns(), judge).search().judge()).isEqualTo(judge);
    }

    /** Settings of a folder that was written before there were several starts. */
    @Test
    void withoutAnyThereIsOneStart() throws Exception {
        EvolutionSettings now = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2);
        String before = Json.line(now).replace(",\"starts\":1,\"judge\":\"mean\"", "");
        assertThat(before).doesNotContain("starts");
        assertThat(Json.parse(before, EvolutionSettings.class)).isEqualTo(now);
    }
}
