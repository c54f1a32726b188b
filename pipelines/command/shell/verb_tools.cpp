// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/verb_tools.h"

#include "formats/base/program.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/shell/messages.h"

#include <cstdio>

namespace hearth::command
{

int fail(const Error& error)
{
    tell(formatMessage(error));
    return exitCode(error);
}

int usageError(const std::string& what)
{
    return fail({Issue::usage, "hearth", "", what});
}

std::string joined(const std::vector<std::string>& words, std::string_view separator)
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
    return fail({Issue::read_failed, "stdout", "", "cannot be written"});
}

int printResult(const Result<std::string>& result)
{
    return result.ok() ? printResult(*result) : fail(result.error());
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
