// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/verify.h"

#include "cook/json/json.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/shell/terminal.h"

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;

Result<std::string> verifyFile(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView view, openContainer(path));
    const FileHeader& header = view.container().header();
    if (view.container().kind() != ContainerKind::pack)
        return fmt::format("{}: ok: part, {}, {} chunks\n", path, readableSize(header.file_size),
                           header.chunk_count);
    return fmt::format("{}: ok: pack, {}, {} chunks, {} meshes, {} clusters, {} pages\n", path,
                       readableSize(header.file_size), header.chunk_count, view.meshes().size(),
                       view.clusters().size(), view.pages().size());
}

std::string verifyJson(const std::string& path, const Result<std::string>& result)
{
    Json json{{"schema", "hearth.verify/1"}, {"file", path}, {"ok", result.ok()}};
    if (!result.ok())
    {
        const Error& error = result.error();
        json["error"] = {{"code", fmt::format("E{}", static_cast<unsigned>(error.issue))},
                         {"where", error.where},
                         {"text", formatMessage(error)}};
    }
    return json.dump(2) + "\n";
}

} // namespace hearth::command
