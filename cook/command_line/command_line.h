// Parses command lines: options bound to variables, subcommands, help and errors. Wraps CLI11, whose header
// takes seven seconds to compile.
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

/// Reference to an option of a CommandLine, valid as long as the CommandLine lives. Copies refer to the same
/// option.
class Option
{
public:
    Option& required();
    /// Show `name`, as "FILE", for the value in help. For a name as "text|json", completion offers its words.
    Option& typeName(const std::string& name);
    /// Accept only these words or numbers. Help shows `type_name`, or all choices if it is empty.
    Option& choices(const std::vector<std::string>& words, const std::string& type_name = "");
    Option& choices(std::span<const uint32_t> numbers, const std::string& type_name = "");
    /// Accept only numbers from `min` to `max`. Help shows `type_name`, or the range if it is empty.
    Option& range(int min, int max, const std::string& type_name = "");
    Option& range(uint32_t min, uint32_t max, const std::string& type_name = "");
    Option& range(uint64_t min, uint64_t max, const std::string& type_name = "");
    Option& range(double min, double max, const std::string& type_name = "");
    /// Accept only numbers above 0.
    Option& positive(const std::string& type_name = "");
    /// Refuse values for which `fault` returns a message. It returns "" for valid values.
    Option& check(const std::function<std::string(const std::string& value)>& fault);
    /// Refuse this option without `other` (needs), or together with it (excludes).
    Option& needs(const Option& other);
    Option& excludes(const Option& other);
    /// Take one value for each occurrence of the option. Without this, a list takes all values that follow.
    Option& oneValueEach();
    /// Take exactly `count` values.
    Option& expected(int count);
    /// Also split each value at `separator`: "1,2,3" gives three values.
    Option& delimiter(char separator);
    /// Show the variable's present value in help, as the default.
    Option& showDefault();

    /// returns  the number of values on the command line, for a flag of its occurrences; 0: the option is
    ///          absent
    size_t count() const;

private:
    friend class CommandLine;
    explicit Option(CLI::Option& option) : option_(&option) {}

    CLI::Option* option_;
};

/// Result of CommandLine::parseWords.
struct ParseResult
{
    bool wants_help = false; ///< -h or --help was given: print help() and exit
    std::string fault;       ///< error message; empty: no error
};

/// Options of a program, or of one of its subcommands. Variables that are bound to options must live until
/// the command line is parsed; an absent option leaves its variable unchanged. `names` are "-o,--output", or
/// one word without dashes, as "SOURCE", for a positional argument.
class CommandLine
{
public:
    /// name  program name in help; empty: as the program was started
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
    /// Add an option with one or more values.
    Option addOption(const std::string& names, std::vector<std::string>& values,
                     const std::string& description);
    Option addOption(const std::string& names, std::vector<float>& values, const std::string& description);
    Option addOption(const std::string& names, std::vector<double>& values, const std::string& description);
    /// Add an option that appends one list of values for each occurrence.
    Option addOption(const std::string& names, std::vector<std::vector<double>>& lists,
                     const std::string& description);

    /// Add an option whose words stand for values of an enumeration.
    template <typename Enum>
    Option addChoice(const std::string& names, Enum& value, const std::map<std::string, Enum>& words,
                     const std::string& description);

    /// Add an option without a value.
    Option addFlag(const std::string& names, bool& is_given, const std::string& description);
    Option addFlag(const std::string& names, const std::string& description);
    /// Add an option with an optional value, as "--fatal=W1". With the names "--fatal{all}" the value is
    /// "all" if none is given.
    Option addFlag(const std::string& names, std::string& value, const std::string& description);

    /// Add an option with an optional word, as "--bricks", "--bricks off" or "--bricks=off".
    /// bare  the value without a word
    Option addOptionalChoice(const std::string& names, std::string& value,
                             const std::vector<std::string>& words, const std::string& bare,
                             const std::string& description);

    /// Add an option with an optional number, as "--probe", "--probe 2" or "--probe=2". Without a
    /// number, or with the word `bare`, the variable is unchanged.
    Option addOptionalNumber(const std::string& names, std::optional<uint32_t>& value,
                             const std::string& bare, const std::string& description);

    /// Add a subcommand, which lives as long as this object.
    CommandLine& addSubcommand(const std::string& name, const std::string& description);
    /// Make it an error to name no subcommand.
    void requireSubcommand();
    /// Accept the options of this command after the names of its subcommands, too: of the subcommands that
    /// exist at this call.
    void shareOptions();

    /// Set the text below all options in help: examples and exit codes.
    void setFooter(const std::string& text);
    /// Refuse command lines for which `fault` returns a message. `fault` is called when all options have
    /// their values; it returns "" for a valid command line.
    void setCheck(std::function<std::string()> fault);
    /// Call `action` at the end of parsing; the action of a subcommand only if that subcommand was named.
    void setAction(std::function<void()> action);

    /// Parse the arguments of main(). Help goes to stdout, errors go to stderr.
    /// returns  the exit code if the program must end: 0 after help, 2 after an error
    [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv);
    /// Parse words that do not include the program's name, and print nothing.
    [[nodiscard]] ParseResult parseWords(std::vector<std::string> words);

    /// Return the help of the named subcommand, or of the program if none was named.
    std::string help() const;
    /// True if a subcommand was named.
    bool hasSubcommand() const;

    CommandInfo info() const;

private:
    explicit CommandLine(std::shared_ptr<CLI::App> app);
    template <typename T>
    Option bind(const std::string& names, T& variable, const std::string& description);
    void takeOptionalWord(const std::string& names, const std::function<bool(const std::string&)>& accepts);
    Option addNumberedChoice(const std::string& names, const std::map<std::string, int>& words,
                             std::function<void(int)> store, const std::string& description);
    void finish() const;
    void joinOptionalWords(std::vector<std::string>& words) const;

    std::shared_ptr<CLI::App> app_;
    std::vector<std::unique_ptr<CommandLine>> subcommands_;
    /// by the name of an option with an optional word: true if a word is the option's
    std::map<std::string, std::function<bool(const std::string&)>> accepts_word_;
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
