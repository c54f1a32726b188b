// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"

#include "formats/base/text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

namespace hearth::cli
{

namespace
{

/// Exit code of a program for every error of its command line.
constexpr int kUsage = 2;

/// Add a check. Help shows `type_name` instead of the check's description, unless `type_name` is empty.
void addCheck(CLI::Option& option, CLI::Validator check, const std::string& type_name)
{
    if (!type_name.empty())
    {
        check.description("");
        option.type_name(type_name);
    }
    option.check(std::move(check));
}

/// Refuse NaN, which compares as neither below nor above the ends of a range.
void refuseNan(CLI::Option& option)
{
    option.check(
        [](const std::string& value)
        {
            double number = 0;
            const bool is_nan = CLI::detail::lexical_cast(value, number) && std::isnan(number);
            return is_nan ? "Value " + value + " not in range: it is not a number" : std::string();
        });
}

std::vector<std::string> optionNames(const CLI::Option& option)
{
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    if (names.empty())
        names.push_back(option.get_name(true));
    return names;
}

/// Return the words of "TEXT:{text,json}" (as Option::choices shows them) or of "draft|default|high" (as
/// given to Option::typeName).
std::vector<std::string> parseChoices(const std::string& type)
{
    if (const size_t open = type.find('{'); open != std::string::npos)
        return splitText(type.substr(open + 1, type.find('}') - open - 1), ',');
    return type.find('|') != std::string::npos ? splitText(type, '|') : std::vector<std::string>();
}

OptionInfo makeOptionInfo(const CLI::Option& option)
{
    OptionInfo info;
    info.names = optionNames(option);
    info.description = option.get_description();
    info.is_required = option.get_required();
    info.may_repeat = option.get_items_expected_max() > 1 || option.get_expected_max() > 1;
    const std::string type = option.get_type_name();
    info.choices = parseChoices(type);
    // "UINT" of "UINT:INT in [1 - 9]"
    if (option.get_items_expected_max() > 0 && option.nonpositional())
        info.value = info.choices.empty() ? type.substr(0, type.find(':')) : "NAME";
    return info;
}

} // namespace

Option& Option::required()
{
    option_->required();
    return *this;
}

Option& Option::typeName(const std::string& name)
{
    option_->type_name(name);
    return *this;
}

Option& Option::choices(const std::vector<std::string>& words, const std::string& type_name)
{
    addCheck(*option_, CLI::IsMember(words), type_name);
    return *this;
}

Option& Option::choices(std::span<const uint32_t> numbers, const std::string& type_name)
{
    addCheck(*option_, CLI::IsMember(std::vector(numbers.begin(), numbers.end())), type_name);
    return *this;
}

Option& Option::range(int min, int max, const std::string& type_name)
{
    addCheck(*option_, CLI::Range(min, max), type_name);
    return *this;
}

Option& Option::range(uint32_t min, uint32_t max, const std::string& type_name)
{
    addCheck(*option_, CLI::Range(min, max), type_name);
    return *this;
}

Option& Option::range(uint64_t min, uint64_t max, const std::string& type_name)
{
    addCheck(*option_, CLI::Range(min, max), type_name);
    return *this;
}

Option& Option::range(double min, double max, const std::string& type_name)
{
    addCheck(*option_, CLI::Range(min, max), type_name);
    refuseNan(*option_);
    return *this;
}

Option& Option::positive(const std::string& type_name)
{
    addCheck(*option_, CLI::PositiveNumber, type_name);
    refuseNan(*option_);
    return *this;
}

Option& Option::check(const std::function<std::string(const std::string& value)>& fault)
{
    option_->check(fault);
    return *this;
}

Option& Option::needs(const Option& other)
{
    option_->needs(other.option_);
    return *this;
}

Option& Option::excludes(const Option& other)
{
    option_->excludes(other.option_);
    return *this;
}

Option& Option::oneValueEach()
{
    option_->allow_extra_args(false);
    return *this;
}

Option& Option::expected(int count)
{
    option_->expected(count);
    return *this;
}

Option& Option::delimiter(char separator)
{
    option_->delimiter(separator);
    return *this;
}

Option& Option::showDefault()
{
    option_->capture_default_str();
    return *this;
}

size_t Option::count() const
{
    return option_->count();
}

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : CommandLine(std::make_shared<CLI::App>(description, name))
{
}

CommandLine::CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app))
{
    app_->callback([this] { finish(); });
}

