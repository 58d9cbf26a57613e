package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import io.natator.file.ShellWord;
import io.natator.process.ProgramInfo;
import io.natator.process.SceneInfo;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/** Makes files to begin with that the simulator takes as they are. */
final class StartingFiles {

    private static final String LIKE = "--like";
    private static final String POOL = "pool/water";
    private static final String SWIMMER = "pool/eel";
    private static final String BODY = """
            {
              "profile": {
                "length": 1.4,
                "height": [[0, 0.18], [0.25, 0.34], [0.75, 0.22], [1, 0.3]],
                "width": [[0, 0.16], [0.2, 0.2], [0.5, 0.18], [1, 0.14]],
                "joints": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
              },
              "spacing": 0.075,
              "particleMass": 0.421875,
              "clusterStiffness": 0.6,
              "springStiffness": 0.4,
              "rearCentre": [0.35, 0.5, 0.5]
            }
            """;

    private final Path simulator;
    private final ProgramInfo program;

    /**
     * A file to begin with.
     *
     * @param content what it holds
     * @param next    commands to try with it
     */
    record StartingFile(ObjectNode content, List<String> next) {
    }

    /** Water, and where in it a body's rear end is put. */
    private record Place(String water, JsonNode rearCentre) {
    }

    StartingFiles(Path simulator) throws InterruptedException {
        this.simulator = simulator;
        this.program = ProgramInfo.of(simulator);
    }

    /**
     * A fish of curves in the small pool; or what is most often changed in another scene with a creature, as it is there.
     *
     * @param like a scene, or null
     * @param file where it will be
     */
    StartingFile scene(String name, String like, Path file) throws InterruptedException {
        ObjectNode scene = document("scene");
        if (like == null) {
            scene.put("description", name + ": a fish in the pool. The body follows curves [part of the length, value] "
                    + "of height and width, muscles run from joint to joint.").put("base", POOL).put("duration", 4);
            scene.set("creature", parsed(BODY));
        } else {
            scene.put("description", name + ": " + like + " with changes.").put("base", SceneOptions.scene(LIKE, like));
            JsonNode there = definition(like);
            copy(there, scene, "duration");
            copy(there.path("solver"), scene.putObject("solver"), "gravity",
                    "flex".equals(there.path("scheme").asText("flex")) ? "viscosity" : "kinematicViscosity");
            copy(bodyOf(like), scene.putObject("creature"), "rearCentre", "clusterStiffness", "springStiffness");
        }
        String gait = file.resolveSibling(name + "-gait") + ".json";
        String view = Main.asCalled() + " view --scene " + ShellWord.of(file);
        ObjectNode creature = JsonNodeFactory.instance.objectNode().set("creature", scene.get("creature"));
        return new StartingFile(scene, SceneInfo.of(scene.get("base").asText(), creature, simulator).actuators() == 0
                ? List.of("natator-sim info " + ShellWord.of(file), view)
                : List.of(
                        Main.asCalled() + " new gait " + name + "-gait --like " + ShellWord.of(file)
                                + output(name, gait),
                        view + " --gait " + ShellWord.of(gait)));
    }

    /**
     * A fish of curves; or the creature of a scene, as all that it builds on makes it.
     *
     * @param like a scene, or null
     * @param file where it will be
     * @throws InvalidInputException if the scene has none, or none of the bundled waters takes it
     */
    StartingFile creature(String name, String like, Path file) throws InterruptedException {
        ObjectNode creature = document("creature");
        creature.put("description", name + (like == null ? ": a fish" : ": that of " + like)
                + ", of which this file may change everything. Neutrally buoyant where a particle weighs what its water does.");
        ObjectNode body = like == null ? parsed(BODY) : bodyOf(like);
        body.remove(List.of("name", "description"));
        creature.setAll(body);
        Place place = placeOf(body, like);
        creature.set("rearCentre", place.rearCentre());
        ObjectNode overrides = JsonNodeFactory.instance.objectNode();
        overrides.putObject("creature").put("name", file.toString());
        String put = place.water() + " --overrides " + ShellWord.of(Json.line(overrides));
        String gait = file.resolveSibling(name + "-gait") + ".json";
        return new StartingFile(creature, List.of(
                "natator-sim info " + put + " --gait-template > " + ShellWord.of(gait),
                Main.asCalled() + " view --scene " + put + " --gait " + ShellWord.of(gait)));
    }

