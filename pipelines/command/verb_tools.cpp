// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/verb_tools.h"

#include "formats/program.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/messages.h"

#include <CLI/CLI.hpp>
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

void addFormat(CLI::App& verb, std::string& format)
{
    verb.add_option("--format", format, "how the result is written")
        ->check(CLI::IsMember({"text", "json"}))
        ->capture_default_str();
}

std::string sizeFault(const std::string& text)
{
    const Result<uint64_t> size = cache::parseSize(text, "");
    return size.ok() ? "" : size.error().detail;
}

} // namespace hearth::command