CommandLine::~CommandLine() = default;

template <typename T>
Option CommandLine::bind(const std::string& names, T& variable, const std::string& description)
{
    return Option(*app_->add_option(names, variable, description));
}

Option CommandLine::addOption(const std::string& names, std::string& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, int& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, uint32_t& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, uint64_t& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, float& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, double& value, const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, std::optional<uint32_t>& value,
                              const std::string& description)
{
    return bind(names, value, description);
}

Option CommandLine::addOption(const std::string& names, std::vector<std::string>& values,
                              const std::string& description)
{
    return bind(names, values, description);
}

Option CommandLine::addOption(const std::string& names, std::vector<float>& values,
                              const std::string& description)
{
    return bind(names, values, description);
}

Option CommandLine::addOption(const std::string& names, std::vector<double>& values,
                              const std::string& description)
{
    return bind(names, values, description);
}

Option CommandLine::addOption(const std::string& names, std::vector<std::vector<double>>& lists,
                              const std::string& description)
{
    using List = std::vector<double>;
    const std::function<void(const List&)> append = [&lists](const List& list) { lists.push_back(list); };
    return Option(*app_->add_option_function<List>(names, append, description)->trigger_on_parse());
}

Option CommandLine::addNumberedChoice(const std::string& names, const std::map<std::string, int>& words,
                                      std::function<void(int)> store, const std::string& description)
{
    CLI::Option* option = app_->add_option_function<int>(names, std::move(store), description);
    return Option(*option->transform(CLI::CheckedTransformer(words).description(""))->type_name("NAME"));
}

Option CommandLine::addFlag(const std::string& names, bool& is_given, const std::string& description)
{
    return Option(*app_->add_flag(names, is_given, description));
}

Option CommandLine::addFlag(const std::string& names, const std::string& description)
{
    return Option(*app_->add_flag(names)->description(description));
}

Option CommandLine::addFlag(const std::string& names, std::string& value, const std::string& description)
{
    return Option(*app_->add_flag(names, value, description));
}

/// Let the option take the next word of the command line where that is its own.
void CommandLine::takeOptionalWord(const std::string& names,
                                   const std::function<bool(const std::string&)>& accepts)
{
    for (const std::string& name : splitText(names, ','))
        accepts_word_[name] = accepts;
}

Option CommandLine::addOptionalChoice(const std::string& names, std::string& value,
                                      const std::vector<std::string>& words, const std::string& bare,
                                      const std::string& description)
{
    std::string type_name;
    for (const std::string& word : words)
        type_name += (type_name.empty() ? "" : "|") + word;
    takeOptionalWord(names, [words](const std::string& word) { return std::ranges::count(words, word) > 0; });
    CLI::Option* option = app_->add_flag(names + "{" + bare + "}", value, description);
    return Option(*option->check(CLI::IsMember(words).description(""))).typeName(type_name);
}

Option CommandLine::addOptionalNumber(const std::string& names, std::optional<uint32_t>& value,
                                      const std::string& bare, const std::string& description)
{
    const auto parse = [bare](const std::string& word) -> std::optional<uint32_t>
    {
        uint32_t number = 0;
        const bool is_number = word != bare && CLI::detail::lexical_cast(word, number);
        return is_number ? std::optional(number) : std::nullopt;
    };
    takeOptionalWord(names, [parse](const std::string& word) { return parse(word).has_value(); });
    CLI::Option* option = app_->add_flag(names + "{" + bare + "}")->description(description);
    option->check([parse, bare](const std::string& word)
                  { return word == bare || parse(word) ? "" : "\"" + word + "\" is not a whole number"; });
    option->each(
        [parse, &value](const std::string& word)
        {
            if (const std::optional<uint32_t> number = parse(word))
                value = number;
        });
    return Option(*option).typeName("N");
}

