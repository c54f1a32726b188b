// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/completion.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::command
{

namespace
{

std::vector<cli::OptionInfo> allOptions(const cli::CommandInfo& verb, const cli::CommandInfo& hearth)
{
    std::vector<cli::OptionInfo> options = verb.options;
    for (const cli::OptionInfo& common : hearth.options)
        if (std::none_of(options.begin(), options.end(),
                         [&](const cli::OptionInfo& option)
                         { return option.names.back() == common.names.back(); }))
            options.push_back(common);
    return options;
}

std::string joinOptionNames(const std::vector<cli::OptionInfo>& options)
{
    std::vector<std::string> names;
    for (const cli::OptionInfo& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return fmt::format("{}", fmt::join(names, " "));
}

/// Quote text for a shell with single quotes.
std::string singleQuoted(std::string text)
{
    for (size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
        text.replace(at, 1, "'\\''");
    return "'" + text + "'";
}

/// Return the choices of the first positional; none if it has no choices.
std::vector<std::string> firstChoices(const cli::CommandInfo& verb)
{
    return verb.positionals.empty() ? std::vector<std::string>() : verb.positionals.front().choices;
}

/// Escape the special characters of a zsh specification.
std::string zshText(const std::string& text)
{
    std::string plain;
    for (const char c : text)
    {
        if (c == '[' || c == ']' || c == ':' || c == '\\')
            plain += '\\';
        plain += c;
    }
    return plain;
}

std::string zshOption(const cli::OptionInfo& option, const std::string& name)
{
    const std::string action =
        option.choices.empty() ? std::string("_files") : fmt::format("({})", fmt::join(option.choices, " "));
    return singleQuoted(fmt::format(
        "*{}[{}]{}", name, zshText(option.description),
        option.value.empty() ? std::string() : fmt::format(":{}:{}", zshText(option.value), action)));
}

} // namespace

std::string bashCompletion(const cli::CommandInfo& hearth)
{
    std::string verbs;
    std::string cases;
    std::string values;
    for (const cli::CommandInfo& verb : hearth.subcommands)
    {
        verbs += (verbs.empty() ? "" : " ") + verb.name;
        const std::vector<cli::OptionInfo> options = allOptions(verb, hearth);
        cases += fmt::format("    {})\n      options={}\n      words={}\n      ;;\n", verb.name,
                             singleQuoted(joinOptionNames(options)),
                             singleQuoted(fmt::format("{}", fmt::join(firstChoices(verb), " "))));
        for (const cli::OptionInfo& option : options)
            if (!option.value.empty())
                for (const std::string& name : option.names)
                    values +=
                        fmt::format("    {}:{})\n      words={}; is_value=1\n      ;;\n", verb.name, name,
                                    singleQuoted(fmt::format("{}", fmt::join(option.choices, " "))));
    }
    return fmt::format(
        R"(# bash completion for hearth: source it, or put it into /usr/share/bash-completion/completions/hearth
_hearth()
{{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb='' options='' words='' is_value='' i
  # readline splits at =
  if [[ $word == '=' ]]; then word=''; elif [[ $before == '=' ]]; then before=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
    -C | --directory | --config) ((++i)) ;;
    -*) ;;
    *) verb=${{COMP_WORDS[i]}}; break ;;
    esac
  done
  if [[ -z $verb ]]; then
    COMPREPLY=($(compgen -W {} -- "$word"))
    [[ $word == -* ]] && COMPREPLY=($(compgen -W {} -- "$word"))
    return
  fi
  case $verb in
{}  esac
  case $verb:$before in
{}  esac
  if [[ -z $is_value && $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  else
    compopt -o filenames 2>/dev/null
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -F _hearth hearth
)",
        singleQuoted(verbs), singleQuoted(joinOptionNames(hearth.options)), cases, values);
}

std::string zshCompletion(const cli::CommandInfo& hearth)
{
    std::string verbs;
    std::string cases;
    for (const cli::CommandInfo& verb : hearth.subcommands)
    {
        verbs += "    " + singleQuoted(verb.name + ":" + zshText(verb.description)) + "\n";
        cases += fmt::format("  {})\n    _arguments", verb.name);
        for (const cli::OptionInfo& option : allOptions(verb, hearth))
            for (const std::string& name : option.names)
                cases += " \\\n      " + zshOption(option, name);
        const std::vector<std::string> choices = firstChoices(verb);
        if (!verb.positionals.empty())
            cases +=
                " \\\n      " +
                singleQuoted(fmt::format("*:{}:{}", zshText(verb.positionals.front().names.front()),
                                         choices.empty() ? std::string("_files")
                                                         : fmt::format("({})", fmt::join(choices, " "))));
        cases += "\n    ;;\n";
    }
    return fmt::format(R"(#compdef hearth
# zsh completion for hearth: put it into a folder of $fpath as _hearth
_hearth()
{{
  local -a verbs=(
{}  )
  if ((CURRENT == 2)); then
    _describe verb verbs
    return
  fi
  local verb=$words[2]
  shift words
  ((--CURRENT))
  case $verb in
{}  esac
}}
_hearth "$@"
)",
                       verbs, cases);
}

std::string fishCompletion(const cli::CommandInfo& hearth)
{
    std::string text = "# fish completion for hearth: put it into ~/.config/fish/completions/hearth.fish\n";
    const auto addOptions = [&](const std::vector<cli::OptionInfo>& options, const std::string& condition)
    {
        for (const cli::OptionInfo& option : options)
        {
            text += "complete -c hearth" + condition;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.value.empty())
                text += option.choices.empty()
                            ? " -r"
                            : " -x -a " + singleQuoted(fmt::format("{}", fmt::join(option.choices, " ")));
            text += " -d " + singleQuoted(option.description) + "\n";
        }
    };
    for (const cli::CommandInfo& verb : hearth.subcommands)
        text += fmt::format("complete -c hearth -f -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                            singleQuoted(verb.description));
    addOptions(hearth.options, "");
    for (const cli::CommandInfo& verb : hearth.subcommands)
    {
        const std::string condition = fmt::format(" -n '__fish_seen_subcommand_from {}'", verb.name);
        addOptions(verb.options, condition);
        for (const std::string& choice : firstChoices(verb))
            text += fmt::format("complete -c hearth -f{} -a {}\n", condition, choice);
    }
    return text;
}

} // namespace hearth::command
