package io.natator.cli;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Runs that an earlier version evolved on islands, which exchanged gaits: {@code run} and in it {@code island-1}. */
class EarlierIslandsTest extends FakeSimulatorTest {

    private Path run;
    private Path island;

    /** As {@code --islands 2} left it. */
    @BeforeEach
    void evolved() throws IOException {
        run = folder.resolve("run");
        island = run.resolve("island-1");
        assertThat(evolve("run/island-1")).as(err.toString()).isZero();
        ObjectNode migration = Json.parse("{\"islands\":2,\"island\":1,\"every\":1,\"migrants\":1}", ObjectNode.class);
        Path config = island.resolve("config.json");
        ObjectNode settings = Json.read(config, ObjectNode.class, "settings");
        Files.writeString(run.resolve("islands.json"), Json.document(Json.parse("{\"islands\":2,\"every\":1,\"migrants\":1}", ObjectNode.class)
                .set("settings", settings)));
        Files.writeString(config, Json.document(settings.deepCopy().set("migration", migration)));
        Files.writeString(island.resolve("migrants.jsonl"), "{\"generation\":1,\"migrants\":[]}\n");
        forget();
    }

    @ParameterizedTest
    @ValueSource(strings = {"show", "resume", "evolve --resume", "check", "converge", "compare other", "view --no-browser --run",
        "page"})
    void commandsRefuseThemInOneLine(String command) throws IOException {
        assertThat(evolve("other")).as(err.toString()).isZero();
        for (Path refused : List.of(run, island)) {
            forget();
            List<String> all = new ArrayList<>(List.of(command.replace(" other", " " + folder.resolve("other")).split(" ")));
            all.add(refused.toString());

            assertThat(Main.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true))
                    .execute(all.toArray(String[]::new))).as(err.toString()).isEqualTo(2);

            assertThat(err.toString()).isEqualTo("natator " + all.get(0) + ": " + refused + " was evolved on islands by an earlier version, "
                    + "which this one cannot read; expected the folder of a run by itself\n");
        }
    }

    /** Of these nothing went from one to another. */
    @Test
    void anIslandThatExchangedNothingIsARunLikeAnyOther() throws IOException {
        ObjectNode settings = Json.read(island.resolve("config.json"), ObjectNode.class, "settings");
        settings.remove("migration");
        Files.writeString(island.resolve("config.json"), Json.document(settings));

        assertThat(natator("show", island.toString())).as(err.toString()).isZero();
        assertThat(natator("resume", island.toString(), "--generations", "4")).as(err.toString()).isZero();
    }

    @Test
    void aBestGaitOfOneCanBeEvaluated() {
        assertThat(natator("evaluate", "--scene", "pool/creature-1", "--gait", island.resolve("best.json").toString())).as(err.toString()).isZero();
        assertThat(out.toString()).contains("\"distance\"");
        assertThat(err.toString()).isEmpty();
    }
}
