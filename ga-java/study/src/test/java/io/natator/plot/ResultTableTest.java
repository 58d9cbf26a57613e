package io.natator.plot;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class ResultTableTest {

    @TempDir
    private Path folder;

    private Path file(String text) throws IOException {
        return Files.writeString(folder.resolve("results.csv"), text);
    }

    @Test
    void readsFieldsByColumn() throws IOException {
        ResultTable table = ResultTable.read(file("scene,time,note\na,1e-3,\nb,2,x\na,3,\n"), List.of("time"));

        assertThat(table.distinct("scene")).containsExactly("a", "b");
        ResultTable ofA = table.where("scene", "a", "note", "");
        assertThat(ofA.rows()).hasSize(2);
        assertThat(ofA.number(ofA.rows().get(0), "time")).isEqualTo(1e-3);
    }

    @Test
    void namesWhatIsWrong() throws IOException {
        assertThatThrownBy(() -> ResultTable.read(folder.resolve("none.csv"), List.of()))
                .isInstanceOf(InvalidInputException.class).hasMessageContaining("none.csv");
        assertThatThrownBy(() -> ResultTable.read(file("a,b\n"), List.of("c")))
                .isInstanceOf(InvalidInputException.class).hasMessageEndingWith("has no column c");
        assertThatThrownBy(() -> ResultTable.read(file("a,b\n1\n"), List.of()))
                .isInstanceOf(InvalidInputException.class).hasMessageEndingWith("line 2 has 1 field; expected 2");
        ResultTable table = ResultTable.read(file("a\nx\n"), List.of());
        assertThatThrownBy(() -> table.number(table.rows().get(0), "a")).isInstanceOf(InvalidInputException.class)
                .hasMessage("a is \"x\": must be a number");
    }
}
