// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/source_part.h"

#include "cook/tools/child_processes.h"
#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

namespace hearth::clusters
{

using namespace formats;

namespace
{

constexpr int kInterrupted = 130;

SourcePart makeFailure(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
    return {std::nullopt, exitCode(error)};
}

SourcePart openPart(const std::string& path)
{
    Result<ContainerReader> reader = ContainerReader::open(path, Check::structure);
    if (!reader.ok())
        return makeFailure(reader.error());
    return {std::move(reader).value(), 0};
}

/// True if the file starts like a container. A file that cannot be read is left to hearth-import, whose
/// message gives the reason.
bool isContainer(const std::string& path)
{
    const RegularFile file(path);
    // only the first four bytes: a damaged container is left to the container's reader
    std::array<uint8_t, 4> start{};
    constexpr auto kStartBytes = static_cast<ssize_t>(start.size());
    return file.isOpen() && file.read(std::as_writable_bytes(std::span(start))) == kStartBytes &&
           std::equal(start.begin(), start.end(), kMagic);
}

/// Pass on the messages of hearth-import, with the source's path in place of the part's, and its exit code.
int relayOutcome(const tools::ChildOutcome& end, const std::string& source, const std::string& part)
{
    std::string messages = end.messages;
    for (size_t at = messages.find(part); at != std::string::npos; at = messages.find(part, at))
    {
        messages.replace(at, part.size(), source);
        at += source.size();
    }
    std::fwrite(messages.data(), 1, messages.size(), stderr);
    if (end.signal == 0)
        return end.exit_code;
    return makeFailure({Issue::child_failed, source, "",
                        std::string("hearth-import was ended by a signal: ") + ::strsignal(end.signal)})
        .exit_code;
}

SourcePart importSource(const std::string& source, const ImportArguments& arguments,
                        const std::string& output)
{
    // declared first, so destroyed last: signals wait until the directory is removed
    tools::ChildProcesses children;
    const auto folder = TempDirectory::create(temporaryFolderOr(parentFolder(output)), output);
    if (!folder.ok())
        return makeFailure(folder.error());
    const std::string part = folder->path() + "/import.part";
    std::vector<std::string> command{tools::programFolder() + "/hearth-import", source, "-o", part};
    for (const std::string& lod : arguments.lods)
        command.insert(command.end(), {"--lod", lod});
    if (!arguments.profile.empty())
        command.insert(command.end(), {"--profile", arguments.profile});
    for (const std::string& setting : arguments.settings)
        command.insert(command.end(), {"--set", setting});
    const auto child = children.start(command);
    if (!child.ok())
        return makeFailure(child.error());
    const std::optional<tools::ChildOutcome> end = children.wait();
    if (!end)
        return {std::nullopt, kInterrupted};
    if (const int code = relayOutcome(*end, source, part); code != 0)
        return {std::nullopt, code};
    return openPart(part);
}

} // namespace

SourcePart openSourcePart(const std::string& path, const ImportArguments& arguments,
                          const std::string& output)
{
    if (!isContainer(path))
        return importSource(path, arguments, output);
    if (!arguments.lods.empty())
        return makeFailure(
            {Issue::usage, path, "", "is an import part: --lod is for hearth-import, which wrote it"});
    return openPart(path);
}

} // namespace hearth::clusters
