package io.natator.spark;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.apache.spark.launcher.JavaModuleOptions;
import io.natator.process.Processes;

/** A standalone cluster of Spark on the loopback interface: a master and workers, each a process, as its scripts start them. */
final class TestCluster implements AutoCloseable {

    private static final Path HOME = Path.of(System.getProperty("natator.sparkHome")).toAbsolutePath().normalize();
    private static final Path JAR = Path.of(System.getProperty("natator.jar")).toAbsolutePath().normalize();
    private static final Pattern MASTER = Pattern.compile("Starting Spark master at (spark://\\S+)");

    private final Path folder;
    private final String master;
    private final List<Process> processes = new ArrayList<>();
    private final List<Process> workers = new ArrayList<>();

    /** Starts a master. */
    TestCluster(Path folder) throws IOException, InterruptedException {
        this.folder = folder;
        Path log = folder.resolve("master.log");
        processes.add(start(log, Map.of(), List.of(), "org.apache.spark.deploy.master.Master", "--host", "127.0.0.1",
                "--port", "0",
                "--webui-port", "0"));
        Processes.await("master", () -> MASTER.matcher(Files.readString(log)).find());
        Matcher url = MASTER.matcher(Files.readString(log));
        assertThat(url.find()).isTrue();
        master = url.group(1);
    }

    /** What the drivers that use it need to know. */
    String master() {
        return master;
    }

    /**
     * Adds a worker with one core, at a loopback address of its own: to Spark a machine by itself.
     *
     * @param environment in addition to this program's
     * @param options     of the virtual machine
     * @param before      commands of bash before it is started
     */
    Process addWorker(Map<String, String> environment, List<String> options, String before)
            throws IOException, InterruptedException {
        String name = "worker-" + workers.size();
        String host = "127.0.0." + (2 + workers.size());
        Path log = folder.resolve(name + ".log");
        List<String> command = new ArrayList<>(List.of("bash", "-c", before + " exec \"$@\"", name));
        command.addAll(java(options, "org.apache.spark.deploy.worker.Worker", "--host", host, "--port", "0",
                "--webui-port",
                "0", "--cores", "1", "--memory", "600m", "--work-dir", folder.resolve(name).toString(), master));
        Map<String, String> all = new HashMap<>(environment);
        all.put("SPARK_LOCAL_IP", host);
        Process worker = run(log, all, command);
        processes.add(worker);
        workers.add(worker);
        Processes.await(name, () -> Files.readString(log).contains("Successfully registered with master"));
        return worker;
    }

    /** The virtual machines that work for applications now. */
    List<ProcessHandle> executors() {
        return workers.stream().flatMap(worker -> worker.toHandle().children()).toList();
    }

    /** Starts the program by spark-submit; its output goes to the log. */
    Process submit(Path log, List<String> configuration, String... arguments) throws IOException {
        List<String> all = new ArrayList<>(List.of("--master", master));
        for (String each : List.of("spark.ui.enabled=false", "spark.executor.memory=480m",
                "spark.driver.host=127.0.0.1",
                "spark.executor.extraJavaOptions=-XX:TieredStopAtLevel=1 -XX:+UseSerialGC -Xss512k")) {
            all.addAll(List.of("--conf", each));
        }
        for (String each : configuration) {
            all.addAll(List.of("--conf", each));
        }
        all.add(JAR.toString());
        all.addAll(List.of(arguments));
        return start(log, Map.of(), List.of(), "org.apache.spark.deploy.SparkSubmit", all.toArray(String[]::new));
    }

    private static Process start(Path log, Map<String, String> environment, List<String> options, String type,
            String... arguments) throws IOException {
        return run(log, environment, java(options, type, arguments));
    }

    private static List<String> java(List<String> options, String type, String... arguments) {
        List<String> command = new ArrayList<>(
                List.of(Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                        "-XX:TieredStopAtLevel=1", "-XX:+UseSerialGC", "-Xmx512m", "-cp", HOME.resolve("jars") + "/*"));
        command.addAll(List.of(JavaModuleOptions.defaultModuleOptions().trim().split("\\s+")));
        command.addAll(options);
        command.add(type);
        command.addAll(List.of(arguments));
        return command;
    }

    private static Process run(Path log, Map<String, String> environment, List<String> command) throws IOException {
        ProcessBuilder builder = new ProcessBuilder(command).redirectErrorStream(true).redirectOutput(log.toFile());
        builder.environment().put("SPARK_HOME", HOME.toString());
        builder.environment().put("SPARK_SCALA_VERSION", "2.13");
        builder.environment().put("SPARK_LOCAL_IP", "127.0.0.1");
        builder.environment().putAll(environment);
        return builder.start();
    }

    @Override
    public void close() {
        for (Process process : processes) {
            List<ProcessHandle> below = process.descendants().toList();
            process.destroyForcibly();
            below.forEach(ProcessHandle::destroyForcibly);
        }
    }
}
