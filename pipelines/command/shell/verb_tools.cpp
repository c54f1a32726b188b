// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/verb_tools.h"

#include "pipelines/cache/cache_spec.h"

#include <cstdio>

namespace hearth::command
{

int printUsageError(const std::string& what)
{
    return printError({Issue::usage, "hearth", "", what});
}

std::string joinWords(const std::vector<std::string>& words, std::string_view separator)
{
    std::string text;
    for (size_t i = 0; i < words.size(); ++i)
        (i == 0 ? text : text.append(separator)) += words[i];
    return text;
}

int printResult(const std::string& text)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
        return 0;
    return printError({Issue::read_failed, "stdout", "", "cannot be written"});
}

int printResult(const Result<std::string>& result)
{
    return result.ok() ? printResult(*result) : printError(result.error());
}

void addFormat(cli::CommandLine& verb, std::string& format)
{
    verb.addOption("--format", format, "how the result is written").choices({"text", "json"}).showDefault();
}

std::string sizeFault(const std::string& text)
{
    const Result<uint64_t> size = cache::parseSize(text, "");
    return size.ok() ? "" : size.error().detail;
}

} // namespace hearth::command
