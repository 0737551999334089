// globular generate: writes the man page or the bash completion, made from the definitions of the commands, so that
// both are complete and current. The build runs it; it is hidden from users.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/commands/commands.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

/// The subcommands of a command that are not hidden, in the order in which they were added.
std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// The flags of a command, or its positional arguments, that are not hidden.
std::vector<const CLI::Option*> optionsOf(const CLI::App& app, bool arePositional) {
    return app.get_options([=](const CLI::Option* option) {
        return !option->get_group().empty() && option->get_positional() == arePositional;
    });
}

bool hasValue(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

/// The placeholder for the value of a flag, such as "DIR". In CLI11's name of the type, a colon and the accepted values
/// may follow it.
std::string placeholderOf(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

/// The values that a flag accepts, if they are a list of names.
std::string choicesOf(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t open = type.find('{');
    if (open == std::string::npos) return {};
    std::string choices = type.substr(open + 1, type.find('}') - open - 1);
    std::replace(choices.begin(), choices.end(), ',', ' ');
    return choices;
}

/// Every spelling of a flag, such as "-o" and "--output".
std::vector<std::string> spellingsOf(const CLI::Option& option) {
    std::vector<std::string> spellings;
    for (const std::string& name : option.get_snames()) spellings.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) spellings.push_back("--" + name);
    return spellings;
}

/// The text with every character that roff would interpret escaped.
std::string roff(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        const bool startsLine = escaped.empty() || escaped.back() == '\n';
        if (startsLine && (c == '.' || c == '\'')) escaped += "\\&";
        escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return escaped;
}

/// An argument in a usage line: "SCENE" if it is required, "[FIGURE...]" if it is optional and may be repeated.
std::string usageOf(const CLI::Option& argument) {
    const std::string name = argument.get_name(true) + (argument.get_items_expected_max() > 1 ? "..." : std::string{});
    return argument.get_required() ? name : "[" + name + "]";
}

/// The man page's section on one command, followed by the sections on its subcommands.
/// @param path  the words that call the command, without "globular"
std::string manSection(const CLI::App& app, const std::string& path) {
    std::string text = fmt::format(".SS {}\n", roff(path));
    std::string usage;
    for (const CLI::Option* argument : optionsOf(app, true)) usage += " \\fI" + roff(usageOf(*argument)) + "\\fR";
    const bool hasCommands = !commandsOf(app).empty();
    text += fmt::format("\\fBglobular {}\\fR {}\n.PP\n{}.\n", roff(path),
                        hasCommands ? "\\fICOMMAND\\fR" : "[\\fIOPTIONS\\fR]" + usage, roff(app.get_description()));
    for (const CLI::Option* argument : optionsOf(app, true))
        text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(argument->get_name(true)), roff(argument->get_description()));
    for (const CLI::Option* flag : optionsOf(app, false)) {
        if (flag == app.get_help_ptr()) continue;  // --help, which every command has
        text += fmt::format(".TP\n\\fB{}\\fR", roff(fmt::format("{}", fmt::join(spellingsOf(*flag), ", "))));
        if (hasValue(*flag)) text += fmt::format(" \\fI{}\\fR", roff(placeholderOf(*flag)));
        text += "\n" + roff(flag->get_description()) + "\n";
    }
    if (const std::string footer = app.get_footer(); !footer.empty())
        text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(footer));
    for (const CLI::App* command : commandsOf(app)) text += manSection(*command, path + " " + command->get_name());
    return text;
}

constexpr std::string_view kManEnd = R"(.SH SCENES
A scene is a TOML file. \fBglobular schema\fR lists every key, \fBglobular scenes\fR the built-in scenes. A
\fISCENE\fR is the path of a file, \- for standard input, or the name of a built-in scene.
.SH EXIT STATUS
.TP
0
The command is done.
.TP
1
A file, a program or OpenGL failed, or a study found a limit that was not kept.
.TP
2
The scene or the command line is wrong.
.TP
3
The simulation became unstable.
.TP
128 + \fIN\fR
Signal \fIN\fR ended the run; a run that was interrupted goes on with \fB\-\-resume\fR.
.PP
\fBglobular compare\fR ends with 0 if all pictures are within the limits, 1 if one is not, and 2 on any trouble.
.SH SEE ALSO
.BR ffmpeg (1),
.BR gnuplot (1)
)";

