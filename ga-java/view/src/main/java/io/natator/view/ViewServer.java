package io.natator.view;

import com.fasterxml.jackson.databind.node.ObjectNode;
import io.javalin.Javalin;
import io.javalin.config.JavalinConfig;
import io.javalin.config.RoutesConfig;
import io.javalin.http.ContentType;
import io.javalin.http.Context;
import io.javalin.http.ForbiddenResponse;
import io.javalin.http.HttpStatus;
import io.javalin.http.NotFoundResponse;
import io.javalin.util.JavalinBindException;
import io.natator.base.InvalidInputException;
import io.natator.checkpoint.RunReader;
import io.natator.config.Json;
import io.natator.process.ProgramInfo;
import io.natator.protocol.RequestRejectedException;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetAddress;
import java.net.NetworkInterface;
import java.net.SocketException;
import java.net.URI;
import java.net.UnknownHostException;
import java.time.Duration;
import java.util.Collection;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import org.eclipse.jetty.ee10.servlet.ServletContextHandler;
import org.eclipse.jetty.ee10.websocket.server.JettyWebSocketServletFactory;
import org.eclipse.jetty.websocket.api.StatusCode;
import org.eclipse.jetty.websocket.core.server.WebSocketServerComponents;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Serves the page, its parts from this program's own jar, what it asks for, and a socket to a simulator of its own. Reads
 * no file but those of the given runs, and writes none.
 */
public final class ViewServer implements AutoCloseable {

    /** Where it listens unless told otherwise. */
    public static final int DEFAULT_PORT = 6287;
    /** How many simulations it runs at a time. */
    public static final int MAX_SIMULATIONS = StreamSockets.MAX_SESSIONS;
    private static final Logger LOG = LoggerFactory.getLogger(ViewServer.class);
    private static final int MAX_MESSAGE_BYTES = 64 << 10;
    /**
     * How long a page may take nothing: for ever. One that is stopped (in a debugger, or put to sleep by its browser) would
     * else lose its simulation, which stands still meanwhile and costs memory alone. A page that has gone closes its socket;
     * where a network swallows that, TCP gives up the pings that nobody acknowledges, after about a quarter of an hour.
     */
    private static final Duration IDLE_TIMEOUT = Duration.ZERO;
    private static final JarFiles APP = new JarFiles("io/natator/view/app");
    private static final String WEBJAR = "META-INF/resources/webjars/three/0.181.1";
    private static final JarFiles THREE = new JarFiles(WEBJAR + "/build");
    private static final JarFiles ADDONS = new JarFiles(WEBJAR + "/examples/jsm");

    private final ViewSettings settings;
    private final AllowedHosts hosts;
    private final SecurityHeaders headers;
    private final String page;
    private final String setup;
    private final StreamSockets sockets;
    private final SavedFiles saved;
    private final Javalin javalin;

    /**
     * Starts to serve.
     *
     * @throws InvalidInputException    if a folder is not that of a run
     * @throws RequestRejectedException if the simulator cannot be run
     * @throws UncheckedIOException     if it cannot listen there
     */
    public ViewServer(ViewSettings settings) throws InterruptedException {
        this.settings = settings;
        hosts = new AllowedHosts(settings.host());
        page = APP.text("index.html");
        headers = new SecurityHeaders(page);
        setup = Json.line(SetupResponse.of(ProgramInfo.of(settings.simulator()), settings));
        sockets = new StreamSockets(settings.simulator(), files(settings),
                scene -> scene.equals(settings.start().scene()) ? settings.policy() : null);
        saved = new SavedFiles(files(settings), scene -> sockets.sessions().forEach(session -> session.saved(scene)));
        javalin = Javalin.create(this::configure);
        try {
            javalin.start();
            sendUncompressed();
        } catch (JavalinBindException e) {
            close();
            checkHost(settings.host());
            throw new UncheckedIOException(unavailable(settings), new IOException(e));
        }
    }

    /** Frames hardly get smaller by compression, at the cost of a processor. */
    private void sendUncompressed() {
        ServletContextHandler context = javalin.jettyServer().server().getDescendant(ServletContextHandler.class);
        WebSocketServerComponents.getWebSocketComponents(context).getExtensionRegistry()
                .unregister("permessage-deflate");
    }

    private static void checkHost(String host) {
        try {
            InetAddress address = InetAddress.getByName(host);
            if (!address.isAnyLocalAddress() && NetworkInterface.getByInetAddress(address) == null) {
                String place = host.equals(address.getHostAddress()) ? "" : ", which is " + address.getHostAddress();
                throw new InvalidInputException(
                        "--host is " + host + place + "; expected a name or address of this machine");
            }
        } catch (UnknownHostException e) {
            throw new InvalidInputException(
                    "--host is " + host + ", an unknown name; expected a name or address of this machine",
                    e);
        } catch (SocketException e) {
            LOG.debug("network interfaces not known", e);
        }
    }

