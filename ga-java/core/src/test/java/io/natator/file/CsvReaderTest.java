package io.natator.file;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.natator.base.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class CsvReaderTest {

    @TempDir
    private Path folder;
    private Path file;

    @BeforeEach
    void name() {
        file = folder.resolve("table.csv");
    }

    private CsvReader reader(String text, String... required) throws IOException {
        return new CsvReader(Files.writeString(file, text), List.of(required));
    }

    @Test
    void readsFieldsByColumn() throws IOException {
        try (CsvReader table = reader("name,x,note\na,-1e-3,\n\"b, \"\"c\"\"\",2, d \n", "x", "name")) {
            assertThat(table.columns()).containsExactly("name", "x", "note");
            assertThat(table.next()).isTrue();
            assertThat(table.fields()).containsExactly("a", "-1e-3", "");
            assertThat(table.number("x")).isEqualTo(-1e-3);
            assertThat(table.next()).isTrue();
            assertThat(table.text("name")).isEqualTo("b, \"c\"");
            assertThat(table.text("note")).isEqualTo(" d ");
            assertThat(table.next()).isFalse();
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            ''             | ' has no column x'
            'a,b;'         | ' has no column x'
            'a,x;1,2;3;'   | ', line 3 has 1 field; expected 2'
            'a,x;1,2,3;'   | ', line 2 has 3 fields; expected 2'
            'a,x;1,2;;3,4' | ', line 3 has 1 field; expected 2'
            'a,x;1,two;'   | ', line 2: x is "two"; expected a number'
            'a,x;1,2;3,'   | ', line 3: x is ""; expected a number'
            'a,x;1,"2'     | ', line 2: Missing closing quote for value'
            """)
    void namesWhatIsWrong(String text, String message) {
        assertThatThrownBy(() -> {
            try (CsvReader table = reader(text.replace(';', '\n'), "x")) {
                while (table.next()) {
                    table.number("x");
                }
            }
        }).isInstanceOf(InvalidInputException.class).hasMessageStartingWith(file + message);
    }

    @Test
    void namesAFileThatIsNotThere() {
        assertThatThrownBy(() -> new CsvReader(file, List.of())).isInstanceOf(InvalidInputException.class)
                .hasMessage(file + " cannot be read: no such file or folder");
    }
}