    /**
     * A wave for the muscles of a scene.
     *
     * @param like a scene, or null
     * @param file where it will be
     * @throws InvalidInputException if the scene has no muscles
     */
    StartingFile gait(String like, Path file) throws InterruptedException {
        ObjectNode gait = document("gait");
        String scene = like == null ? SWIMMER : like;
        gait.setAll(parsed(SceneInfo.gaitTemplate(SceneOptions.scene(LIKE, scene), simulator)));
        return new StartingFile(gait, List.of(
                "natator-sim run " + ShellWord.of(scene) + " --gait " + ShellWord.of(file) + " --duration 2",
                Main.asCalled() + " view --scene " + ShellWord.of(scene) + " --gait " + ShellWord.of(file)));
    }

    /** With what an editor finds its schema by. */
    private ObjectNode document(String kind) {
        ObjectNode document = JsonNodeFactory.instance.objectNode();
        return program.schemas() == null ? document
                : document.put("$schema", Path.of(program.schemas(), kind + ".schema.json").toUri().toString());
    }

    private ObjectNode definition(String scene) throws InterruptedException {
        return parsed(SceneInfo.definition(SceneOptions.scene(LIKE, scene), null, simulator));
    }

    private ObjectNode bodyOf(String scene) throws InterruptedException {
        if (!(definition(scene).get("creature") instanceof ObjectNode creature)) {
            throw new InvalidInputException(
                    LIKE + " is " + scene + ", which has no creature; expected a scene with one");
        }
        if (creature.get("mesh") instanceof ObjectNode mesh) {
            mesh.remove("digest");
            mesh.put("file", meshOf(mesh.path("file").asText()).toString());
        }
        return creature;
    }

    /** Where a scene's mesh is, since a creature's file has its own beside itself: among the bundled creatures, else as named. */
    private Path meshOf(String file) {
        Path bundled = program.schemas() == null || file.contains("/") ? Path.of(file)
                : Path.of(program.schemas()).resolveSibling("creatures").resolve(file);
        return (Files.exists(bundled) ? bundled : Path.of(file)).toAbsolutePath().normalize();
    }

    /** Water that takes the body: that of the scene it is from, or one of the bundled. */
    private Place placeOf(ObjectNode body, String like) throws InterruptedException {
        List<Place> places = new ArrayList<>();
        if (like != null && body.has("rearCentre")) {
            String folder = like.replaceFirst("[^/]*$", "");
            program.scenes().stream().filter(List.of(folder + "water", folder + "tank")::contains)
                    .forEach(water -> places.add(new Place(water, body.get("rearCentre"))));
        }
        places.add(new Place(POOL, parsed(BODY).get("rearCentre")));
        places.add(new Place("open-water/water", JsonNodeFactory.instance.arrayNode().add(1.0).add(0.8).add(0.8)));
        return firstThatTakes(body, places);
    }

    private Place firstThatTakes(ObjectNode body, List<Place> places) throws InterruptedException {
        InvalidInputException refusal = null;
        for (Place place : places) {
            ObjectNode patch = JsonNodeFactory.instance.objectNode();
            ObjectNode placed = body.deepCopy();
            placed.set("rearCentre", place.rearCentre());
            patch.set("creature", placed);
            try {
                SceneInfo.of(place.water(), patch, simulator);
                return place;
            } catch (InvalidInputException e) {
                refusal = e;
            }
        }
        throw refusal;
    }

    private static void copy(JsonNode from, ObjectNode to, String... keys) {
        for (String key : keys) {
            if (from.has(key)) {
                to.set(key, from.get(key));
            }
        }
    }

    private static ObjectNode parsed(String text) {
        try {
            return Json.parse(text, ObjectNode.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator: " + Json.reason(e), e);
        }
    }

    /** Where a file is not where its name alone would put it. */
    private static String output(String name, String file) {
        return file.equals(name + "-gait.json") ? "" : " --output " + ShellWord.of(file);
    }
}
