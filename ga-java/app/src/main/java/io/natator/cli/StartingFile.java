package io.natator.cli;

import com.fasterxml.jackson.databind.node.ObjectNode;
import java.util.List;

/**
 * A file to begin with.
 *
 * @param content what it holds
 * @param next    commands to try with it
 */
record StartingFile(ObjectNode content, List<String> next) {
}
