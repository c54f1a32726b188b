// Links the runtime alone, with all its objects: the build succeeds only if the runtime needs nothing of
// cook/ or pipelines/. When run, writes the smallest pack and opens it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_writer.h"
#include "formats/records/scene.h"
#include "runtime/pack/pack.h"

#include <cstdio>

namespace
{

hearth::Status writeAndOpen(const std::string& path)
{
    using namespace hearth::formats;
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::pack));
    HEARTH_TRY(writer.addText(kChunkMeta, "{}"));
    HEARTH_TRY(writer.finish());
    HEARTH_TRY(hearth::pack::Pack::open(path));
    return hearth::success();
}

} // namespace

int main(int argument_count, char** arguments)
{
    if (argument_count != 2)
        return 2;
    const hearth::Status status = writeAndOpen(arguments[1]);
    if (status.ok())
        return 0;
    std::fprintf(stderr, "%s\n", hearth::formatMessage(status.error()).c_str());
    return hearth::exitCode(status.error());
}