/// Join the words of options with an optional word to their options: CLI11 knows only "--bricks=off".
void CommandLine::joinOptionalWords(std::vector<std::string>& words) const
{
    for (size_t i = 0; i + 1 < words.size() && words[i] != "--"; ++i)
        if (const auto found = accepts_word_.find(words[i]);
            found != accepts_word_.end() && found->second(words[i + 1]))
        {
            words[i] += "=" + words[i + 1];
            words.erase(words.begin() + static_cast<ptrdiff_t>(i) + 1);
        }
    for (const auto& subcommand : subcommands_)
        subcommand->joinOptionalWords(words);
}

CommandLine& CommandLine::addSubcommand(const std::string& name, const std::string& description)
{
    auto app = app_->get_subcommand_ptr(app_->add_subcommand(name, description));
    subcommands_.push_back(std::unique_ptr<CommandLine>(new CommandLine(std::move(app))));
    return *subcommands_.back();
}

void CommandLine::requireSubcommand()
{
    app_->require_subcommand(1);
}

void CommandLine::shareOptions()
{
    for (const auto& subcommand : subcommands_)
        subcommand->app_->fallthrough();
}

void CommandLine::setFooter(const std::string& text)
{
    app_->footer(text);
}

void CommandLine::setCheck(std::function<std::string()> fault)
{
    fault_ = std::move(fault);
}

void CommandLine::setAction(std::function<void()> action)
{
    action_ = std::move(action);
}

/// Run the check of setCheck, then the action. CLI11 calls this when all options have their values.
/// Throws CLI::ValidationError for a fault that the check returns.
void CommandLine::finish() const
{
    if (const std::string fault = fault_ ? fault_() : ""; !fault.empty())
        throw CLI::ValidationError(fault);
    if (action_)
        action_();
}

std::optional<int> CommandLine::parse(int argc, const char* const* argv)
{
    std::vector<std::string> words(argv + 1, argv + argc);
    joinOptionalWords(words);
    // the name of the program may come from here, and CLI11 parses the words from the back
    std::reverse(words.begin(), words.end());
    if (app_->get_name().empty())
        app_->name(argv[0]);
    try
    {
        app_->parse(std::move(words));
    }
    catch (const CLI::ParseError& error)
    {
        return app_->exit(error) == 0 ? 0 : kUsage;
    }
    return std::nullopt;
}

ParseResult CommandLine::parseWords(std::vector<std::string> words)
{
    joinOptionalWords(words);
    // CLI11 parses the words from the back
    std::reverse(words.begin(), words.end());
    try
    {
        app_->parse(std::move(words));
    }
    catch (const CLI::CallForHelp&)
    {
        return {true, ""};
    }
    catch (const CLI::ParseError& error)
    {
        return {false, error.what()};
    }
    return {};
}

std::string CommandLine::help() const
{
    return app_->help();
}

bool CommandLine::hasSubcommand() const
{
    return !app_->get_subcommands().empty();
}

CommandInfo CommandLine::info() const
{
    CommandInfo info{app_->get_name(), app_->get_description(), {}, {}, app_->get_footer(), {}};
    for (const CLI::Option* option : std::as_const(*app_).get_options())
        (option->nonpositional() ? info.options : info.positionals).push_back(makeOptionInfo(*option));
    for (const auto& subcommand : subcommands_)
        info.subcommands.push_back(subcommand->info());
    return info;
}

} // namespace hearth::cli
