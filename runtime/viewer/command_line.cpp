// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/command_line.h"

#include <algorithm>
#include <cstdio>

namespace hearth::viewer
{

namespace
{

/// Return the value bound to the name, or nullptr.
template <typename Options>
auto find(const Options& options, std::string_view name) -> decltype(&options.front().second)
{
    const auto found = std::find_if(options.begin(), options.end(),
                                    [&](const auto& option) { return option.first == name; });
    return found == options.end() ? nullptr : &found->second;
}

} // namespace

std::string quoted(std::string_view text)
{
    std::string result(1, '"');
    result.append(text);
    result += '"';
    return result;
}

Error usageError(const std::string& detail)
{
    return {Issue::usage, "", "", detail};
}

void printError(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
}

void CommandLine::addText(std::string_view name, std::string& text)
{
    addValue(name,
             [&text](std::string_view value)
             {
                 text = value;
                 return success();
             });
}

Status CommandLine::parse(std::span<const char* const> arguments, std::string& file) const
{
    for (size_t i = 0; i < arguments.size(); ++i)
    {
        const std::string_view name = arguments[i];
        if (name.size() < 2 || name[0] != '-')
        {
            if (!file.empty())
                return usageError(quoted(name) + " is one file too many");
            file = name;
            continue;
        }
        if (const auto* set = find(switches_, name))
        {
            (*set)();
            continue;
        }
        const size_t equals = name.starts_with("--") ? name.find('=') : std::string_view::npos;
        const Parse* parse = find(values_, name.substr(0, equals));
        if (parse == nullptr)
            return usageError("unknown option " + quoted(name));
        if (equals == std::string_view::npos && i + 1 == arguments.size())
            return usageError(std::string(name) + " needs a value");
        HEARTH_TRY((*parse)(equals == std::string_view::npos ? arguments[++i] : name.substr(equals + 1)));
    }
    return success();
}

} // namespace hearth::viewer
