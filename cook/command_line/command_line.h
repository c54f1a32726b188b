// Command lines of programs: options bound to variables, subcommands, help and errors. Wraps CLI11, whose
// header takes seven seconds to compile.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace hearth::cli
{

/// Refers to an option of a CommandLine, as long as that lives. Copies refer to the same option.
class Option
{
public:
    Option& required();
    /// Show `name` in help for the value, as "FILE". Completion offers the words of "text|json".
    Option& typeName(const std::string& name);
    /// Accept these words, or numbers, only. Help shows `type_name`, or where that is empty all of them.
    Option& choices(const std::vector<std::string>& words, const std::string& type_name = "");
    Option& choices(std::span<const uint32_t> numbers, const std::string& type_name = "");
    /// Accept numbers from `min` to `max` only. Help shows `type_name`, or where that is empty the range.
    Option& range(int min, int max, const std::string& type_name = "");
    Option& range(uint32_t min, uint32_t max, const std::string& type_name = "");
    Option& range(uint64_t min, uint64_t max, const std::string& type_name = "");
    Option& range(double min, double max, const std::string& type_name = "");
    /// Accept numbers above 0 only.
    Option& positive(const std::string& type_name = "");
    /// Refuse values for which `fault` returns what is wrong with them; it returns "" for all others.
    Option& check(const std::function<std::string(const std::string& value)>& fault);
    /// Refuse this option without `other`, or beside it.
    Option& needs(const Option& other);
    Option& excludes(const Option& other);
    /// Take one value for each time that the option is given. Else a list takes all that follow.
    Option& oneValueEach();
    /// Take exactly `count` values.
    Option& expected(int count);
    /// Split values at `separator`, too: "1,2,3" are three.
    Option& delimiter(char separator);
    /// Show in help what the variable holds now.
    Option& showDefault();

    /// returns  how many values the command line has given, of a flag how often; 0: the option is not there
    size_t count() const;

private:
    friend class CommandLine;
    explicit Option(CLI::Option& option) : option_(&option) {}

    CLI::Option* option_;
};

/// The end of CommandLine::parseWords.
struct ParseResult
{
    bool wants_help = false; ///< -h or --help was given: print help() and end
    std::string fault;       ///< what is wrong; empty: nothing
};

/// The options of a program, or of one of its subcommands. Variables that options are bound to must live until
/// the command line is parsed; an option that is not given leaves its variable as it is. `names` are
/// "-o,--output", or one word without dashes, as "SOURCE", for an argument that is given by its position.
class CommandLine
{
public:
    /// name  of the program, for help; empty: as it was started
    explicit CommandLine(const std::string& description, const std::string& name = "");
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Add an option with a value.
    Option addOption(const std::string& names, std::string& value, const std::string& description);
    Option addOption(const std::string& names, int& value, const std::string& description);
    Option addOption(const std::string& names, uint32_t& value, const std::string& description);
    Option addOption(const std::string& names, uint64_t& value, const std::string& description);
    Option addOption(const std::string& names, float& value, const std::string& description);
    Option addOption(const std::string& names, double& value, const std::string& description);
    Option addOption(const std::string& names, std::optional<uint32_t>& value,
                     const std::string& description);
    /// Add an option with values, one at least.
    Option addOption(const std::string& names, std::vector<std::string>& values,
                     const std::string& description);
    Option addOption(const std::string& names, std::vector<float>& values, const std::string& description);
    Option addOption(const std::string& names, std::vector<double>& values, const std::string& description);
    /// Add an option that appends its values as one list for each time that it is given.
    Option addOption(const std::string& names, std::vector<std::vector<double>>& lists,
                     const std::string& description);

    /// Add an option whose words stand for values of an enumeration.
    template <typename Enum>
    Option addChoice(const std::string& names, Enum& value, const std::map<std::string, Enum>& words,
                     const std::string& description);

    /// Add an option without a value.
    Option addFlag(const std::string& names, bool& is_given, const std::string& description);
    Option addFlag(const std::string& names, const std::string& description);
    /// Add an option that may have a value, as "--fatal=W1"; with the names "--fatal{all}" the value is "all"
    /// where none is given.
    Option addFlag(const std::string& names, std::string& value, const std::string& description);

    /// The subcommand lives as long as this.
    CommandLine& addSubcommand(const std::string& name, const std::string& description);
    /// Make it an error to name no subcommand.
    void requireSubcommand();
    /// Let the options of this stand after the names of its subcommands, too: of those that there are by now.
    void shareOptions();

    /// Set the text below all options in help: examples and exit codes.
    void setFooter(const std::string& text);
    /// Refuse command lines for which `fault`, called when all options have their values, returns what is
    /// wrong; it returns "" for all others.
    void setCheck(std::function<std::string()> fault);
    /// Call `action` at the end of parsing, of a subcommand where it is the one that was named.
    void setAction(std::function<void()> action);

    /// Parse the arguments of main(). Help goes to stdout, errors go to stderr.
    /// returns  the exit code, where the program must end: 0 after help, 2 after an error
    [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv);
    /// Parse words, without the name of the program, and print nothing.
    [[nodiscard]] ParseResult parseWords(std::vector<std::string> words);

    /// The help of the subcommand that was named, or of the whole.
    std::string help() const;
    /// Whether a subcommand was named.
    bool hasSubcommand() const;

    CommandInfo info() const;

private:
    explicit CommandLine(std::shared_ptr<CLI::App> app);
    template <typename T>
    Option bind(const std::string& names, T& variable, const std::string& description);
    Option addNumberedChoice(const std::string& names, const std::map<std::string, int>& words,
                             std::function<void(int)> store, const std::string& description);
    void finish() const;

    std::shared_ptr<CLI::App> app_;
    std::vector<std::unique_ptr<CommandLine>> subcommands_;
    std::function<std::string()> fault_;
    std::function<void()> action_;
};

template <typename Enum>
Option CommandLine::addChoice(const std::string& names, Enum& value, const std::map<std::string, Enum>& words,
                              const std::string& description)
{
    std::map<std::string, int> numbers;
    for (const auto& [word, meaning] : words)
        numbers.emplace(word, static_cast<int>(meaning));
    return addNumberedChoice(
        names, numbers, [&value](int number) { value = static_cast<Enum>(number); }, description);
}

} // namespace hearth::cli
