package io.natator.cli;

import java.lang.reflect.Field;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.stream.Collectors;
import picocli.CommandLine;
import picocli.CommandLine.Help;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Model.UsageMessageSpec;

/** Lists the options of a command's help under the headings of {@link Section}, in the order of the names under each. */
final class SectionedHelp {

    private SectionedHelp() {
    }

    /** For a command and all below it; where there are headings, the synopsis does not name every option as well. */
    static void install(CommandLine command) {
        boolean sectioned = command.getCommandSpec().options().stream().map(SectionedHelp::topic).distinct()
                .count() > 1;
        command.getCommandSpec().usageMessage().abbreviateSynopsis(sectioned);
        command.getHelpSectionMap().put(UsageMessageSpec.SECTION_KEY_OPTION_LIST, SectionedHelp::options);
        command.getSubcommands().values().forEach(SectionedHelp::install);
    }

    private static String options(Help help) {
        Map<Section.Topic, List<OptionSpec>> topics = help.commandSpec().options().stream()
                .filter(option -> !option.hidden()).collect(Collectors.groupingBy(SectionedHelp::topic,
                        () -> new EnumMap<>(Section.Topic.class), Collectors.toList()));
        if (topics.size() < 2) {
            return help.optionList();
        }
        StringBuilder text = new StringBuilder();
        topics.forEach((topic, options) -> text.append(System.lineSeparator()).append(topic.heading()).append(':')
                .append(System.lineSeparator()).append(list(help, options)));
        return text.toString();
    }

    private static String list(Help help, List<OptionSpec> options) {
        Map<String, OptionSpec> sorted = new TreeMap<>(
                options.stream().collect(Collectors.toMap(OptionSpec::longestName, option -> option)));
        Help.Layout layout = help.createDefaultLayout();
        layout.addAllOptions(List.copyOf(sorted.values()), help.createDefaultParamLabelRenderer());
        return layout.toString();
    }

    /** The heading of an option: its field's, else that of the class that declares it. */
    static Section.Topic topic(OptionSpec option) {
        if (!(option.userObject() instanceof Field field)) {
            return Section.Topic.OTHER;
        }
        Section own = field.getAnnotation(Section.class);
        Section shared = own != null ? own : field.getDeclaringClass().getAnnotation(Section.class);
        return shared == null ? Section.Topic.OTHER : shared.value();
    }
}