    private static String unavailable(ViewSettings settings) {
        return "cannot listen at port " + settings.port() + " of " + settings.host()
                + "; choose another by --port, or any that is free by --port 0";
    }

    /** Scenes and creatures that are files: those that the user named, also by way of a run. */
    private static Set<String> files(ViewSettings settings) {
        Set<String> files = new HashSet<>();
        addFiles(files, settings.start().scene(), settings.start().overrides());
        settings.runs().stream().map(RunReader::settings)
                .forEach(run -> addFiles(files, run.problem().scene(), RunResponse.overrides(run)));
        return files;
    }

    private static void addFiles(Set<String> files, String scene, ObjectNode overrides) {
        files.add(scene);
        if (overrides != null) {
            files.add(overrides.path("creature").path("name").asText());
        }
    }

    private void configure(JavalinConfig config) {
        config.startup.showJavalinBanner = false;
        config.startup.showOldJavalinVersionWarning = false;
        config.jetty.host = settings.host();
        config.jetty.port = settings.port();
        config.jetty.modifyWebSocketServletFactory(ViewServer::limit);
        config.router.javaLangErrorHandler((response, e) -> {
            LOG.error("internal error: {}", e, e);
            response.setStatus(HttpStatus.INTERNAL_SERVER_ERROR.getCode());
        });
        route(config.routes);
    }

    private static void limit(JettyWebSocketServletFactory factory) {
        factory.setMaxTextMessageSize(MAX_MESSAGE_BYTES);
        factory.setMaxBinaryMessageSize(MAX_MESSAGE_BYTES);
        factory.setMaxFrameSize(MAX_MESSAGE_BYTES);
        factory.setIdleTimeout(IDLE_TIMEOUT);
    }

    private void route(RoutesConfig routes) {
        routes.before(this::guard);
        routes.wsBeforeUpgrade(this::guardSocket);
        routes.get("/", answer -> answer.contentType("text/html;charset=utf-8").result(page));
        routes.get("/app/<name>", APP::answer);
        routes.get("/three/addons/<name>", ADDONS::answer);
        routes.get("/three/<name>", THREE::answer);
        routes.get("/api/setup", answer -> json(answer, setup));
        routes.get("/api/runs/{id}", answer -> json(answer, Json.line(run(answer.pathParam("id")))));
        routes.ws("/stream", sockets::handle);
        routes.exception(InvalidInputException.class, (e, answer) -> fail(answer, e.getMessage()));
        routes.exception(Exception.class, (e, answer) -> {
            LOG.error("{}: {}", answer.path(), e, e);
            fail(answer, "internal error");
        });
        routes.wsException(Exception.class, (e, socket) -> {
            LOG.error("socket: {}", e, e);
            socket.closeSession(StatusCode.SERVER_ERROR, "internal error");
        });
    }

    private static void fail(Context answer, String message) {
        answer.status(HttpStatus.INTERNAL_SERVER_ERROR);
        json(answer, Json.line(Map.of("error", message)));
    }

    private static void json(Context answer, String content) {
        answer.contentType(ContentType.APPLICATION_JSON).result(content);
    }

    private void guard(Context request) {
        if (!hosts.contains(request.header("Host"))) {
            throw new ForbiddenResponse("this server has another name");
        }
        headers.set(request);
    }

    private void guardSocket(Context request) {
        if (!hosts.isOwnPage(request.header("Origin"), request.header("Host"))) {
            throw new ForbiddenResponse("only pages of this server may open a socket");
        }
    }

    private RunResponse run(String id) {
        int number;
        try {
            number = Integer.parseInt(id);
        } catch (NumberFormatException e) {
            number = -1;
        }
        if (number < 0 || number >= settings.runs().size()) {
            throw new NotFoundResponse("no such run");
        }
        return RunResponse.of(number, RunReader.in(settings.runs().get(number)));
    }

    /** Whether machines other than this one can reach it. */
    public boolean isOpenToOthers() {
        try {
            return !InetAddress.getByName(settings.host()).isLoopbackAddress();
        } catch (UnknownHostException e) {
            return true;
        }
    }

    /** The pages that watch, for tests. */
    Collection<StreamSession> sessions() {
        return sockets.sessions();
    }

    /** What to open in the browser. */
    public URI address() {
        String host = settings.host();
        try {
            InetAddress address = InetAddress.getByName(host);
            if (address.isAnyLocalAddress()) {
                host = InetAddress.getLocalHost().getHostName();
            } else if (host.contains(":")) {
                host = "[" + host + "]";
            }
        } catch (UnknownHostException e) {
            // It was found a moment ago: the name is good enough.
        }
        return URI.create("http://" + host + ":" + javalin.port() + "/");
    }

    /** Ends the simulators and stops listening. */
    @Override
    public void close() {
        saved.close();
        sockets.close();
        javalin.stop();
    }
}