/// The branches of the case statements in the bash completion script.
struct CompletionCases {
    std::string commands;  ///< case branches of the script that recognize subcommands
    std::string words;     ///< case branches that list the words that may follow a command
    std::string values;    ///< case branches that list the values that a flag accepts
};

/// Adds the branches of the completion script for a command and its subcommands.
/// @param path  the words that call the command, each with a space before it, without "globular"
void addCases(const CLI::App& app, const std::string& path, CompletionCases& cases) {
    std::vector<std::string> words;
    for (const CLI::Option* flag : optionsOf(app, false))
        for (const std::string& spelling : spellingsOf(*flag)) {
            words.push_back(spelling);
            if (hasValue(*flag))
                cases.values += fmt::format("        \"{} {}\") values=\"{}\" ;;\n", path, spelling, choicesOf(*flag));
        }
    for (const CLI::App* command : commandsOf(app)) {
        const std::string subpath = path + " " + command->get_name();
        words.push_back(command->get_name());
        cases.commands += fmt::format("            \"{}\") path=\"{}\" ;;\n", subpath, subpath);
        addCases(*command, subpath, cases);
    }
    bool takesScene = false;
    for (const CLI::Option* argument : optionsOf(app, true))
        takesScene = takesScene || argument->get_name(true) == "SCENE";
    cases.words += fmt::format("        \"{}\") words=\"{}\"{} ;;\n", path, fmt::join(words, " "),
                               takesScene ? "; takesScene=yes" : "");
}

/// The bash completion script. It reads the words before the cursor from left to right to find the command. Without a
/// match, -o default lets bash complete file names.
constexpr const char* kCompletion = R"bash(# bash completion for globular, generated by its build.
_globular() {{
    local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} path="" words="" values=none takesScene="" i
    for ((i = 1; i < COMP_CWORD; i++)); do
        case "$path ${{COMP_WORDS[i]}}" in
{}        esac
    done
    COMPREPLY=()
    case "$path $prev" in
{}    esac
    if [ "$values" != none ]; then
        [ -z "$values" ] || COMPREPLY=($(compgen -W "$values" -- "$cur"))
        return
    fi
    case "$path" in
{}    esac
    if [ -n "$takesScene" ] && [[ $cur != -* ]]; then
        COMPREPLY=($(compgen -W "$("${{COMP_WORDS[0]}}" scenes 2>/dev/null | cut -d ' ' -f 1)" -- "$cur"))
        COMPREPLY+=($(compgen -f -X '!*.toml' -- "$cur"))
    elif [ -n "$words" ]; then
        COMPREPLY=($(compgen -W "$words" -- "$cur"))
    fi
}}
complete -o default -F _globular globular
)bash";

/// The man page of the program, in roff's man macros.
std::string manPage(const CLI::App& program) {
    std::string text = fmt::format(".TH GLOBULAR 1 \"\" \"globular " GLOBULAR_VERSION
                                   "\" \"User Commands\"\n.SH NAME\nglobular \\- {}\n.SH SYNOPSIS\n\\fBglobular\\fR "
                                   "\\fICOMMAND\\fR [\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n.br\n",
                                   roff(program.get_description()));
    for (const CLI::Option* flag : optionsOf(program, false))
        text += fmt::format("\\fBglobular\\fR \\fB{}\\fR\n.br\n", roff("--" + flag->get_lnames().front()));
    text += ".SH COMMANDS\n";
    for (const CLI::App* command : commandsOf(program)) text += manSection(*command, command->get_name());
    return text + std::string(kManEnd);
}

/// A script for bash that completes commands, flags, their values and scenes.
std::string bashCompletion(const CLI::App& program) {
    CompletionCases cases;
    addCases(program, "", cases);
    return fmt::format(kCompletion, cases.commands, cases.values, cases.words);
}

}  // namespace

void addGenerateCommand(CLI::App& program) {
    struct Options {
        std::string kind;
        std::string output;
    };
    CLI::App& command = *program.add_subcommand("generate", "write the man page or the bash completion");
    command.group("");
    const auto options = std::make_shared<Options>();
    command.add_option("KIND", options->kind, "man or completion")
        ->required()
        ->check(CLI::IsMember({"man", "completion"}));
    command.add_option("FILE", options->output, "the file to write")->required();
    command.callback([options, &program] {
        requireSeparate({{}, {{"FILE", options->output}}, {}});
        writeFile(options->output, options->kind == "man" ? manPage(program) : bashCompletion(program));
    });
}

}  // namespace tools
